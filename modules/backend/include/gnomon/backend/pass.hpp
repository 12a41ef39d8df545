#pragma once
// Where and how draws are drawn: targets, their planes, and the layers of a pass.

#include <gnomon/math/vec.hpp>
#include <gnomon/math/view.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace gnomon::backend {

inline constexpr std::uint32_t no_triangle = ~0U;  ///< What a target with triangle ids holds where nothing was drawn.

/// Pixels [x, x + width) x [y, y + height), (0, 0) on top and left; empty when a size is not above 0.
struct Rect {
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::int32_t width = 0;
    std::int32_t height = 0;

    friend bool operator==(Rect const&, Rect const&) noexcept = default;
};

/// What happens in front of the near plane and beyond the far plane.
enum class DepthRange : std::uint8_t {
    clip,   ///< Cut away there, as a camera does.
    clamp,  ///< Kept, with depth 0 or 1 ("pancaking"): casters between the light and its near plane stay casters.
};

/// What a target's pixels hold when the pass begins.
enum class Load : std::uint8_t {
    clear,  ///< The farthest depth, and no triangle.
    keep,   ///< What the target holds: draw on top. Depths must be in [0, 1].
};

enum class DepthFormat : std::uint8_t {
    f32,      ///< Depths as they are.
    unorm16,  ///< Codes c that stand for c / 65535, rounded to nearest before they are compared.
};

/// An image of a target.
enum class Plane : std::uint8_t {
    depth,
    triangle,  ///< Ids of 32 bits: `Draw::first_triangle` + the triangle's place.
    color,     ///< Four floats, which only `shade` writes.
};

/// An image to draw into: array layers of one size, each with a depth and, if asked for, a triangle id a pixel.
struct TargetConfig {
    math::ivec2 size_px{0, 0};
    std::uint32_t layers = 1;  ///< 6 for a cube, 1 for an atlas.
    DepthFormat depth = DepthFormat::f32;
    bool triangle_ids = false;  ///< Passes write ids too; needs `DepthFormat::f32`.
    bool color = false;         ///< For `shade`; needs `DepthFormat::f32`.
};

[[nodiscard]] constexpr std::size_t bytes_per_pixel(TargetConfig const& target, Plane plane) noexcept {
    if (plane == Plane::color) return 16;
    return plane == Plane::depth && target.depth == DepthFormat::unorm16 ? 2 : 4;
}

/// One view of a pass: where in the target it lands and what it shows.
///
/// The area that is cleared and drawn is viewport and scissor and target in common; nothing outside of it changes.
struct PassLayer {
    math::vec3 origin{0.0F, 0.0F, 0.0F};       ///< In place of `Draw::origin`.
    math::mat4 clip_from_relative{1.0F};       ///< In place of `Draw::clip_from_relative`.
    std::uint64_t groups = ~std::uint64_t{0};  ///< Takes the draws that share a bit with it: `Draw::groups`.
    std::uint32_t layer = 0;                   ///< Of the target's array.
    std::optional<Rect> viewport{};  ///< Where clip space [-1, 1] lands; may stick out. Default: the whole layer.
    /// `draw` and `shade` move the image right and down by so many 1/256 pixels, each from -127 to 127: pixels then show
    /// what is at another place than their centres, as samples of antialiasing are.
    math::ivec2 subpixel{0, 0};
    std::optional<Rect> scissor{};   ///< Cuts the viewport: the strip that a cache redraws. Default: all of it.
    math::Depth depth = math::Depth::reversed;
    DepthRange range = DepthRange::clip;
    Load load = Load::clear;
};

/// What a pass was asked to draw.
struct PassCounts {
    std::uint64_t triangles = 0;   ///< Of all draws and instances, once for each layer that takes them.
    std::uint64_t draw_calls = 0;  ///< That the backend issues: one for many draws where it can.

    friend bool operator==(PassCounts const&, PassCounts const&) noexcept = default;
};

}  // namespace gnomon::backend
