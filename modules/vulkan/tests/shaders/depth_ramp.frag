#version 450
// A depth of a row's number, the column and another map's code, for write_depth.test.cpp.
#extension GL_EXT_samplerless_texture_functions : require

layout(std430, set = 0, binding = 0) readonly buffer Rows { uint rows[]; };
layout(set = 0, binding = 1) uniform texture2DArray from;
layout(push_constant) uniform Constants {
    uint step;
    uint layer;
    float per_code;  // Of a depth.
    float codes;     // Of depth 1.
} c;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    uint held = uint(texelFetch(from, ivec3(at, c.layer), 0).x * c.codes + 0.5);
    gl_FragDepth = float((held + rows[at.y] + uint(at.x) * c.step) & 0xFFFFu) * c.per_code;
}
