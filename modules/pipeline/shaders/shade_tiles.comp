// A tile's lights found and its samples shaded by one group: the GLSL half of `shade_tiles`. tile_kernels.hpp has the layout.

#version 450
#extension GL_GOOGLE_include_directive : require

#include <gnomon/cull/formula/tile.glsl>

#include "gbuffer.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 2) readonly buffer Lights { GnShadedLight lights[]; };
layout(std430, set = 0, binding = 3) readonly buffer SampleOf { uint sample_of[]; };
layout(std430, set = 0, binding = 4) readonly buffer Balls { float balls[]; };
layout(std430, set = 0, binding = 5) readonly buffer Borders { GnTileBorder borders[]; };
layout(std430, set = 0, binding = 6) buffer Radiance { float radiance[]; };
layout(std430, set = 0, binding = 7) writeonly buffer Computations { uint computations[]; };
layout(std430, set = 0, binding = 8) buffer LightsOf { uint lights_of[]; };
layout(std430, set = 0, binding = 9) readonly buffer Marks { uint marks[]; };

layout(push_constant) uniform Constants {
    uint tile;
    uint columns, rows;
    uint width, height;
    uint lights;
    uint halves;
    uint orthographic;
    float eye_x, eye_y, eye_z;
    float from_x, from_y, from_z;
    float forward_x, forward_y, forward_z;
    uint marked;
    uint first, end;
} c;

const uint lanes = 64u;
const uint list_size = 1024u;
const uint no_sample = 0xFFFFFFFFu;

shared uint list[list_size];
shared uint kept_bits[2];
shared float nearest[lanes];
shared float farthest[lanes];

uint sample_at(uint tile, uint pixel) {
    uint x = tile % c.columns * c.tile + pixel % c.tile;
    uint y = tile / c.columns * c.tile + pixel / c.tile;
    return x < c.width && y < c.height ? sample_of[y * c.width + x] : no_sample;
}

/// To nearest[0] and farthest[0].
void find_depths(uint tile, uint lane) {
    float low = uintBitsToFloat(0x7F800000u);
    float high = -low;
    for (uint pixel = lane; pixel < c.tile * c.tile; pixel += lanes) {
        uint i = sample_at(tile, pixel);
        if (i == no_sample) continue;
        precise vec3 offset = position_of(i) - vec3(c.from_x, c.from_y, c.from_z);
        float depth = gn_dot(offset, vec3(c.forward_x, c.forward_y, c.forward_z));
        low = gn_min(low, depth);
        high = gn_max(high, depth);
    }
    nearest[lane] = low;
    farthest[lane] = high;
    for (uint step = lanes / 2u; step > 0u; step /= 2u) {
        barrier();
        if (lane < step) {
            nearest[lane] = gn_min(nearest[lane], nearest[lane + step]);
            farthest[lane] = gn_max(farthest[lane], farthest[lane + step]);
        }
    }
    barrier();
}

GnTilePlanes planes_of(uint tile, float low, float high) {
    uint column = tile % c.columns;
    uint row = c.columns + 1u + tile / c.columns;
    return gn_tile_planes(GnTile(borders[column], borders[column + 1u], borders[row], borders[row + 1u], low, high), c.orthographic == 0u);
}

GnSphere ball_at(uint light) {
    return GnSphere(vec3(balls[light], balls[c.lights + light], balls[2u * c.lights + light]), balls[3u * c.lights + light]);
}

bool keeps(uint tile, GnTilePlanes planes, uint light) {
    if (c.marked == 0u) return gn_touches_tile(planes, ball_at(light));
    bool marked = (marks[tile * (c.lights >> 5) + (light >> 5)] >> (light & 31u) & 1u) != 0u;
    return marked && gn_touches_depths(nearest[0], farthest[0], ball_at(light));
}

/// Adds the list's lights to the lane's samples; `before` of them were added already.
void add_lights(uint tile, uint lane, uint before, uint listed) {
    bool halves = c.halves != 0u;
    vec3 eye = vec3(c.eye_x, c.eye_y, c.eye_z);
    for (uint pixel = lane; pixel < c.tile * c.tile; pixel += lanes) {
        uint i = sample_at(tile, pixel);
        if (i == no_sample) continue;
        GnSurface surface = surface_of(i, halves, eye, c.orthographic != 0u);
        precise vec3 sum = emissive_of(i, halves);
        if (before != 0u) sum = vec3(radiance[3u * i], radiance[3u * i + 1u], radiance[3u * i + 2u]);
        for (uint k = 0u; k < listed; ++k) sum += gn_shade(lights[list[k]], surface);
        radiance[3u * i] = sum.x;
        radiance[3u * i + 1u] = sum.y;
        radiance[3u * i + 2u] = sum.z;
        computations[i] = before + listed;
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint tile = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
    if (tile >= c.columns * c.rows) return;
    find_depths(tile, lane);
    bool any = nearest[0] <= farthest[0];
    GnTilePlanes planes = planes_of(tile, nearest[0], farthest[0]);
    // Read before any lane writes it: barriers follow.
    uint before = c.first != 0u ? lights_of[tile] : 0u;
    uint next = any ? c.first : c.end;
    do {
        uint listed = 0u;
        for (; next < c.end && listed + lanes <= list_size; next += lanes) {
            barrier();
            if (lane < 2u) kept_bits[lane] = 0u;
            barrier();
            bool kept = next + lane < c.end && keeps(tile, planes, next + lane);
            if (kept) atomicOr(kept_bits[lane >> 5], 1u << (lane & 31u));
            barrier();
            uint low = kept_bits[0];
            uint high = kept_bits[1];
            uint of_lower = lane < 32u ? 0u : uint(bitCount(low));
            uint rank = of_lower + uint(bitCount((lane < 32u ? low : high) & ((1u << (lane & 31u)) - 1u)));
            if (kept) list[listed + rank] = next + lane;
            listed += uint(bitCount(low) + bitCount(high));
        }
        barrier();
        add_lights(tile, lane, before, listed);
        before += listed;
    } while (next < c.end);
    if (lane == 0u) lights_of[tile] = before;
}
