#pragma once
// Which cascade a point of the view looks into: the same text in C++ and in shaders, formula/select.glsl.
//
// By depth, cascades end where the splits end. By map, a point looks into the finest map that holds it, which uses all
// of every map, beside the view's own part too.

#include <gnomon/cascade/cascades.hpp>
#include <gnomon/cascade/formula/select.glsl>

#include <type_traits>

namespace gnomon::cascade {

/// What shaders get (std430), made of splits.
using CascadeDepths = formula::GnCascadeDepths;
/// The same of placed maps.
using CascadeMaps = formula::GnCascadeMaps;

static_assert(sizeof(CascadeDepths) == 80 && std::is_trivially_copyable_v<CascadeDepths>);
static_assert(sizeof(CascadeMaps) == 8 * 32 + 16 && std::is_trivially_copyable_v<CascadeMaps>);

/// `blend` of the light comes from `next`, the rest from `cascade`; either is the number of cascades where there is
/// none.
struct CascadeChoice {
    std::uint32_t cascade = 0;
    std::uint32_t next = 0;
    float blend = 0.0F;

    friend bool operator==(CascadeChoice const&, CascadeChoice const&) noexcept = default;
};

[[nodiscard]] inline CascadeDepths cascade_depths(Splits const& splits) noexcept {
    CascadeDepths depths{};
    depths.count = splits.count;
    for (std::uint32_t k = 0; k < splits.count; ++k) {
        depths.blend_m[k] = static_cast<float>(splits.of[k].blend_m);
        depths.end_m[k] = static_cast<float>(splits.of[k].end_m);
    }
    return depths;
}

[[nodiscard]] inline CascadeDepths cascade_depths(CascadeFrame const& frame) noexcept {
    Splits splits;
    splits.count = frame.count;
    for (std::uint32_t k = 0; k < frame.count; ++k) splits.of[k] = frame.cascades[k].depths;
    return cascade_depths(splits);
}

/// The first cascade that ends beyond `depth_m`, metres along the axis of sight.
///
/// returns: cascade 0 for NaN and in front of all; no cascade beyond the last end
[[nodiscard]] inline CascadeChoice choose_by_depth(CascadeDepths const& depths, float depth_m) noexcept {
    auto const chosen = gn_cascade_by_depth(depths, formula::Float<float>(depth_m));
    return {chosen.cascade.v, chosen.next.v, chosen.blend.v};
}

struct MapChoiceConfig {
    math::dvec3 origin_m{0.0, 0.0,
                         0.0};  ///< In the world: what shaded positions are relative to, best near the camera.
    float border_px = 2.0F;     ///< Texels that a lookup reads beyond its point.
    float fade_px = 16.0F;      ///< The blend to the next map begins this far within that border.
};

/// The maps of a frame, for positions along the light's axes relative to `origin_m`.
[[nodiscard]] inline CascadeMaps cascade_maps(CascadeFrame const& frame, MapChoiceConfig const& config) noexcept {
    CascadeMaps maps{};
    maps.count = frame.count;
    math::dvec3 const origin = light_from_relative(frame.light, config.origin_m - frame.anchor_m);
    for (std::uint32_t k = 0; k < frame.count; ++k) {
        Volume const& v = frame.cascades[k].volume;
        double const codes = static_cast<double>(v.codes);
        math::dvec3 const offset(origin.x / v.texel_m - static_cast<double>(v.at.x),
                                 origin.y / v.texel_m - static_cast<double>(v.at.y),
                                 (origin.z / v.depth_unit_m - static_cast<double>(v.at.z)) / codes);
        maps.map[k] = {static_cast<float>(1.0 / v.texel_m),
                       static_cast<float>(1.0 / (v.depth_unit_m * codes)),
                       static_cast<float>(v.size_px),
                       config.border_px,
                       math::to_float(offset),
                       config.fade_px};
    }
    return maps;
}

/// The light's axes times a position relative to the origin of the maps.
[[nodiscard]] inline math::vec3 along_light(LightFrame const& light, math::vec3 const& relative_m) noexcept {
    return math::to_float(light_from_relative(light, math::to_double(relative_m)));
}

/// The first map that holds the point, `border_px` texels from its side, and the second one that does.
///
/// returns: no cascade for a point that no map holds, and for NaN
[[nodiscard]] inline CascadeChoice choose_by_map(CascadeMaps const& maps, math::vec3 const& light_m) noexcept {
    auto const chosen = gn_cascade_by_map(maps, formula::Vec3<float>(light_m));
    return {chosen.cascade.v, chosen.next.v, chosen.blend.v};
}

}  // namespace gnomon::cascade
