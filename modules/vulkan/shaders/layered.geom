#version 450
// Sends each triangle to its layer, where the vertex shader cannot.

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

layout(location = 0) in vec2 uv_in[];
layout(location = 1) flat in uint triangle_in[];
layout(location = 2) flat in uint slot_in[];
layout(location = 3) in float depth_times_w_in[];
layout(location = 4) flat in uint layer_in[];

layout(location = 0) out vec2 uv;
layout(location = 1) flat out uint triangle;
layout(location = 2) flat out uint slot;
layout(location = 3) out float depth_times_w;

void main() {
    for (int i = 0; i < 3; ++i) {
        uv = uv_in[i];
        triangle = triangle_in[i];
        slot = slot_in[i];
        depth_times_w = depth_times_w_in[i];
        gl_Position = gl_in[i].gl_Position;
        gl_PrimitiveID = gl_PrimitiveIDIn;
        gl_Layer = int(layer_in[i]);
        EmitVertex();
    }
    EndPrimitive();
}
