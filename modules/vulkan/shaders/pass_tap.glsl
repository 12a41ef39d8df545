// The bilinear tap of math::make_tap, in REAL: float or double.

const uint repeat = 0u;
const uint clamped = 1u;

/// The two texels around a coordinate, and the weight of the second.
void make_tap(REAL u, int size, uint wrap, out ivec2 at, out REAL weight) {
    REAL zero = REAL(0.0);
    REAL one = REAL(1.0);
    REAL reduced = u >= zero && u < one ? u : u - floor(u);
    if (wrap == clamped) reduced = u < zero ? zero : u > one ? one : u;
    if (wrap > clamped) reduced = u - REAL(2.0) * floor(u * REAL(0.5));
    if (!(reduced >= zero && reduced <= REAL(2.0))) reduced = zero;
    REAL place = reduced * REAL(size) - REAL(0.5);
    REAL low = floor(place);
    weight = place - low;
    at = ivec2(int(low), int(low) + 1);
    for (int i = 0; i < 2; ++i) {
        if (wrap == repeat) at[i] = at[i] < 0 ? size - 1 : at[i] < size ? at[i] : 0;
        else if (wrap == clamped) at[i] = at[i] < 0 ? 0 : at[i] < size ? at[i] : size - 1;
        else at[i] = at[i] < 0 ? 0 : at[i] < size ? at[i] : at[i] < 2 * size ? 2 * size - 1 - at[i] : 0;
    }
}

REAL texel(AlphaTest test, int column, int row) {
    uint at = test.first_texel + uint(row) * uint(test.width) + uint(column);
    return REAL((texels[at >> 2] >> ((at & 3u) * 8u)) & 255u);
}
