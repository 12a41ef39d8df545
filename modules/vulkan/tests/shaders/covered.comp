#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
// out[i] = 1 where a layer of a target holds another depth than 0.
#include "gnomon/backend/item.glsl"
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) writeonly buffer Outputs { uint value[]; } outputs;
layout(set = 0, binding = 1) uniform texture2DArray depths;
layout(push_constant) uniform Covered { uint width; uint height; uint layer; } covered;
void main() {
    uint i = GNOMON_ITEM;
    if (i >= covered.width * covered.height) return;
    ivec3 texel = ivec3(i % covered.width, i / covered.width, covered.layer);
    outputs.value[i] = texelFetch(depths, texel, 0).x != 0.0 ? 1u : 0u;
}
