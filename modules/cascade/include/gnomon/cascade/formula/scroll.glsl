// One texel of a scrolled map: what stood a shift away, moved in depth; "nothing drawn" stays so, and so does what lies
// beyond the old map's border.
//
// A shader defines GN_TEXELS and GN_TEXEL(texels, x, y), the depth that texel (x, y) of the old map holds, before it
// includes this file.
//
// source: [CSM Scrolling, 4.1 to 4.3]; in whole codes, and for reversed depth with the clear value and all signs turned

#ifndef GNOMON_CASCADE_FORMULA_SCROLL_GLSL
#define GNOMON_CASCADE_FORMULA_SCROLL_GLSL

#include <gnomon/math/formula.glsl>
#include <gnomon/math/formula/bits.glsl>

GN_BEGIN

struct GnScroll {
    int dx;       // texels: new texel x shows what old texel x + dx showed
    int dy;
    float add;    // to forward depth, in units of `last`: codes, or depth * 1
    float last;   // 65535 (codes of 16 bits) or 1 (float): of a texel on which nothing was drawn, in forward depth
    int size_px;
    uint reversed;  // 0 or 1
    uint unorm16;   // 1: GN_TEXEL gives c / 65535, and so does the result
    uint unused;
};

/// A held depth after a move by `add`. Sums are exact for whole codes up to 2^24, and for their 2^-24th parts.
///
/// source: [CSM Scrolling, 4.3]: old < 1 ? clamp(old + offset) : 1
GN_FN GN_FLOAT gn_scrolled(GN_FLOAT held, float add, float last, bool reversed) {
    GN_PRECISE GN_FLOAT sum = held + GN_FLOAT(reversed ? -add : add);
    GN_FLOAT moved = GN_SELECT(sum < 0.0, 0.0, GN_SELECT(sum > last, last, sum));
    GN_BOOL drawn = reversed ? held > 0.0 : held < last;
    return GN_SELECT(drawn, moved, GN_FLOAT(reversed ? 0.0f : last));
}

/// The same of a code that is an integer.
///
/// expects: 0 <= held <= last, |add| <= last <= 2^24.
GN_FN GN_INT gn_scrolled_code(GN_INT held, int add, int last, bool reversed) {
    GN_INT moved = gn_min(gn_max(held + (reversed ? -add : add), GN_INT(0)), GN_INT(last));
    int clear = reversed ? 0 : last;
    return GN_SELECT(held == clear, GN_INT(clear), moved);
}

/// The depth of texel (x, y) of the scrolled map.
///
/// expects: 0 <= x, y < size_px; |dx|, |dy| <= size_px
GN_TEXELS_FN GN_FLOAT gn_scrolled_texel(GN_IN(GnScroll) scroll, GN_TEXELS texels, GN_INT x, GN_INT y) {
    bool reversed = scroll.reversed != 0u;
    GN_INT from_x = x + scroll.dx;
    GN_INT from_y = y + scroll.dy;
    GN_INT most = GN_INT(scroll.size_px - 1);
    GN_INT held_x = gn_min(gn_max(from_x, GN_INT(0)), most);
    GN_INT held_y = gn_min(gn_max(from_y, GN_INT(0)), most);
    GN_BOOL inside = held_x == from_x && held_y == from_y;
    GN_FLOAT texel = GN_TEXEL(texels, held_x, held_y);
    GN_FLOAT held = scroll.unorm16 != 0u ? gn_code_of_depth(texel) : texel;
    GN_FLOAT moved = GN_SELECT(inside, gn_scrolled(held, scroll.add, scroll.last, reversed),
                               GN_FLOAT(reversed ? 0.0f : scroll.last));
    return scroll.unorm16 != 0u ? gn_depth_of_code(moved) : moved;
}

GN_END

#endif  // GNOMON_CASCADE_FORMULA_SCROLL_GLSL
