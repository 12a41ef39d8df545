#version 450
#extension GL_GOOGLE_include_directive : require
// out[i] = in[i] * scale + bias over any number of items.
#include "gnomon/backend/item.glsl"
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Inputs { uint value[]; } inputs;
layout(std430, set = 0, binding = 1) writeonly buffer Outputs { uint value[]; } outputs;
layout(push_constant) uniform Affine { uint count; uint scale; uint bias; } affine;
void main() {
    uint i = GNOMON_ITEM;
    if (i >= affine.count) return;
    outputs.value[i] = inputs.value[i] * affine.scale + affine.bias;
}
