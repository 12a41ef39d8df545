#pragma once
// What the sources of the techniques with maps of whole lights share.

#include <gnomon/backend/pass.hpp>
#include <gnomon/shadow/lookup.hpp>

#include "../detail.hpp"
#include "kernels.hpp"
#include "shadow_maps.hpp"

#include <cstddef>
#include <cstdint>

namespace gnomon::pipeline {

/// Of a local light's depth range.
enum class RangeFit : std::uint8_t {
    tight,  ///< As the casters are.
    steps,  ///< Rounded outward, so that it stays while casters move a little.
};

struct ShadowMapOptions {
    std::int32_t resolution = 0;
    shadow::Format format = shadow::Format::f32;
    math::Depth depth = math::Depth::reversed;
    raster::Cull cull = raster::Cull::none;
    RangeFit fit = RangeFit::tight;
    shadow::LookupConfig lookup;
};

[[nodiscard]] ShadowMapOptions read_shadow_map_options(Params const& params);

[[nodiscard]] inline bool is_narrow(ShadowMapOptions const& options) noexcept {
    return options.format == shadow::Format::unorm16;
}

/// Of one map.
[[nodiscard]] inline std::size_t map_texels(ShadowMapOptions const& options) noexcept {
    return static_cast<std::size_t>(options.resolution) * static_cast<std::size_t>(options.resolution);
}

/// How map `map` is drawn, into layer 0.
///
/// expects: `shadow.views` has it.
[[nodiscard]] backend::PassLayer layer_of(Frame const& frame, ShadowMaps const& shadow, ShadowMapOptions const& options,
                                          std::size_t map);

/// The map that sees a sample: the only one, or the face in its direction.
[[nodiscard]] std::size_t map_of(math::vec3 const& position, math::vec3 const& light, std::size_t maps) noexcept;

[[nodiscard]] ShadowLookupStd to_std(Frame const& frame, ShadowMaps const& shadow, ShadowMapOptions const& options) noexcept;

/// The list of this geometry and side, staged again only where it changed.
void fit_draws(Verbs& verbs, Frame const& frame, ShadowMaps& shadow, raster::Cull cull);
/// The views of the light, as the pass and the lookup need them.
Result<core::Done> fit_views(Frame const& frame, LightPlace const& at, ShadowMaps& shadow, ShadowMapOptions const& options, double nearest_m);
/// Layers for the views, of maps of which there are `copies`.
///
/// returns: whether the target is another one than before.
Result<bool> fit_target(Verbs& verbs, ShadowMaps& shadow, ShadowMapOptions const& options, std::size_t copies);
/// Room for what the lookup answers.
void fit_answers(Verbs& verbs, ShadowMaps& shadow, std::size_t samples);
void look_up_all(Verbs& verbs, TechniqueRun const& on, ShadowMaps& shadow, ShadowMapOptions const& options);
/// Waits, and reads the answers and the stages' times.
Result<TechniqueOutput> read_lookup(Verbs& verbs, TechniqueRun const& on, ShadowMaps const& shadow);

/// Draws the maps again with triangle ids, and asks each shadowed sample whose triangles shadow it.
///
/// expects: `shadow` holds the views, the maps and the list of this run.
Result<core::Done> examine_maps(TechniqueRun const& on, ShadowMaps const& shadow, TechniqueOutput& output);

}  // namespace gnomon::pipeline
