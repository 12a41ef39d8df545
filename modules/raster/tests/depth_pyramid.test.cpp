#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/raster.hpp>

#include "oracle.hpp"
#include "query_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::raster;
using oracle::Random;

/// Whether every block of every level holds the least and greatest of the image's samples, taken one by one.
template <class T>
bool is_pyramid_of(ImageView<T> const& image, DepthPyramid const& pyramid) {
    bool right = pyramid.width_px() == image.width && pyramid.height_px() == image.height;
    for (int level = 0; level < pyramid.level_count(); ++level) {
        std::int32_t const size = 8 << level;
        ImageView<float const> const least = pyramid.least(level);
        ImageView<float const> const greatest = pyramid.greatest(level);
        right = right && least.width == (image.width + size - 1) / size &&
                least.height == (image.height + size - 1) / size;
        for (std::int32_t by = 0; by < least.height; ++by)
            for (std::int32_t bx = 0; bx < least.width; ++bx) {
                float low = std::numeric_limits<float>::infinity();
                float high = -low;
                for (std::int32_t y = by * size; y < std::min(image.height, (by + 1) * size); ++y)
                    for (std::int32_t x = bx * size; x < std::min(image.width, (bx + 1) * size); ++x) {
                        auto const z = static_cast<float>(image.at(x, y));
                        if (std::isnan(z)) continue;
                        low = std::min(low, z);
                        high = std::max(high, z);
                    }
                right = right && low == least.at(bx, by) && high == greatest.at(bx, by);
            }
    }
    int const top = pyramid.level_count() - 1;
    return right && pyramid.least(top).width == 1 && pyramid.least(top).height == 1;
}

bool same(DepthPyramid const& a, DepthPyramid const& b) {
    if (a.level_count() != b.level_count()) return false;
    for (int level = 0; level < a.level_count(); ++level)
        for (std::int32_t y = 0; y < a.least(level).height; ++y) {
            auto const width = static_cast<std::size_t>(a.least(level).width);
            if (!std::equal(a.least(level).row(y), a.least(level).row(y) + width, b.least(level).row(y))) return false;
            if (!std::equal(a.greatest(level).row(y), a.greatest(level).row(y) + width, b.greatest(level).row(y)))
                return false;
        }
    return true;
}

}  // namespace

TEST_CASE("a pyramid holds the least and greatest depth of every block, at any image size", "[raster][pyramid]") {
    Random random{61};
    core::SerialExecutor serial;
    DepthPyramid pyramid;
    for (int round = 0; round < 60; ++round) {
        std::int32_t const width = round < 20 ? round + 1 : random.in(1, 300);
        std::int32_t const height = round < 20 ? random.in(1, 20) : random.in(1, 200);
        std::int32_t const stride = width + random.in(0, 5);
        std::vector<float> depth(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height));
        std::vector<std::uint16_t> codes(depth.size());
        for (std::size_t i = 0; i < depth.size(); ++i) {
            bool const nan = round % 3 == 0 && random.in(0, 3) == 0;
            depth[i] = nan ? std::numeric_limits<float>::quiet_NaN() : random.unit();
            codes[i] = static_cast<std::uint16_t>(random.in(0, 65535));
        }
        ImageView<float> const image{depth.data(), width, height, stride};
        build_pyramid(image, math::Depth::reversed, pyramid, serial);
        CAPTURE(width, height);
        CHECK(is_pyramid_of(image, pyramid));
        CHECK(pyramid.farthest(0).data == pyramid.least(0).data);
        ImageView<std::uint16_t> const codes_image{codes.data(), width, height, stride};
        build_pyramid(codes_image, math::Depth::forward, pyramid, serial);
        CHECK(is_pyramid_of(codes_image, pyramid));
        CHECK(pyramid.farthest(0).data == pyramid.greatest(0).data);
    }
    build_pyramid(ImageView<float>{}, math::Depth::reversed, pyramid, serial);
    CHECK(pyramid.level_count() == 0);
}

