// What the predicate needs of each light, once for all clusters: the GLSL half of `ready_lights`.

#version 450
#extension GL_GOOGLE_include_directive : require

#include "gnomon/backend/item.glsl"
#include "ready_light.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Lights { GnLight lights[]; };
layout(std430, set = 0, binding = 1) readonly buffer Items { vec4 items[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Ready { float ready[]; };
layout(push_constant) uniform Constants {
    uint count;
    uint perspective;
} c;

uint at;

void put(float x) { ready[at++] = x; }
void put(vec3 v) {
    put(v.x);
    put(v.y);
    put(v.z);
}
void put(GnSpan s) {
    put(s.low);
    put(s.high);
}

void put(GnReadyBall b) {
    put(b.ball.center);
    put(b.ball.radius);
    put(b.ball.radius_sq);
    put(b.ball.tangent);
    put(b.cap.span);
    put(b.cap.low_at);
    put(b.cap.high_at);
    put(b.cap.unit);
    put(b.cap.rest);
    put(b.cap_low_scale);
    put(b.cap_high_scale);
    put(b.x);
    put(b.y);
}

void put(GnCone k) {
    put(k.axis);
    put(k.cosine);
    put(k.sine);
    put(k.slack);
    put(k.smallest);
    put(k.depth);
}

void put(GnSilhouette l) {
    put(l.upper ? 1.0 : 0.0);
    put(l.start);
    put(l.lean);
    put(l.off);
}

void put(GnLine l) {
    put(l.slope);
    put(l.inverse);
    put(l.at_eye);
}

void put(GnSide s) {
    put(s.middle);
    put(s.first);
    put(s.second);
    put(s.bound);
}

void main() {
    uint i = GNOMON_ITEM;
    if (i >= c.count) return;
    uint first = i * ready_words;
    if (!(items[i].w >= 0.0)) {
        ready[first + ready_kind] = 0.0;
        return;
    }
    GnLight light = lights[i];
    bool perspective = c.perspective != 0u;
    bool narrow = gn_is_narrow_spot(light);
    GnReadyBall ball = gn_ready_ball(light.center, light.range_m, perspective);
    ready[first + ready_kind] = narrow ? 2.0 : 1.0;
    at = first;
    if (!narrow) {
        put(ball);
        return;
    }
    GnReadySpot spot = gn_ready_spot(ball, light.axis, light.cos_half, light.sin_half, perspective);
    put(spot.ready);
    put(spot.cone);
    put(spot.outline.first);
    put(spot.outline.second);
    for (int k = 0; k < 4; ++k) put(spot.side[k]);
}
