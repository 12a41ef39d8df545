// Words that are all one value: the GLSL half of `clear_words`.

#version 450
#extension GL_GOOGLE_include_directive : require

#include "gnomon/backend/item.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) writeonly buffer Words { uint words[]; };
layout(push_constant) uniform Constants {
    uint count;
    uint value;
} c;

void main() {
    uint i = GNOMON_ITEM;
    if (i < c.count) words[i] = c.value;
}