TEST_CASE("a pass hands out the pyramid that is built from its image", "[raster][pyramid][determinism]") {
    query::Street const street(62, 160);
    core::SerialExecutor serial;
    for (math::Depth const depth : {math::Depth::forward, math::Depth::reversed})
        for (int round = 0; round < 6; ++round) {
            std::int32_t const width = 130 + 41 * round;
            std::int32_t const height = 77 + 64 * (round % 3);
            math::View const view = street.view(depth, {width, height});
            Draw const draw = street.draw(view);
            core::ThreadExecutor pool(1 + round % 3);
            core::ExecutorRef const executor = round % 2 == 0 ? core::ExecutorRef(pool) : core::ExecutorRef(serial);
            std::vector<float> image(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                                     depth == math::Depth::forward ? 0.996F : 0.004F);  // 125 m
            std::vector<std::uint16_t> codes(image.size(), std::uint16_t{9000});
            Workspace workspace;
            DepthPyramid handed;
            DepthPyramid built;
            PassConfig config{.depth = depth, .pyramid = &handed};
            if (round == 4) config.load = Load::keep;
            if (round == 5) config.scissor = Rect{13, 5, 60, 41};
            if (round == 3) config.kernel = Kernel::scalar;
            depth_pass({&draw, 1}, make_image(image.data(), width, height), config, workspace, executor);
            build_pyramid(make_image(image.data(), width, height), depth, built, serial);
            CAPTURE(round, static_cast<int>(depth));
            CHECK(same(handed, built));
            int const top = built.level_count() - 1;
            CHECK(built.least(top).at(0, 0) < built.greatest(top).at(0, 0));
            depth_pass({&draw, 1}, make_image(codes.data(), width, height), config, workspace, executor);
            build_pyramid(make_image(codes.data(), width, height), depth, built, serial);
            CHECK(handed.is_unorm16());
            CHECK(same(handed, built));
            config.scissor = Rect{0, 0, 0, 0};
            depth_pass({&draw, 1}, make_image(codes.data(), width, height), config, workspace, executor);
            CHECK(same(handed, built));
        }
}

TEST_CASE("a pyramid is handed out by passes of several batches and of images that are streamed",
          "[raster][pyramid]") {
    query::Street const street(63, 9000);
    core::SerialExecutor serial;
    Workspace workspace;
    for (std::int32_t const size : {64, 2912}) {
        math::View const view = street.view(math::Depth::reversed, {size, size});
        Draw const draw = street.draw(view);
        std::vector<float> memory(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) + 16);
        for (std::size_t shift : {8U, 3U}) {
            if (size == 64 && shift == 3) continue;
            DepthPyramid handed;
            DepthPyramid built;
            DepthTarget const target = make_image(memory.data() + shift, size, size);
            PassStats const stats = depth_pass({&draw, 1}, target, {.pyramid = &handed}, workspace, serial);
            CHECK(stats.triangles > (std::size_t{1} << 17U));
            build_pyramid(target, math::Depth::reversed, built, serial);
            CAPTURE(size, shift);
            CHECK(same(handed, built));
        }
    }
}

TEST_CASE("a second pyramid of the same size allocates nothing", "[raster][pyramid][memory]") {
    std::vector<float> depth(500 * 300, 0.5F);
    core::SerialExecutor serial;
    DepthPyramid pyramid;
    build_pyramid(make_image(depth.data(), 500, 300), math::Depth::forward, pyramid, serial);
    float const* const held = pyramid.least(0).data;
    std::size_t const bytes = pyramid.size_bytes();
    build_pyramid(make_image(depth.data(), 500, 300), math::Depth::reversed, pyramid, serial);
    build_pyramid(make_image(depth.data(), 100, 30), math::Depth::reversed, pyramid, serial);
    CHECK(pyramid.least(0).data == held);
    CHECK(pyramid.size_bytes() == bytes);
}
