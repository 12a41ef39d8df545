// Cascades from frame to frame: what is kept gives the very maps that are drawn anew.

#include "cascade_runs.hpp"

#include <gnomon/raster/cpu_backend.hpp>

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>

namespace {

using namespace gnomon;
using test::CascadeRunner;
using test::Town;
using test::count_of;

struct Shares {
    std::array<double, 4> of_map{};
    std::uint64_t frames = 0;
    std::uint64_t redraws = 0;  ///< Whole ones, after the first frame.

    [[nodiscard]] double mean() const { return (of_map[0] + of_map[1] + of_map[2] + of_map[3]) / (4.0 * static_cast<double>(frames)); }
};

/// Flies along `path` and checks that both ways to keep maps give those that are drawn anew.
Shares fly(std::string const& path, double moving, std::size_t first, std::size_t end) {
    Town town(path, moving);
    core::SerialExecutor executor;
    raster::CpuBackend cpu(executor);
    CascadeRunner csm(cpu, "csm"), cached(cpu, "csm-cached"), scroll(cpu, "csm-scroll");
    Shares shares;
    for (std::size_t i = first; i < end; ++i) {
        pipeline::Frame const frame = town.frame(i);
        auto const anew = csm(frame), kept = cached(frame), scrolled = scroll(frame);
        CHECK(cached.device.codes == csm.device.codes);
        CHECK(scroll.device.codes == csm.device.codes);
        CHECK(scrolled.visibility == anew.visibility);
        CHECK(kept.visibility == anew.visibility);
        if (i == first) continue;
        ++shares.frames;
        for (std::size_t k = 0; k < 4; ++k) {
            std::string const name = "triangles_map_" + std::to_string(k);
            shares.of_map[k] += static_cast<double>(count_of(scrolled, name)) / static_cast<double>(count_of(anew, name));
        }
        for (pipeline::Count const& reason : scrolled.redraw_reasons)
            shares.redraws += reason.name != "volume_moved" && reason.name != "member_joined" ? 1U : 0U;
    }
    std::printf("town %s, %g %% moving, %zu frames: triangles of csm-scroll over csm's %.3f (maps %.3f %.3f %.3f %.3f), %llu whole redraws\n",
                path.c_str(), moving, static_cast<std::size_t>(shares.frames), shares.mean(), shares.of_map[0] / static_cast<double>(shares.frames),
                shares.of_map[1] / static_cast<double>(shares.frames), shares.of_map[2] / static_cast<double>(shares.frames),
                shares.of_map[3] / static_cast<double>(shares.frames), static_cast<unsigned long long>(shares.redraws));
    return shares;
}

}  // namespace

TEST_CASE("maps that scroll are those drawn anew, along town's street with cars about", "[pipeline][cascade]") {
    CHECK(fly("street", 10, 40, 46).redraws == 0);
    CHECK(fly("spin", 0, 0, 5).redraws == 0);
}

TEST_CASE("at the paper's speeds maps that scroll draw few of the triangles", "[pipeline][cascade][.full]") {
    CHECK(fly("street", 0, 0, 150).mean() <= 0.12);
    CHECK(fly("spin", 0, 0, 150).mean() <= 0.18);
    CHECK(fly("street", 10, 0, 150).mean() < 0.5);
    CHECK(fly("both", 20, 0, 150).mean() < 0.6);
}
