// Passes over arbitrary draws: no crash, nothing written outside, and the vector kernel equals the reference.

#include <gnomon/check/fuzz.hpp>

#include "input.hpp"

#include <algorithm>

namespace {

using namespace gnomon;

constexpr std::int32_t margin = 3;  // Rows and columns around the image that nothing may touch.

/// An image inside a larger one.
template <class T>
struct Framed {
    Framed(std::int32_t width, std::int32_t height, T fill, T frame)
        : width_(width), height_(height), fill_(fill), frame_(frame) {
        data_.assign(stride() * static_cast<std::size_t>(height + 2 * margin), frame);
        for (std::int32_t y = 0; y < height; ++y) std::fill_n(view().row(y), width, fill);
    }
    raster::ImageView<T> view() {
        return {data_.data() + stride() * margin + margin, width_, height_, static_cast<std::ptrdiff_t>(stride())};
    }
    /// What was there before is there still, in the frame and beyond `drawn`.
    bool kept_outside(raster::Rect const& drawn) const {
        for (std::size_t i = 0; i < data_.size(); ++i) {
            auto const x = static_cast<std::int32_t>(i % stride()) - margin;
            auto const y = static_cast<std::int32_t>(i / stride()) - margin;
            bool const image = x >= 0 && y >= 0 && x < width_ && y < height_;
            bool const in_drawn =
                x >= drawn.x && y >= drawn.y && x - drawn.x < drawn.width && y - drawn.y < drawn.height;
            if (!image && data_[i] != frame_) return false;
            if (image && !in_drawn && data_[i] != fill_) return false;
        }
        return true;
    }
    friend bool operator==(Framed const& a, Framed const& b) { return a.data_ == b.data_; }
    std::vector<T> const& data() const { return data_; }

  private:
    [[nodiscard]] std::size_t stride() const { return static_cast<std::size_t>(width_ + 2 * margin); }
    std::int32_t width_, height_;
    T fill_, frame_;
    std::vector<T> data_;
};

void check_stats(raster::PassStats const& s, std::vector<raster::Draw> const& draws) {
    std::uint64_t triangles = 0;
    for (raster::Draw const& draw : draws) triangles += raster::triangle_count(draw);
    GNOMON_FUZZ_CHECK(s.triangles == triangles);
    GNOMON_FUZZ_CHECK(s.triangles ==
                      s.bad_index + s.not_finite + s.outside + s.degenerate + s.culled + s.no_sample + s.drawn);
    GNOMON_FUZZ_CHECK(s.clipped <= s.triangles);
    GNOMON_FUZZ_CHECK(s.drawn != 0 || s.samples_written == 0);
}

raster::Rect drawn_rect(fuzz::Input const& input) {
    return input.config.scissor.value_or(raster::Rect{0, 0, input.width, input.height});
}

void check_camera(fuzz::Input const& input, raster::Workspace& workspace) {
    Framed<float> depth(input.width, input.height, 0.25F, -7.0F);
    Framed<std::uint32_t> id(input.width, input.height, 123, 456);
    Framed<float> depth_simd = depth;
    Framed<std::uint32_t> id_simd = id;
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
    GNOMON_FUZZ_CHECK(depth.kept_outside(drawn_rect(input)));
    GNOMON_FUZZ_CHECK(id.kept_outside(drawn_rect(input)));
    auto const view = depth.view();
    for (std::int32_t y = 0; y < view.height; ++y)
        for (std::int32_t x = 0; x < view.width; ++x) GNOMON_FUZZ_CHECK(view.at(x, y) >= 0.0F && view.at(x, y) <= 1.0F);
    // The depth pass is the camera pass without ids.
    Framed<float> alone(input.width, input.height, 0.25F, -7.0F);
    GNOMON_FUZZ_CHECK(raster::depth_pass(input.draws, alone.view(), config, workspace, executor) == stats);
    GNOMON_FUZZ_CHECK(alone == depth);
}

void check_unorm16(fuzz::Input const& input, raster::Workspace& workspace) {
    Framed<std::uint16_t> codes(input.width, input.height, 777, 54321);
    Framed<std::uint16_t> codes_simd = codes;
    core::SerialExecutor executor;
    raster::PassConfig config = input.config;
    config.kernel = raster::Kernel::scalar;
    auto const stats = raster::depth_pass(input.draws, codes.view(), config, workspace, executor);
    config.kernel = raster::Kernel::simd;
    GNOMON_FUZZ_CHECK(stats == raster::depth_pass(input.draws, codes_simd.view(), config, workspace, executor));
    check_stats(stats, input.draws);
    GNOMON_FUZZ_CHECK(codes == codes_simd);
    GNOMON_FUZZ_CHECK(codes.kept_outside(drawn_rect(input)));
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
