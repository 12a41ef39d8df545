// The whole lookup of one shadow map.
//
// A shader defines GN_TEXELS, the type of what `texels` is (an int for an array layer, a struct of its own for an atlas
// tile), and GN_TEXEL(texels, x, y), the depth that texel (x, y) of it holds, before it includes this file.

#ifndef GNOMON_SHADOW_FORMULA_LOOKUP_GLSL
#define GNOMON_SHADOW_FORMULA_LOOKUP_GLSL

#include <gnomon/math/formula.glsl>
#include <gnomon/math/formula/bits.glsl>
#include <gnomon/shadow/formula/bias.glsl>
#include <gnomon/shadow/formula/map.glsl>
#include <gnomon/shadow/formula/pcf.glsl>
#include <gnomon/shadow/formula/receiver.glsl>

GN_BEGIN

/// See shadow::Prepared.
GN_STRUCT(GnPrepared) {
    GN_TYPE(GnReceiver) at;
    GN_FLOAT depth;
    GN_FLOAT bias_m;
    GN_BOOL faces_away;
};

/// shadow::prepare: projected, offset and biased. Where a plane faces away the rest means nothing; where the receiver
/// is not in front, `bias_m` is the normal offset's.
GN_FN GN_TYPE(GnPrepared) gn_prepare(GN_IN(GnShadowMap) map, GN_VEC3 position, GN_VEC3 normal,
                                     GN_IN(GnShadowConfig) config) {
    GN_PRECISE GN_TYPE(GnPrepared) ready;
    ready.at = gn_receiver_at(map, position, normal);
    GN_BOOL seen = ready.at.in_front;
    ready.faces_away = seen && ready.at.cos_angle <= 7.74860382080078125e-7;  // 13 e, see shadow::edge_on_cos
    GN_FLOAT along_light = GN_FLOAT(0.0);
    if (config.normal_offset != 0.0f) {
        GN_VEC3 moved = gn_offset_position(ready.at, position, normal, config);
        GN_PRECISE GN_VEC3 way = moved - position;
        GN_PRECISE GN_FLOAT length_along = gn_sqrt(gn_dot(way, way)) * ready.at.cos_angle;
        along_light = GN_SELECT(seen, length_along, 0.0);
        ready.at = gn_receiver_at(map, moved, normal);
        ready.at.in_front = seen && ready.at.in_front;
    }
    GN_TYPE(GnBias) bias = gn_bias_at(map, ready.at, position, config);
    GN_PRECISE GN_FLOAT total_m = along_light + bias.metres;
    ready.bias_m = GN_SELECT(ready.at.in_front, total_m, along_light);
    GN_PRECISE GN_FLOAT raised = ready.at.depth + bias.depth;
    GN_PRECISE GN_FLOAT lowered = ready.at.depth - bias.depth;
    ready.depth = map.reversed != 0u ? raised : lowered;
    if (config.receiver_plane == 0u) ready.at.gradient = GN_VEC2(0.0, 0.0);
    return ready;
}

/// shadow::plane_depth: what texel (x, y) is compared with.
GN_FN GN_FLOAT gn_plane_depth(GN_IN(GN_TYPE(GnPrepared)) ready, bool reversed, GN_INT x, GN_INT y) {
    GN_PRECISE GN_FLOAT dx = GN_FLOAT(x) + 0.5 - ready.at.texel.x;
    GN_PRECISE GN_FLOAT dy = GN_FLOAT(y) + 0.5 - ready.at.texel.y;
    GN_PRECISE GN_FLOAT slide = ready.at.gradient.x * dx + ready.at.gradient.y * dy;
    GN_BOOL toward_light = reversed ? slide > 0.0 : slide < 0.0;
    GN_PRECISE GN_FLOAT depth = ready.depth + GN_SELECT(toward_light, slide, 0.0);
    return gn_to_unit(depth);
}

/// The compare: is the stored depth nearer to the light?
GN_FN GN_BOOL gn_is_nearer(GN_FLOAT stored, GN_FLOAT depth, bool reversed) {
    return reversed ? stored > depth : stored < depth;
}

GN_STRUCT(GnLookup) {
    GN_FLOAT visibility;
    GN_FLOAT bias_m;
};

/// The taps' part of the lookup: 1 minus the weights of the texels nearer to the light.
GN_TEXELS_FN GN_FLOAT gn_filtered(GN_IN(GnShadowMap) map, GN_TEXELS texels, GN_IN(GN_TYPE(GnPrepared)) ready, int taps) {
    bool reversed = map.reversed != 0u;
    GN_TYPE(GnTapRow) columns = gn_taps_at(ready.at.texel.x, taps);
    GN_TYPE(GnTapRow) rows = gn_taps_at(ready.at.texel.y, taps);
    int last_x = int(map.size_px.x) - 1;
    int last_y = int(map.size_px.y) - 1;
    GN_PRECISE GN_FLOAT shadow = GN_FLOAT(0.0);
    for (int j = 0; j < taps; ++j) {
        GN_INT y = rows.first + j;
        GN_INT safe_y = gn_max(gn_min(y, last_y), 0);
        for (int i = 0; i < taps; ++i) {
            GN_INT x = columns.first + i;
            GN_INT safe_x = gn_max(gn_min(x, last_x), 0);
            GN_FLOAT stored = GN_TEXEL(texels, safe_x, safe_y);
            GN_BOOL blocks = gn_is_nearer(stored, gn_plane_depth(ready, reversed, x, y), reversed);
            GN_BOOL inside = x == safe_x && y == safe_y;
            GN_PRECISE GN_FLOAT weight = gn_tap_weight(columns, taps, i) * gn_tap_weight(rows, taps, j);
            shadow = shadow + GN_SELECT(blocks && inside, weight, 0.0);
        }
    }
    GN_PRECISE GN_FLOAT visibility = 1.0 - shadow;
    return gn_to_unit(visibility);
}

/// shadow::look_up: visibility of `position`, whose surface has the unit geometric normal `normal`.
///
/// expects: 1 <= config.taps <= 15.
GN_TEXELS_FN GN_TYPE(GnLookup) gn_look_up(GN_IN(GnShadowMap) map, GN_TEXELS texels, GN_VEC3 position, GN_VEC3 normal,
                                          GN_IN(GnShadowConfig) config) {
    GN_TYPE(GnPrepared) ready = gn_prepare(map, position, normal, config);
    GN_BOOL compares = ready.at.in_front && !ready.faces_away;
    GN_TYPE(GnLookup) seen;
    seen.visibility = GN_SELECT(ready.faces_away, 0.0, 1.0);
    seen.bias_m = GN_SELECT(ready.faces_away, 0.0, ready.bias_m);
    if (GN_ANY(compares))
        seen.visibility = GN_SELECT(compares, gn_filtered(map, texels, ready, config.taps), seen.visibility);
    return seen;
}

GN_END

#endif  // GNOMON_SHADOW_FORMULA_LOOKUP_GLSL
