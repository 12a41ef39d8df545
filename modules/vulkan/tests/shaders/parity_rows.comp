#version 450
#extension GL_GOOGLE_include_directive : require
// Rows of balls and spots, for parity_rows.test.cpp: 16 words in, 32 words out.
#include <gnomon/cull/formula/spot_rows.glsl>
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Inputs { float inputs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Outputs { uint outputs[]; };
layout(push_constant) uniform Push { uint count; };

vec3 at(uint from) { return vec3(inputs[from], inputs[from + 1u], inputs[from + 2u]); }

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    uint f = i * 16u;
    bool perspective = floatBitsToUint(inputs[f + 15u]) != 0u;
    GnRow row = GnRow(gn_row_border(inputs[f + 9u], perspective), gn_row_border(inputs[f + 10u], perspective),
                      gn_slice_plane(inputs[f + 11u], perspective), gn_slice_plane(inputs[f + 12u], perspective));
    GnReadyBall ball = gn_ready_ball(at(f), inputs[f + 3u], perspective);
    GnReadySpot spot = gn_ready_spot(ball, at(f + 4u), inputs[f + 7u], inputs[f + 8u], perspective);
    GnSpan of_ball = gn_ball_row(ball, row, perspective);
    GnSpan of_spot = gn_spot_row(spot, row, perspective);
    uint o = i * 32u;
    outputs[o] = uint(gn_touches(of_ball, inputs[f + 13u], inputs[f + 14u]));
    outputs[o + 1u] = uint(gn_touches(of_spot, inputs[f + 13u], inputs[f + 14u]));
    outputs[o + 2u] = uint(spot.outline.first.upper) | uint(spot.outline.second.upper) << 1;
    float values[29] = float[29](of_ball.low, of_ball.high, of_spot.low, of_spot.high, ball.x.low, ball.x.high, ball.y.low,
                                 ball.y.high, ball.cap_low_scale, ball.cap_high_scale, row.top.secant, row.top.cosine,
                                 row.near.scale, row.near.inverse, spot.cone.slack, spot.cone.depth.low, spot.cone.depth.high,
                                 spot.side[0].bound, spot.side[1].bound, spot.side[2].bound, spot.side[3].bound,
                                 spot.side[0].first.at_eye, spot.side[1].second.slope, spot.outline.first.start,
                                 spot.outline.first.lean, spot.outline.first.off, spot.outline.second.start,
                                 spot.outline.second.lean, spot.ready.x.high);
    for (uint k = 0u; k < 29u; ++k) outputs[o + 3u + k] = floatBitsToUint(values[k]);
}
