// What the shaders of a pass share: the layouts of src/pass_layout.hpp.

#include "pass_items.glsl"

struct View {
    vec4 column[4];  // clip_from_relative
    vec3 origin;
    uint layer;
    uvec2 groups;
    uvec2 unused;
};

layout(set = 0, binding = 0, std140) uniform Views { View views[64]; };
layout(set = 0, binding = 1, std430) readonly buffer Items { Item items[]; };

layout(push_constant) uniform Push {
    uint first_view;
    uint layers;        // Of the call: instance i of the call is item i / layers in view first_view + i % layers.
    uint matrix_views;  // Views that each instance has a matrix for.
    uint instanced;     // Number of matrices.
    float bias_constant;
    float bias_slope;
    vec2 viewport_px;       // Its top left.
    vec2 viewport_size_px;
} push;
