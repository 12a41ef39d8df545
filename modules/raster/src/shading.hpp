#pragma once
// The pass that shades: fragments gathered tile by tile, handed to a fragment kernel, and blended in the order of the draws.

#include <gnomon/backend/fragment.hpp>
#include <gnomon/raster/layers.hpp>

#include "kernel.hpp"
#include "sample_loop.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::raster::detail {

/// What a shading pass does with the fragments of its only layer.
struct Shading {
    backend::FragmentFunction kernel = nullptr;
    backend::KernelData const* data = nullptr;
    ImageView<math::vec4> color;
    backend::FragmentTest test = backend::FragmentTest::nearer;
    backend::Blend blend = backend::Blend::replace_and_add;
};

/// The color of a pixel under a fragment.
[[nodiscard]] inline math::vec4 blended(backend::Blend blend, math::vec4 const& over, math::vec4 const& under) noexcept {
    if (blend == backend::Blend::replace_and_add) return {over.x, over.y, over.z, over.w + under.w};
    float const rest = 1.0F - over.w;
    return {over.x + under.x * rest, over.y + under.y * rest, over.z + under.z * rest, over.w + under.w * rest};
}

/// Fragments of one tile that wait for their colours.
class FragmentBatch {
  public:
    explicit FragmentBatch(Shading const& shading) noexcept : shading_(shading) {}

    void add(std::int32_t x, std::int32_t y, std::uint32_t triangle, float depth) {
        if (count_ == size) flush();
        fragments_[count_++] = {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), triangle, depth};
    }
    void flush() {
        colors_.fill({});
        if (count_ > 0) shading_.kernel(*shading_.data, std::span(fragments_).first(count_), std::span(colors_).first(count_));
        for (std::size_t i = 0; i < count_; ++i) {
            if (colors_[i].discarded) continue;
            math::vec4& held = shading_.color.at(static_cast<std::int32_t>(fragments_[i].x),
                                                 static_cast<std::int32_t>(fragments_[i].y));
            held = blended(shading_.blend, colors_[i].color, held);
        }
        count_ = 0;
    }
    [[nodiscard]] Shading const& shading() const noexcept { return shading_; }

  private:
    static constexpr std::size_t size = 256;
    Shading const& shading_;
    std::size_t count_ = 0;
    std::array<backend::Fragment, size> fragments_;
    std::array<backend::FragmentColor, size> colors_;
};

/// Shades the records' samples that pass the test, in order; alpha tests are not looked at.
///
/// returns: how many there are.
[[nodiscard]] inline std::uint64_t shade_records(TileJob const& job, FragmentBatch& batch, Record const* records,
                                                 std::span<std::uint32_t const> entries) {
    backend::FragmentTest const test = batch.shading().test;
    std::uint64_t shaded = 0;
    for (std::uint32_t const entry : entries) {
        Record const& record = records[entry];
        for_each_covered(job, record, [&](std::int32_t x, std::int32_t y, float depth) {
            float& held = held_depth(job, x, y);
            bool const nearer = job.reversed ? depth > held : depth < held;
            if (test == backend::FragmentTest::visible ? depth != held : !nearer) return;
            if (test == backend::FragmentTest::nearer) held = depth;
            batch.add(x, y, record.id, depth);
            ++shaded;
        });
    }
    return shaded;
}

}  // namespace gnomon::raster::detail

namespace gnomon::raster {

/// Draws `draws` into `layer` as `layered_pass` does, but shades.
///
/// expects: a layer without triangle ids, whose colour image has its size.
PassStats shading_pass(std::span<Draw const> draws, Layer const& layer, detail::Shading const& shading, Workspace& workspace,
                       core::ExecutorRef executor);

}  // namespace gnomon::raster
