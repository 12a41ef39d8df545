#version 450
#extension GL_EXT_samplerless_texture_functions : require
// Packs a layer's depths into a buffer.
layout(local_size_x = 64) in;
struct Item { vec3 a; float b; mat4 m; uint list[3]; };
layout(std430, set = 0, binding = 0) writeonly buffer Depths { float value[]; } depths;
layout(set = 0, binding = 1) uniform texture2DArray target;
layout(std430, set = 0, binding = 0) buffer Unused { Item items[]; };
layout(push_constant) uniform Where { uvec2 size; uint layer; } where;
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= where.size.x * where.size.y) return;
    depths.value[i] = texelFetch(target, ivec3(i % where.size.x, i / where.size.x, where.layer), 0).x;
}
