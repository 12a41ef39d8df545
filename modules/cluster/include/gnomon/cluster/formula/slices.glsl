// Which depth slice holds a depth: a table says it, comparisons of integers decide it, on every machine alike.
//
// A shader defines GN_WORDS and GN_WORD(words, i), see math/README.md, before it includes this file. The words are
// cluster::DepthSlices::words(), the header its table().

#ifndef GNOMON_CLUSTER_FORMULA_SLICES_GLSL
#define GNOMON_CLUSTER_FORMULA_SLICES_GLSL

#include <gnomon/math/formula.glsl>
#include <gnomon/math/formula/bits.glsl>

GN_BEGIN

// The order of floats, from the first plane's place on, in equal parts of 2^shift places. Over one binade a float's
// place runs nearly as its logarithm, so parts and exponential slices go at one pace.
struct GnSliceTable {
    int base;      // the first plane's place
    int shift;
    uint parts;
    uint guesses;  // where the parts' words begin; those before are the planes' places
    uint step;     // the highest of the search's steps, a power of two; 0: no part holds a plane within
    uint slices;
};

/// cluster::slice_at: how many of the planes between slices lie at `depth` or before it.
///
/// A part's word is the slice of its first float; it holds fewer than 2 step planes, so bisection over 2 step ends on
/// the last that is not beyond. Places of planes are sorted and followed by places beyond all floats.
GN_WORDS_FN GN_UINT gn_slice_at(GN_IN(GnSliceTable) table, GN_WORDS words, GN_FLOAT depth) {
    GN_INT place = gn_ordinal(depth);
    place = gn_max(GN_SELECT(place > 0x7F800000, GN_INT(table.base), place), GN_INT(table.base));  // NaN: in front
    GN_UINT part = gn_min((GN_UINT(place) - uint(table.base)) >> table.shift, GN_UINT(table.parts - 1u));
    GN_UINT slice = GN_WORD(words, part + table.guesses);
    for (uint step = table.step; step != 0u; step = step >> 1) {
        GN_UINT next = slice + step;
        slice = GN_SELECT(GN_INT(GN_WORD(words, next)) <= place, next, slice);
    }
    return slice;
}

GN_END

#endif  // GNOMON_CLUSTER_FORMULA_SLICES_GLSL
