#version 450
// The peer's whole pipeline: a position, a matrix. There is no fragment shader.
layout(location = 0) in vec3 position;
layout(push_constant) uniform Push { mat4 clip_from_position; };

void main() { gl_Position = clip_from_position * vec4(position, 1.0); }
