#version 450
// The matrices of instances in the views of a pass: backend::clip_from_instance, each element summed in double.
#extension GL_GOOGLE_include_directive : require

#include "pass_interface.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 8, std430) readonly buffer Instances { vec4 instances[]; };
layout(set = 0, binding = 2, std430) writeonly buffer Matrices { vec4 matrices[]; };

void main() {
    uint at = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x;  // A column of a matrix.
    uint column = at % 4u;
    uint view = push.first_view + (at / 4u) % push.layers;
    uint instance = at / (4u * push.layers);
    if (instance >= push.instanced) return;
    vec4 from = instances[4u * instance + column];
    double w = double(from.w);
    dvec3 relative;
    for (int k = 0; k < 3; ++k) relative[k] = double(from[k]) - double(views[view].origin[k]) * w;
    vec4 product;
    for (int row = 0; row < 4; ++row) {
        double sum = double(views[view].column[0][row]) * relative[0];
        sum += double(views[view].column[1][row]) * relative[1];
        sum += double(views[view].column[2][row]) * relative[2];
        sum += double(views[view].column[3][row]) * w;
        product[row] = float(sum);
    }
    matrices[4u * (instance * push.matrix_views + view) + column] = product;
}
