#pragma once
// What the sources of the technique `shadow-map` share.

#include <gnomon/backend/pass.hpp>
#include <gnomon/shadow/lookup.hpp>

#include "../detail.hpp"
#include "kernels.hpp"
#include "../workspace.hpp"

#include <cstddef>
#include <cstdint>

namespace gnomon::pipeline {

struct ShadowMapOptions {
    std::int32_t resolution = 0;
    shadow::Format format = shadow::Format::f32;
    math::Depth depth = math::Depth::reversed;
    raster::Cull cull = raster::Cull::none;
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

[[nodiscard]] ShadowLookupStd to_std(Frame const& frame, ShadowMapOptions const& options, std::size_t maps) noexcept;

/// Draws the maps again with triangle ids, and asks each shadowed sample whose triangles shadow it.
Result<core::Done> examine_shadow_map(TechniqueRun const& on, TechniqueOutput& output);

}  // namespace gnomon::pipeline
