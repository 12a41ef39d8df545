#pragma once
// The parameters that techniques with maps of whole lights have in common.

#include <gnomon/pipeline/technique.hpp>
#include <gnomon/raster/target.hpp>
#include <gnomon/shadow/lookup.hpp>

#include <array>
#include <string_view>

namespace gnomon::pipeline {

inline constexpr std::array<std::string_view, 2> map_formats{"f32", "unorm16"};
inline constexpr std::array<std::string_view, 2> map_depths{"reversed", "forward"};
inline constexpr std::array<std::string_view, 2> bias_modes{"auto", "manual"};
inline constexpr std::array<std::string_view, 2> on_off{"on", "off"};
inline constexpr std::array<std::string_view, 2> bias_units{"texels", "m"};
inline constexpr std::array<std::string_view, 3> map_culls{"none", "back", "front"};
inline constexpr std::array<std::string_view, 2> range_fits{"tight", "steps"};

inline constexpr std::array<ParamInfo, 12> shadow_map_params{{
    {"resolution", ParamKind::integer, "2048", 16, raster::max_size_px, "texels", {}, "side of the map, or of each of a point light's six maps"},
    {"format", ParamKind::choice, "f32", 0, 0, "", map_formats, "how a depth is stored"},
    {"depth", ParamKind::choice, "reversed", 0, 0, "", map_depths,
     "1 at the near plane and 0 at the far one, or the other way"},
    {"pcf", ParamKind::integer, "3", 1, shadow::max_taps, "texels", {}, "width of the filter: 1 compares one texel, 2 blends 2x2, n averages a box of n-1 texels"},
    {"bias", ParamKind::choice, "auto", 0, 0, "", bias_modes,
     "auto: what the map's own errors need, and the three below on top; manual: only those"},
    {"constant", ParamKind::real, "0", -1e4, 1e4, "units", {}, "bias toward the light"},
    {"slope", ParamKind::real, "0", -1e4, 1e4, "units", {}, "bias times tan of the angle between normal and light"},
    {"normal", ParamKind::real, "0", -1e4, 1e4, "units", {}, "shift along the normal, times sin of that angle"},
    {"unit", ParamKind::choice, "texels", 0, 0, "", bias_units, "of the three above"},
    {"plane", ParamKind::choice, "on", 0, 0, "", on_off,
     "compare each texel with the receiver's plane, not with its point"},
    {"cull", ParamKind::choice, "none", 0, 0, "", map_culls, "casters left out of the map by the way they face the light"},
    {"fit", ParamKind::choice, "tight", 0, 0, "", range_fits,
     "depth range of a spot or point light: what the casters take up, or that in steps of a fourth of an octave, which holds while casters move a little"},
}};

}  // namespace gnomon::pipeline
