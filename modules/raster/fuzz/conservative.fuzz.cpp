// Conservative passes over arbitrary draws: no crash, nothing written outside, and what is drawn lies between inner and
// outer coverage.

#include <gnomon/check/fuzz.hpp>

#include "framed.hpp"
#include "input.hpp"

namespace {

using namespace gnomon;

void check_stats(raster::ConservativeStats const& s) {
    GNOMON_FUZZ_CHECK(s.triangles == s.bad_index + s.not_finite + s.outside + s.culled + s.no_pixel + s.drawn);
    GNOMON_FUZZ_CHECK(s.clipped <= s.triangles);
    GNOMON_FUZZ_CHECK(s.drawn != 0 || s.pixels_written == 0);
}

template <class T>
void check_bounds(fuzz::Framed<T>& image, fuzz::Input const& input, raster::ConservativeConfig const& config,
                  raster::TileWorkspace& workspace) {
    core::SerialExecutor executor;
    check_stats(raster::conservative_pass(input.draws, image.view(), config, workspace, executor));
    GNOMON_FUZZ_CHECK(image.kept_outside(fuzz::drawn_rect(input)));
    for (std::int32_t y = 0; y < input.height; ++y)
        for (std::int32_t x = 0; x < input.width; ++x)
            GNOMON_FUZZ_CHECK(image.view().at(x, y) >= T{0} && (sizeof(T) == 2 || image.view().at(x, y) <= T{1}));
}

/// A sample that the depth pass draws lies in a pixel of outer coverage; the sample of a covered pixel is not behind
/// the farthest depth over it (where the clipper has left the corners alone).
void check_coverage(fuzz::Input const& input, raster::TileWorkspace& workspace) {
    bool const forward = input.config.depth == math::Depth::forward;
    float const farthest = forward ? 1.0F : 0.0F;
    float const behind = forward ? 2.0F : -1.0F;  // Behind every depth, so that any pixel shows.
    fuzz::Framed<float> outer(input.width, input.height, behind, -7.0F);
    fuzz::Framed<float> inner = outer;
    fuzz::Framed<float> plain(input.width, input.height, farthest, -7.0F);
    core::SerialExecutor executor;
    raster::Workspace plain_workspace;
    raster::PassConfig config = input.config;
    config.load = raster::Load::keep;
    raster::ConservativeConfig conservative{.depth = config.depth,
                                            .range = config.range,
                                            .load = config.load,
                                            .viewport = config.viewport,
                                            .scissor = config.scissor};
    auto const stats = raster::depth_pass(input.draws, plain.view(), config, plain_workspace, executor);
    check_stats(raster::conservative_pass(input.draws, outer.view(), conservative, workspace, executor));
    conservative.coverage = raster::Coverage::inner;
    conservative.bound = raster::Bound::farthest;
    check_stats(raster::conservative_pass(input.draws, inner.view(), conservative, workspace, executor));
    for (std::size_t i = 0; i < plain.data().size(); ++i) {
        float const sample = plain.data()[i];
        float const bound = inner.data()[i];
        if (sample == -7.0F) continue;  // The frame.
        GNOMON_FUZZ_CHECK(sample == farthest || outer.data()[i] != behind);
        GNOMON_FUZZ_CHECK(bound == behind || outer.data()[i] != behind);
        if (bound == behind || stats.clipped != 0) continue;
        GNOMON_FUZZ_CHECK(forward ? sample <= bound + 1e-6F : sample >= bound - 1e-6F);
    }
}

void run(std::span<std::uint8_t const> bytes) {
    check::FuzzBytes in(bytes);
    raster::ConservativeConfig config;
    config.coverage = in.flag() ? raster::Coverage::inner : raster::Coverage::outer;
    config.bound = in.flag() ? raster::Bound::farthest : raster::Bound::nearest;
    config.keep = in.flag() ? raster::Bound::farthest : raster::Bound::nearest;
    config.slack = in.in(0, raster::max_slack) % (in.flag() ? raster::max_slack + 1 : 8);
    fuzz::Input input;
    fuzz::take_input(in, input);
    config.depth = input.config.depth;
    config.range = input.config.range;
    config.load = input.config.load;
    config.viewport = input.config.viewport;
    config.scissor = input.config.scissor;
    raster::TileWorkspace workspace;
    if (input.unorm16) {
        fuzz::Framed<std::uint16_t> codes(input.width, input.height, 777, 54321);
        check_bounds(codes, input, config, workspace);
    } else {
        fuzz::Framed<float> depth(input.width, input.height, 0.25F, -7.0F);
        check_bounds(depth, input, config, workspace);
        check_coverage(input, workspace);
    }
}

/// Seven bytes of modes before each of the pass's seeds.
void seeds(check::FuzzSeeds& out) {
    check::FuzzSeeds plain;
    fuzz::write_seeds(plain);
    int n = 0;
    for (auto const& seed : plain.seeds) {
        check::FuzzWriter modes;
        modes.flag(n % 2 != 0).flag(n % 3 != 0).flag(n % 5 == 0).in(0, n % 4).flag(false);
        for (std::uint8_t const byte : seed.bytes) modes.put(byte);
        out.add(seed.name, modes.bytes);
        ++n;
    }
}

}  // namespace

GNOMON_FUZZ_TARGET(run, seeds)
