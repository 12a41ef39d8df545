// Clip coordinates of a corner. Sums are in the order of the CPU's kernels, so they are the same bits.

layout(set = 0, binding = 2, std430) readonly buffer Matrices { vec4 matrices[]; };

vec4 clip_of(Item item, uint view, vec3 position) {
    vec4 m[4];
    if (item.matrix != none) {
        uint at = (item.matrix * push.matrix_views + view) * 4u;
        for (int i = 0; i < 4; ++i) m[i] = matrices[at + uint(i)];
    } else {
        for (int i = 0; i < 4; ++i) m[i] = views[view].column[i];
        position -= views[view].origin;
    }
    return ((m[0] * position.x + m[1] * position.y) + m[2] * position.z) + m[3];
}
