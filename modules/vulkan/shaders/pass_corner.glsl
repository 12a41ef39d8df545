// Clip coordinates of a corner: the CPU kernels' bits.

#include <gnomon/math/formula/view.glsl>

layout(set = 0, binding = 2, std430) readonly buffer Matrices { vec4 matrices[]; };

vec4 clip_of(Item item, uint view, vec3 position) {
    mat4 m;
    if (item.matrix != none) {
        uint at = (item.matrix * push.matrix_views + view) * 4u;
        for (int i = 0; i < 4; ++i) m[i] = matrices[at + uint(i)];
    } else {
        for (int i = 0; i < 4; ++i) m[i] = views[view].column[i];
        position -= views[view].origin;
    }
    return gn_clip_of_corner(m, position);
}
