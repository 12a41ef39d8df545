#version 450
// Depth of a box where the device cannot clamp it.

layout(location = 0) in float depth_times_w;

void main() {
    gl_FragDepth = clamp(depth_times_w * gl_FragCoord.w, 0.0, 1.0);
}
