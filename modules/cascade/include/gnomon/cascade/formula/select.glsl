// Which cascade a point looks into, and how much of the next one: by depth from the camera, or by which map holds it.

#ifndef GNOMON_CASCADE_FORMULA_SELECT_GLSL
#define GNOMON_CASCADE_FORMULA_SELECT_GLSL

#include <gnomon/math/formula.glsl>

GN_BEGIN

/// `cascade` is the number of cascades where there is none; `blend` of the result comes from `next`, the rest from
/// `cascade`. With no next cascade it is the number of cascades: no shadow.
GN_STRUCT(GnCascadeChoice) {
    GN_UINT cascade;
    GN_UINT next;
    GN_FLOAT blend;
};

struct GnCascadeDepths {
    float blend_m[8];  // where the blend to the next begins
    float end_m[8];
    uint count;
    uint unused_a;
    uint unused_b;
    uint unused_c;
};

/// The part of [from, to] that lies before x, 0 to 1; 0 for an interval without length and for NaN.
GN_FN GN_FLOAT gn_part_of(GN_FLOAT x, GN_FLOAT from, GN_FLOAT to) {
    GN_PRECISE GN_FLOAT length = to - from;
    GN_PRECISE GN_FLOAT done = x - from;
    GN_BOOL some = length > 0.0 && done > 0.0;
    GN_FLOAT part = gn_div(done, GN_SELECT(some, length, 1.0));
    return GN_SELECT(some, gn_min(part, GN_FLOAT(1.0)), 0.0);
}

/// By the depth along the axis of sight: the first cascade whose end lies beyond it.
///
/// returns: the first cascade for NaN and before it begins, none beyond the last end
GN_FN GN_TYPE(GnCascadeChoice) gn_cascade_by_depth(GN_IN(GnCascadeDepths) depths, GN_FLOAT depth_m) {
    GN_TYPE(GnCascadeChoice) chosen;
    chosen.cascade = GN_UINT(0u);
    GN_FLOAT from = GN_FLOAT(depths.blend_m[0]);
    GN_FLOAT to = GN_FLOAT(depths.end_m[0]);
    for (uint k = 0u; k < depths.count; ++k) {
        GN_BOOL beyond = depth_m >= depths.end_m[k];
        chosen.cascade = GN_SELECT(beyond, GN_UINT(k + 1u), chosen.cascade);
        uint after = k + 1u < depths.count ? k + 1u : k;
        from = GN_SELECT(beyond, GN_FLOAT(depths.blend_m[after]), from);
        to = GN_SELECT(beyond, GN_FLOAT(depths.end_m[after]), to);
    }
    chosen.next = gn_min(chosen.cascade + 1u, GN_UINT(depths.count));
    chosen.blend = GN_SELECT(chosen.cascade < depths.count, gn_part_of(depth_m, from, to), 0.0);
    return chosen;
}

/// A map as a lookup finds its place in it, from metres along the light's axes about one origin for all maps.
struct GnCascadeMap {
    float texels_per_m;
    float depth_per_m;  // depth 0 to 1, forward
    float size_px;
    float border_px;    // what a filter needs beside a point
    vec3 offset;        // texels, texels, depth
    float fade_px;      // the blend to the next map begins this far within the border
};

struct GnCascadeMaps {
    GnCascadeMap map[8];
    uint count;
    uint unused_a;
    uint unused_b;
    uint unused_c;
};

/// Texels right and down in the map, and forward depth.
GN_FN GN_VEC3 gn_in_cascade_map(GN_IN(GnCascadeMap) map, GN_VEC3 light_m) {
    GN_PRECISE GN_FLOAT x = light_m.x * map.texels_per_m + map.offset.x;
    GN_PRECISE GN_FLOAT y = light_m.y * map.texels_per_m + map.offset.y;
    GN_PRECISE GN_FLOAT z = light_m.z * map.depth_per_m + map.offset.z;
    return GN_VEC3(x, y, z);
}

/// How many texels a place is within the border that the filter needs; negative outside, and before or behind the depths.
GN_FN GN_FLOAT gn_texels_within(GN_IN(GnCascadeMap) map, GN_VEC3 place) {
    GN_PRECISE GN_FLOAT right = GN_FLOAT(map.size_px) - place.x;
    GN_PRECISE GN_FLOAT below = GN_FLOAT(map.size_px) - place.y;
    GN_PRECISE GN_FLOAT within = gn_min(gn_min(place.x, right), gn_min(place.y, below)) - GN_FLOAT(map.border_px);
    return GN_SELECT(within >= 0.0 && place.z >= 0.0 && place.z < 1.0, within, -1.0);
}

/// By the maps themselves: the first that holds the point and its filter; the next is the second one that does.
///
/// `light_m` is the point along the light's axes, about the origin that the maps' offsets are for.
/// returns: none for a point that no map holds, and for NaN
GN_FN GN_TYPE(GnCascadeChoice) gn_cascade_by_map(GN_IN(GnCascadeMaps) maps, GN_VEC3 light_m) {
    GN_TYPE(GnCascadeChoice) chosen;
    chosen.cascade = GN_UINT(maps.count);
    chosen.next = GN_UINT(maps.count);
    GN_FLOAT within = GN_FLOAT(0.0);
    GN_FLOAT fade = GN_FLOAT(0.0);
    for (uint k = 0u; k < maps.count; ++k) {
        GN_FLOAT texels = gn_texels_within(maps.map[k], gn_in_cascade_map(maps.map[k], light_m));
        GN_BOOL held = texels >= 0.0;
        GN_BOOL first = held && chosen.cascade == maps.count;
        GN_BOOL second = held && chosen.cascade < GN_UINT(k) && chosen.next == maps.count;
        chosen.next = GN_SELECT(second, GN_UINT(k), chosen.next);
        chosen.cascade = GN_SELECT(first, GN_UINT(k), chosen.cascade);
        within = GN_SELECT(first, texels, within);
        fade = GN_SELECT(first, GN_FLOAT(maps.map[k].fade_px), fade);
    }
    GN_PRECISE GN_FLOAT toward = fade - within;
    GN_FLOAT part = gn_part_of(toward, GN_FLOAT(0.0), fade);
    chosen.blend = GN_SELECT(chosen.next < maps.count, part, 0.0);
    return chosen;
}

GN_END

#endif  // GNOMON_CASCADE_FORMULA_SELECT_GLSL
