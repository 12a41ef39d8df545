// Division and square root rounded as IEEE 754 says, out of approximate ones and exact integers.
//
// Vulkan asks 2.5 units in the last place of a division and about 5 of a square root, so two devices may choose two
// texels for one point. Here the device's own result is only the first guess: the remainder that it leaves, an integer
// of less than 32 bits whatever the size of the products, says how far off it is. No tie is possible in either.

#ifndef GNOMON_MATH_FORMULA_EXACT_GLSL
#define GNOMON_MATH_FORMULA_EXACT_GLSL

#include <gnomon/math/formula.glsl>

GN_BEGIN

/// x's mantissa as a number in [1, 2).
GN_FN GN_FLOAT gn_mantissa(GN_FLOAT x) { return uintBitsToFloat((floatBitsToUint(x) & 0x7FFFFFu) | 0x3F800000u); }

/// x's mantissa as an integer in [2^23, 2^24).
GN_FN GN_UINT gn_mantissa_bits(GN_FLOAT x) { return (floatBitsToUint(x) & 0x7FFFFFu) | 0x800000u; }

/// x's exponent as it is stored: 1 to 254 for a normal number.
GN_FN GN_INT gn_exponent_bits(GN_FLOAT x) { return GN_INT((floatBitsToUint(x) >> 23) & 0xFFu); }

/// The integer nearest to `remainder / unit`.
///
/// expects: a quotient within +-64, a unit of at least 2^23.
GN_FN GN_INT gn_steps_off(GN_INT remainder, GN_UINT unit) {
    // The unit's reciprocal within 6 %: Newton's linear start. What that misses, the caller's last step mends.
    GN_PRECISE GN_FLOAT fraction = GN_FLOAT(unit) * 5.9604644775390625e-8;  // 2^-24: in [0.5, 1)
    GN_PRECISE GN_FLOAT reciprocal = 2.823529481887817 - fraction * 1.8823529481887817;
    GN_PRECISE GN_FLOAT steps = GN_FLOAT(remainder) * 5.9604644775390625e-8 * reciprocal;
    GN_PRECISE GN_FLOAT shifted = steps + 64.5;
    return GN_INT(shifted) - 64;
}

/// a / b, rounded to nearest, from `about`: the quotient of the mantissas, at most 5 units of the last place off.
///
/// returns: `plain` where an operand is not a normal number, or the result not one before it is rounded.
GN_FN GN_FLOAT gn_exact_quotient(GN_FLOAT a, GN_FLOAT b, GN_FLOAT about, GN_FLOAT plain) {
    GN_UINT ma = gn_mantissa_bits(a);
    GN_UINT mb = gn_mantissa_bits(b);
    GN_BOOL below = ma < mb;
    // ma 2^k / mb lies in [2^23, 2^24].
    GN_UINT scaled = GN_SELECT(below, ma << 24, ma << 23);
    GN_PRECISE GN_FLOAT guess = about * GN_SELECT(below, 16777216.0, 8388608.0);
    GN_UINT quotient = GN_UINT(guess);
    GN_INT off = gn_steps_off(GN_INT(scaled - quotient * mb), mb);
    quotient = quotient + GN_UINT(off);
    GN_INT left = GN_INT(scaled - quotient * mb) * 2;
    quotient = quotient + GN_SELECT(left > GN_INT(mb), 1u, 0u) - GN_SELECT(left < -GN_INT(mb), 1u, 0u);

    GN_INT ea = gn_exponent_bits(a);
    GN_INT eb = gn_exponent_bits(b);
    GN_INT e = ea - eb + 127 - GN_SELECT(below, 1, 0);
    GN_BOOL normal = ea > 0 && ea < 255 && eb > 0 && eb < 255 && e > 0 && e < 255;
    // A quotient of 2^24 carries into the exponent, as it should.
    GN_UINT sign = (floatBitsToUint(a) ^ floatBitsToUint(b)) & 0x80000000u;
    GN_UINT magnitude = (GN_UINT(e) << 23) + (quotient - 0x800000u);
    return GN_SELECT(normal, uintBitsToFloat(sign | magnitude), plain);
}

/// x times an even power of two, in [1, 4).
GN_FN GN_FLOAT gn_root_argument(GN_FLOAT x) {
    GN_UINT even = (floatBitsToUint(x) & 0x800000u) ^ 0x800000u;  // the stored exponent is odd for an even power
    return uintBitsToFloat(((floatBitsToUint(x) & 0x7FFFFFu) | 0x3F800000u) + even);
}

/// The root of x, rounded to nearest, from `about`: the root of `gn_root_argument(x)`, at most 8 units of the last place
/// off.
///
/// returns: `plain` where x is no positive normal number; x where it is a zero.
GN_FN GN_FLOAT gn_exact_root(GN_FLOAT x, GN_FLOAT about, GN_FLOAT plain) {
    GN_UINT bits = floatBitsToUint(x);
    GN_UINT m = gn_mantissa_bits(x);
    GN_BOOL odd_power = (bits & 0x800000u) == 0u;
    GN_UINT scaled = GN_SELECT(odd_power, m << 24, m << 23);  // in [2^46, 2^48), of which 32 bits suffice
    GN_PRECISE GN_FLOAT guess = about * 8388608.0;
    GN_UINT root = GN_UINT(guess);
    GN_INT off = gn_steps_off(GN_INT(scaled - root * root), root);
    // The remainder grows by twice the root a step.
    root = root + GN_UINT((off + 64) >> 1) - 32u;
    GN_INT left = GN_INT(scaled - root * root);
    root = root + GN_SELECT(left > GN_INT(root), 1u, 0u) - GN_SELECT(left <= -GN_INT(root), 1u, 0u);

    GN_UINT e = ((bits >> 23) + GN_SELECT(odd_power, 126u, 127u)) >> 1;
    GN_BOOL normal = bits >= 0x800000u && bits < 0x7F800000u;
    GN_FLOAT exact = uintBitsToFloat((e << 23) + (root - 0x800000u));
    return GN_SELECT(normal, exact, GN_SELECT((bits << 1) == 0u, x, plain));
}

GN_END

#ifndef __cplusplus

// C++ has the machine's own. Subnormal operands and results are the device's, which may flush them to zero.
float gn_div(float a, float b) {
    precise float about = gn_mantissa(a) / gn_mantissa(b);
    precise float plain = a / b;
    return gn_exact_quotient(a, b, about, plain);
}

float gn_sqrt(float x) {
    float about = sqrt(gn_root_argument(x));
    float plain = sqrt(x);
    return gn_exact_root(x, about, plain);
}

#endif

#endif  // GNOMON_MATH_FORMULA_EXACT_GLSL
