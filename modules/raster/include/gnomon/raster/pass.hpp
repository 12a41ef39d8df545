#pragma once
// The two verbs of the backend: the depth pass and the camera pass.
//
// Coverage is Vulkan's: corners snapped to 1/256 pixel, a sample at each pixel's centre, top-left rule. Depth is
// compared strictly, so equal depths go to the lower triangle id: the first one drawn. The image is the same for any
// executor, kernel and compiler.

#include <gnomon/backend/pass.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/math/view.hpp>
#include <gnomon/raster/depth_pyramid.hpp>
#include <gnomon/raster/draw.hpp>
#include <gnomon/raster/target.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace gnomon::raster {

using backend::DepthRange;
using backend::Load;

enum class Kernel : std::uint8_t {
    automatic,  ///< The fastest that this machine runs.
    scalar,     ///< The reference.
    simd,       ///< The widest vector kernel, or the reference on a machine that has none.
    avx2,       ///< The vector kernel for AVX2, or the reference on a machine that has none.
};

struct PassConfig {
    math::Depth depth = math::Depth::reversed;
    DepthRange range = DepthRange::clip;
    Load load = Load::clear;
    Kernel kernel = Kernel::automatic;
    std::optional<Rect>
        viewport{};  ///< Where clip space [-1, 1] lands; the whole target by default. May stick out of it.
    math::ivec2 subpixel{0, 0};  ///< Moves the image right and down by 1/256 pixels: `backend::PassLayer::subpixel`.
    std::optional<Rect> scissor{};  ///< The only pixels cleared and drawn; the whole target by default.
    DepthPyramid* pyramid = nullptr;  ///< If given, is that of the whole target when the pass ends: see `build_pyramid`.
};

/// Where a pass's triangles went. `triangles` is the sum of the eight counts below it up to `drawn`.
struct PassStats {
    std::uint64_t triangles = 0;
    std::uint64_t bad_index = 0;        ///< An index beyond the positions: left out.
    std::uint64_t not_finite = 0;       ///< A corner that is NaN, infinite or beyond 2^60 in clip space: left out.
    std::uint64_t outside = 0;          ///< Wholly outside the clip volume or the scissor rectangle.
    std::uint64_t degenerate = 0;       ///< No area once snapped.
    std::uint64_t culled = 0;           ///< By the way it faces.
    std::uint64_t no_sample = 0;        ///< Small, and covers no pixel centre. Exact, not a guess.
    std::uint64_t drawn = 0;            ///< Went on to the tiles.
    std::uint64_t clipped = 0;          ///< Went through the clipper; counted above as well.
    std::uint64_t samples_written = 0;  ///< Depth tests passed, in draw order.

    friend bool operator==(PassStats const&, PassStats const&) noexcept = default;
};

/// Memory that a pass works in. Kept between passes it stops growing: after warm-up nothing is allocated.
///
/// One pass at a time. About 16 bytes a vertex and 110 a triangle, of at most a million triangles at a time. Triangles
/// that the clipper cuts into many, or that touch many tiles, can ask for more.
class Workspace {
  public:
    Workspace();
    ~Workspace();
    Workspace(Workspace&&) noexcept;
    Workspace& operator=(Workspace&&) noexcept;

    [[nodiscard]] std::size_t size_bytes() const noexcept;
    struct State;
    [[nodiscard]] State& state() noexcept { return *state_; }

  private:
    std::unique_ptr<State> state_;
};

/// Draws the nearest depths of `draws` into `target`.
///
/// expects: sizes of target and viewport at most `max_size_px`; viewport offsets within +-`max_size_px`. A target
///          without pixels and draws without triangles are legal. Bad data in a draw is left out and counted.
/// returns: the counts. Allocates only what `workspace` lacks.
/// cost:    O(vertices + triangles + samples); vertices, triangles and tiles each in parallel.
PassStats depth_pass(std::span<Draw const> draws, DepthTarget const& target, PassConfig const& config,
                     Workspace& workspace, core::ExecutorRef executor);

/// The same with the id of the triangle that each depth comes from: `Draw::first_triangle` + its place in the draw.
PassStats camera_pass(std::span<Draw const> draws, VisibilityTarget const& target, PassConfig const& config,
                      Workspace& workspace, core::ExecutorRef executor);

/// Whether `Kernel::simd` is a vector kernel on this machine.
[[nodiscard]] bool has_simd_kernel() noexcept;

}  // namespace gnomon::raster
