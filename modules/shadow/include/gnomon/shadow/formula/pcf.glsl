// Percentage-closer filtering as weights of whole texels, made of texel fetches: no sampler's filter is exact.

#ifndef GNOMON_SHADOW_FORMULA_PCF_GLSL
#define GNOMON_SHADOW_FORMULA_PCF_GLSL

#include <gnomon/math/formula.glsl>

GN_BEGIN

/// See shadow::TapRow.
GN_STRUCT(GnTapRow) {
    GN_INT first;
    GN_FLOAT fraction;
    float scale;
};

/// shadow::taps_at: the taps round image coordinate `texel`; beyond every map where it is not finite or beyond +-2^30.
GN_FN GN_TYPE(GnTapRow) gn_taps_at(GN_FLOAT texel, int taps) {
    float radius = 0.5f * float(taps - 1);
    GN_PRECISE GN_FLOAT start = texel - radius;
    GN_BOOL is_near = start > -1073741824.0 && start < 1073741824.0;
    GN_FLOAT safe = GN_SELECT(is_near, start, 0.0);
    GN_INT whole = GN_INT(safe);  // toward zero
    GN_INT first = whole - GN_SELECT(safe < GN_FLOAT(whole), 1, 0);
    GN_PRECISE GN_TYPE(GnTapRow) row;
    row.first = GN_SELECT(is_near, first, -1073741824);
    row.fraction = safe - GN_FLOAT(first);
    row.scale = taps == 1 ? 1.0f : gn_div(1.0f, float(taps - 1));
    return row;
}

/// Weight of the texel `first + i`.
GN_FN GN_FLOAT gn_tap_weight(GN_IN(GN_TYPE(GnTapRow)) row, int taps, int i) {
    GN_PRECISE GN_FLOAT rest = 1.0 - row.fraction;
    GN_FLOAT share = i == 0 ? rest : (i == taps - 1 ? row.fraction : GN_FLOAT(1.0));
    GN_PRECISE GN_FLOAT weight = share * row.scale;
    return taps == 1 ? GN_FLOAT(1.0) : weight;
}

GN_END

#endif  // GNOMON_SHADOW_FORMULA_PCF_GLSL
