// Integers in floats' clothes: the order of all floats, Morton codes, 16-bit depth codes. Equal on every machine.

#ifndef GNOMON_MATH_FORMULA_BITS_GLSL
#define GNOMON_MATH_FORMULA_BITS_GLSL

#include <gnomon/math/formula.glsl>

GN_BEGIN

/// The place of x in the order of all floats; both zeros are 0.
GN_FN GN_INT gn_ordinal(GN_FLOAT x) {
    GN_UINT bits = floatBitsToUint(x);
    GN_INT magnitude = GN_INT(bits & 0x7FFFFFFFu);
    return GN_SELECT((bits >> 31) != 0u, -magnitude, magnitude);
}

/// The float at that place.
///
/// expects: the place of a float, so not -2^31.
GN_FN GN_FLOAT gn_from_ordinal(GN_INT place) {
    GN_UINT magnitude = GN_UINT(GN_SELECT(place < 0, -place, place));
    return uintBitsToFloat(magnitude | GN_SELECT(place < 0, 0x80000000u, 0u));
}

/// a with the sign of s.
GN_FN GN_FLOAT gn_with_sign_of(GN_FLOAT a, GN_FLOAT s) {
    return uintBitsToFloat((floatBitsToUint(a) & 0x7FFFFFFFu) | (floatBitsToUint(s) & 0x80000000u));
}

/// Bits 0-9 of `x` spread to every third bit.
GN_FN GN_UINT gn_spread_10(GN_UINT x) {
    GN_UINT a = x & 0x3FFu;
    GN_UINT b = (a | a << 16) & 0x030000FFu;
    GN_UINT c = (b | b << 8) & 0x0300F00Fu;
    GN_UINT d = (c | c << 4) & 0x030C30C3u;
    return (d | d << 2) & 0x09249249u;
}

/// Ten bits of each coordinate interleaved, x lowest.
GN_FN GN_UINT gn_morton_30(GN_UINT x, GN_UINT y, GN_UINT z) {
    return gn_spread_10(x) | gn_spread_10(y) << 1 | gn_spread_10(z) << 2;
}

/// x limited to [0, 1]; a NaN stays one.
GN_FN GN_FLOAT gn_to_unit(GN_FLOAT x) { return GN_SELECT(x < 0.0, 0.0, GN_SELECT(x > 1.0, 1.0, x)); }

/// The nearest 16-bit code, ties to even, as a float.
///
/// expects: a depth in [0, 1].
GN_FN GN_FLOAT gn_code_of_depth(GN_FLOAT depth) {
    GN_PRECISE GN_FLOAT code = (depth * 65535.0 + 8388608.0) - 8388608.0;
    return code;
}

/// The depth that a code stands for.
GN_FN GN_FLOAT gn_depth_of_code(GN_FLOAT code) {
    GN_PRECISE GN_FLOAT depth = code * 1.52590218931436538696e-5;  // the float nearest to 1 / 65535
    return depth;
}

/// The same for a texel that a device has turned into a float itself, up to 1.5 units of the last place off c / 65535.
GN_FN GN_FLOAT gn_depth_of_unorm16(GN_FLOAT texel) { return gn_depth_of_code(gn_code_of_depth(texel)); }

/// The value of a finite IEEE half, from its 16 bits: exact.
GN_FN GN_FLOAT gn_float_of_half(GN_UINT bits) {
    GN_UINT magnitude = bits & 0x7FFFu;
    GN_PRECISE GN_FLOAT small = GN_FLOAT(magnitude) * 5.9604644775390625e-8;  // 2^-24: the last bit of halves below 2^-14
    GN_FLOAT normal = uintBitsToFloat((magnitude << 13) + 0x38000000u);
    GN_FLOAT value = GN_SELECT(magnitude < 0x400u, small, normal);
    return GN_SELECT((bits & 0x8000u) != 0u, -value, value);
}

GN_END

#endif  // GNOMON_MATH_FORMULA_BITS_GLSL
