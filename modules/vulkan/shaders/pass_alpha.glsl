// The alpha test in float, from interpolated coordinates and four texels.

const uint repeat = 0u;
const uint clamped = 1u;

/// The tap of math::make_tap: first texel, weight of the second.
void make_tap(float u, int size, uint wrap, out ivec2 at, out float weight) {
    float reduced = u >= 0.0 && u < 1.0 ? u : u - floor(u);
    if (wrap == clamped) reduced = clamp(u, 0.0, 1.0);
    if (wrap > clamped) reduced = u - 2.0 * floor(u * 0.5);
    if (!(reduced >= 0.0 && reduced <= 2.0)) reduced = 0.0;
    float place = reduced * float(size) - 0.5;
    float low = floor(place);
    weight = place - low;
    at = ivec2(int(low), int(low) + 1);
    for (int i = 0; i < 2; ++i) {
        if (wrap == repeat) at[i] = at[i] < 0 ? size - 1 : at[i] < size ? at[i] : 0;
        else if (wrap == clamped) at[i] = at[i] < 0 ? 0 : at[i] < size ? at[i] : size - 1;
        else at[i] = at[i] < 0 ? 0 : at[i] < size ? at[i] : at[i] < 2 * size ? 2 * size - 1 - at[i] : 0;
    }
}

float texel(AlphaTest test, int column, int row) {
    uint at = test.first_texel + uint(row) * uint(test.width) + uint(column);
    return float((texels[at >> 2] >> ((at & 3u) * 8u)) & 255u);
}

/// math::alpha_at times 255; a constant alpha comes out as it is.
bool passes(AlphaTest test, Item item) {
    ivec2 x;
    ivec2 y;
    vec2 weight;
    make_tap(uv.x, test.width, test.wrap_u, x, weight.x);
    make_tap(uv.y, test.height, test.wrap_v, y, weight.y);
    float top = texel(test, x[0], y[0]);
    top += (texel(test, x[1], y[0]) - top) * weight.x;
    float bottom = texel(test, x[0], y[1]);
    bottom += (texel(test, x[1], y[1]) - bottom) * weight.x;
    return top + (bottom - top) * weight.y >= test.least;
}
