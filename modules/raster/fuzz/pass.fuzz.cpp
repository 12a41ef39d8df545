// Passes over arbitrary draws: no crash, nothing written outside, and the vector kernel equals the reference.

#include <gnomon/check/fuzz.hpp>

#include "framed.hpp"
#include "input.hpp"

namespace {

using namespace gnomon;

void check_stats(raster::PassStats const& s, std::vector<raster::Draw> const& draws) {
    std::uint64_t triangles = 0;
    for (raster::Draw const& draw : draws) triangles += raster::triangle_count(draw);
    GNOMON_FUZZ_CHECK(s.triangles == triangles);
    GNOMON_FUZZ_CHECK(s.triangles ==
                      s.bad_index + s.not_finite + s.outside + s.degenerate + s.culled + s.no_sample + s.drawn);
    GNOMON_FUZZ_CHECK(s.clipped <= s.triangles);
    GNOMON_FUZZ_CHECK(s.drawn != 0 || s.samples_written == 0);
}

void check_camera(fuzz::Input const& input, raster::Workspace& workspace) {
    fuzz::Framed<float> depth(input.width, input.height, 0.25F, -7.0F);
    fuzz::Framed<std::uint32_t> id(input.width, input.height, 123, 456);
    fuzz::Framed<float> depth_simd = depth;
    fuzz::Framed<std::uint32_t> id_simd = id;
    core::SerialExecutor executor;
    raster::PassConfig config = input.config;
    config.kernel = raster::Kernel::scalar;
    auto const stats = raster::camera_pass(input.draws, {depth.view(), id.view()}, config, workspace, executor);
    config.kernel = raster::Kernel::simd;
    auto const simd =
        raster::camera_pass(input.draws, {depth_simd.view(), id_simd.view()}, config, workspace, executor);
    check_stats(stats, input.draws);
    GNOMON_FUZZ_CHECK(stats == simd);
    GNOMON_FUZZ_CHECK(depth == depth_simd);
    GNOMON_FUZZ_CHECK(id == id_simd);
    GNOMON_FUZZ_CHECK(depth.kept_outside(fuzz::drawn_rect(input)));
    GNOMON_FUZZ_CHECK(id.kept_outside(fuzz::drawn_rect(input)));
    auto const view = depth.view();
    for (std::int32_t y = 0; y < view.height; ++y)
        for (std::int32_t x = 0; x < view.width; ++x) GNOMON_FUZZ_CHECK(view.at(x, y) >= 0.0F && view.at(x, y) <= 1.0F);
    // The depth pass is the camera pass without ids.
    fuzz::Framed<float> alone(input.width, input.height, 0.25F, -7.0F);
    GNOMON_FUZZ_CHECK(raster::depth_pass(input.draws, alone.view(), config, workspace, executor) == stats);
    GNOMON_FUZZ_CHECK(alone == depth);
}

void check_unorm16(fuzz::Input const& input, raster::Workspace& workspace) {
    fuzz::Framed<std::uint16_t> codes(input.width, input.height, 777, 54321);
    fuzz::Framed<std::uint16_t> codes_simd = codes;
    core::SerialExecutor executor;
    raster::PassConfig config = input.config;
    config.kernel = raster::Kernel::scalar;
    auto const stats = raster::depth_pass(input.draws, codes.view(), config, workspace, executor);
    config.kernel = raster::Kernel::simd;
    GNOMON_FUZZ_CHECK(stats == raster::depth_pass(input.draws, codes_simd.view(), config, workspace, executor));
    check_stats(stats, input.draws);
    GNOMON_FUZZ_CHECK(codes == codes_simd);
    GNOMON_FUZZ_CHECK(codes.kept_outside(fuzz::drawn_rect(input)));
}

void run(std::span<std::uint8_t const> bytes) {
    check::FuzzBytes in(bytes);
    fuzz::Input input;
    fuzz::take_input(in, input);
    for (raster::Draw const& draw : input.draws) static_cast<void>(raster::validate(draw));
    raster::Workspace workspace;
    if (input.unorm16)
        check_unorm16(input, workspace);
    else
        check_camera(input, workspace);
}

}  // namespace

GNOMON_FUZZ_TARGET(run, fuzz::write_seeds)
