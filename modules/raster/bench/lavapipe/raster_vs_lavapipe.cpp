// Compares the depth pass with lavapipe in one run: city in three sizes, sunlight and street view, three image sizes.
//
//   raster_vs_lavapipe [--repeats N] [--kernel scalar|simd]
//
// One thread each (LP_NUM_THREADS=0), clear included, interleaved, medians. Prints per row both times, the ratio, the
// pixels that only one of them covers, and the largest difference of depth where both do.

#include "vulkan_depth.hpp"

#include "../city.hpp"

#include <gnomon/math/view.hpp>
#include <gnomon/raster.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string_view>
#include <vector>

namespace {

using namespace gnomon;

struct Options {
    int repeats = 5;
    raster::Kernel kernel = raster::Kernel::automatic;
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

struct Difference {
    std::size_t only_one = 0;
    std::size_t beyond_2e6 = 0;  ///< Both cover it, depths differ by more than 2e-6.
    double max = 0.0;
};

Difference compare(std::vector<float> const& a, std::vector<float> const& b) {
    Difference d;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if ((a[i] < 1.0F) != (b[i] < 1.0F)) {
            ++d.only_one;
            continue;
        }
        double const difference = std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
        d.max = std::max(d.max, difference);
        d.beyond_2e6 += difference > 2e-6 ? 1 : 0;
    }
    return d;
}

void compare_row(bench::City const& city, bool ortho, int size_px, Options const& options) {
    math::View const view = bench::make_view(ortho, size_px);
    // Both get the same floats: positions relative to the eye, rounded once.
    math::vec3 const eye = math::to_float(view.eye_m);
    std::vector<math::vec3> relative(city.positions);
    for (math::vec3& p : relative) p = p - eye;
    math::mat4 const matrix = math::clip_from_relative(view);

    lavapipe::VulkanDepth peer(relative, city.indices, size_px);
    std::vector<float> depth(static_cast<std::size_t>(size_px) * static_cast<std::size_t>(size_px));
    raster::Draw draw;
    draw.positions = std::span<math::vec3 const>(relative);
    draw.indices = std::span<std::uint32_t const>(city.indices);
    draw.clip_from_relative = matrix;
    raster::PassConfig config;
    config.depth = math::Depth::forward;
    config.kernel = options.kernel;
    raster::Workspace workspace;
    core::SerialExecutor serial;

    std::vector<double> ours;
    std::vector<double> theirs;
    for (int i = 0; i <= options.repeats; ++i) {
        auto const begin = std::chrono::steady_clock::now();
        raster::depth_pass({&draw, 1}, raster::make_image(depth.data(), size_px, size_px), config, workspace, serial);
        double const ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
        double const peer_ms = peer.draw_ms(matrix);
        if (i == 0) continue;  // warm-up: the peer compiles its shader
        ours.push_back(ms);
        theirs.push_back(peer_ms);
    }
    Difference const d = compare(depth, peer.read_back());
    std::printf("%8zu  %-5s  %4d  %10.2f  %10.2f  %6.2fx  %8zu  %9zu  %.2g\n", city.indices.size() / 3,
                ortho ? "ortho" : "persp", size_px, median(theirs), median(ours), median(theirs) / median(ours),
                d.only_one, d.beyond_2e6, d.max);
}

bool parse(int argc, char** argv, Options& options) {
    for (int i = 1; i + 1 < argc; i += 2) {
        std::string_view const flag = argv[i];
        std::string_view const value = argv[i + 1];
        if (flag == "--repeats") options.repeats = std::max(1, std::atoi(argv[i + 1]));
        else if (flag == "--kernel" && value == "scalar") options.kernel = raster::Kernel::scalar;
        else if (flag == "--kernel" && value == "simd") options.kernel = raster::Kernel::simd;
        else return false;
    }
    return argc % 2 == 1;
}

void run(Options const& options) {
    std::printf("%8s  %-5s  %4s  %10s  %10s  %7s  %8s  %9s  %s\n", "tris", "view", "size", "lavapipe", "gnomon", "ratio",
                "coverage", "dz > 2e-6", "max dz");
    for (int const size : {0, 1, 2}) {
        bench::City const city = bench::make_city(size);
        for (int const size_px : {1024, 2048, 4096})
            for (bool const ortho : {true, false}) compare_row(city, ortho, size_px, options);
    }
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    if (!parse(argc, argv, options)) {
        std::fputs("usage: raster_vs_lavapipe [--repeats N] [--kernel scalar|simd]\n", stderr);
        return 2;
    }
    setenv("LP_NUM_THREADS", "0", 0);  // read when the driver starts
    try {
        run(options);
    } catch (std::exception const& error) {
        std::fprintf(stderr, "raster_vs_lavapipe: %s\n", error.what());
        return 1;
    }
    return 0;
}
