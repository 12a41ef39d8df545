#pragma once
// Shadow maps that are kept, as pictures: what was kept of each, and what was drawn. [CSM Scrolling, figures 3 and 4]

#include <gnomon/backend/pass.hpp>
#include <gnomon/cascade/step.hpp>
#include <gnomon/math/view.hpp>
#include <gnomon/pipeline/image.hpp>

#include "../staged.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::pipeline {

/// What a map held at three points of a frame: texels as they are stored, rows from the top. Empty: there was none.
struct MapSteps {
    std::vector<std::byte> kept;      ///< The static casters' map before anything was drawn to it, scrolled already.
    std::vector<std::byte> content;   ///< The same after that.
    std::vector<std::byte> finished;  ///< With active casters.
    cascade::ExposedRects exposed;    ///< What scrolling left without content.
};

struct MapFormat {
    std::int32_t size_px = 0;
    backend::DepthFormat format = backend::DepthFormat::unorm16;
    math::Depth depth = math::Depth::forward;
};

/// Reads a layer back, once the verbs before it are done.
void note(Verbs& verbs, backend::TargetId target, std::uint32_t layer, MapFormat const& format, std::vector<std::byte>& bytes);

/// The whole map, of one that kept nothing.
[[nodiscard]] inline cascade::ExposedRects all_exposed(std::int32_t size_px) noexcept {
    return {1, {cascade::TexelRect{0, 0, size_px, size_px}, cascade::TexelRect{}}};
}

/// Colours of maps in pictures, linear RGB: four that differ for most eyes, then the same paler.
inline constexpr std::array<math::vec3, 8> map_tints{
    math::vec3(1.0F, 0.25F, 0.20F), math::vec3(0.20F, 0.80F, 0.25F), math::vec3(0.25F, 0.45F, 1.0F), math::vec3(1.0F, 0.75F, 0.10F),
    math::vec3(1.0F, 0.65F, 0.60F), math::vec3(0.60F, 0.95F, 0.62F), math::vec3(0.65F, 0.78F, 1.0F), math::vec3(1.0F, 0.92F, 0.60F)};

/// A column for each map. From the top: the finished map in grey, what active casters cover in amber; what was kept, in
/// blue; what was drawn to the static casters' map, in red over what was kept. Darker is nearer to the light; white is
/// empty, and pale red what a strip left empty.
///
/// A pixel a texel; of maps above 512 texels each pixel shows the most telling of several.
/// expects: `finished` of each is there.
[[nodiscard]] Image picture_of_maps(std::span<MapSteps const> maps, MapFormat const& format);

}  // namespace gnomon::pipeline
