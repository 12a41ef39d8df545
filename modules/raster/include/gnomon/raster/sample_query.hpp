#pragma once
// Occlusion queries on the CPU: how many samples of a depth image would a box, a mesh or a rectangle pass the depth test
// at, if it were drawn? Exact: coverage, clipping and depth are those of the passes, because the same kernels decide.

#include <gnomon/core/executor.hpp>
#include <gnomon/math/bounds.hpp>
#include <gnomon/raster/draw.hpp>
#include <gnomon/raster/layers.hpp>
#include <gnomon/raster/target.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace gnomon::raster {

/// The two triangles of each face of a box, as a query draws it: indices of `math::corner`, front faces outside.
inline constexpr std::array<std::uint32_t, 36> box_indices{0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                                           2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};

/// One bit per pixel, 32 to a word, the first pixel in the lowest bit; rows are `words_per_row` apart.
struct BitMaskView {
    std::uint32_t const* words = nullptr;
    std::ptrdiff_t words_per_row = 0;
};

/// Samples of a rectangle at one depth: a light's screen rectangle, a tile, a footprint.
struct RectQuery {
    Rect rect;           ///< In pixels of the image; the scissor rectangle cuts it.
    float depth = 0.0F;  ///< In [0, 1]. A 16-bit image compares its code.
    BitMaskView mask{};  ///< With words: only pixels with a set bit count. Bit (0, 0) is the rectangle's first pixel.
};

/// Memory that queries work in; kept between frames it stops growing. One batch of queries at a time.
class QueryWorkspace {
  public:
    QueryWorkspace();
    ~QueryWorkspace();
    QueryWorkspace(QueryWorkspace&&) noexcept;
    QueryWorkspace& operator=(QueryWorkspace&&) noexcept;

    [[nodiscard]] std::size_t size_bytes() const noexcept;
    struct State;
    [[nodiscard]] State& state() noexcept { return *state_; }

  private:
    std::unique_ptr<State> state_;
};

/// Number of samples at which at least one triangle of `draws` passes the depth test against `layer.target`.
///
/// That is how many samples `layered_pass` with `Load::keep` would change; a sample that two triangles pass at counts
/// once. The image is only read.
/// expects: what `layered_pass` does. `layer.triangle`, `config.load` and `config.pyramid` are not looked at.
/// cost:    as the pass, over the tiles that the triangles touch.
[[nodiscard]] std::uint64_t count_samples_passing(std::span<Draw const> draws, Layer const& layer,
                                                  QueryWorkspace& workspace);

/// Whether that number is above 0; stops at the first tile with such a sample.
[[nodiscard]] bool any_sample_passing(std::span<Draw const> draws, Layer const& layer, QueryWorkspace& workspace);

/// The same for each of many meshes, in parallel: `out[i]` for `meshes[i]`; 1 or 0 for any.
///
/// expects: `out` as long as `meshes`.
void count_samples_passing(std::span<std::span<Draw const> const> meshes, Layer const& layer,
                           std::span<std::uint64_t> out, QueryWorkspace& workspace, core::ExecutorRef executor);
void any_sample_passing(std::span<std::span<Draw const> const> meshes, Layer const& layer, std::span<std::uint8_t> out,
                        QueryWorkspace& workspace, core::ExecutorRef executor);

/// The same for boxes, drawn as `box_indices` says, both sides. An empty box, or one with a NaN, passes nowhere.
void count_samples_passing(std::span<math::Aabb const> boxes, Layer const& layer, std::span<std::uint64_t> out,
                           QueryWorkspace& workspace, core::ExecutorRef executor);
void any_sample_passing(std::span<math::Aabb const> boxes, Layer const& layer, std::span<std::uint8_t> out,
                        QueryWorkspace& workspace, core::ExecutorRef executor);

/// Number of the rectangle's samples that a surface at `query.depth` would be nearest at.
[[nodiscard]] std::uint64_t count_samples_passing(RectQuery const& query, Layer const& layer) noexcept;
/// Whether that number is above 0; stops at the first such row.
[[nodiscard]] bool any_sample_passing(RectQuery const& query, Layer const& layer) noexcept;

}  // namespace gnomon::raster
