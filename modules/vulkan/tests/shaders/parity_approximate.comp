#version 450
// The device's own division and square root, of which gn_div and gn_sqrt make exact ones.
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Inputs { vec2 inputs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Outputs { vec2 outputs[]; };
layout(push_constant) uniform Push { uint count; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    outputs[i] = vec2(inputs[i].x / inputs[i].y, sqrt(inputs[i].x));
}
