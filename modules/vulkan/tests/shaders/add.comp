#version 450
// out[i] = a[i] * b[i] + c[i], with two roundings if nothing is contracted.
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Inputs { float value[]; } inputs;
layout(std430, set = 0, binding = 1) writeonly buffer Outputs { float value[]; } outputs;
layout(push_constant) uniform Push { uint count; } push;
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    outputs.value[i] = inputs.value[i * 3u] * inputs.value[i * 3u + 1u] + inputs.value[i * 3u + 2u];
}
