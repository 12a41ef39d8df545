// The lights of each unique cluster, counted or written in no order: the GLSL half of `assign_lights`.
//
// A group of 64 takes a cluster at a time. Half of it tests the 32 children of a node; what may touch is put aside until
// there is work for all 64, as the predicate costs far more than a test of boxes.

#version 450
#extension GL_GOOGLE_include_directive : require

#include <gnomon/cluster/formula/key.glsl>
#include <gnomon/lights/formula/assign.glsl>

#include "device_state.glsl"
#include "gnomon/backend/tile.glsl"
#include "ready_light.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) buffer State { DeviceState state; };
layout(std430, set = 0, binding = 1) readonly buffer Unique { uint unique_keys[]; };
layout(std430, set = 0, binding = 2) readonly buffer Tables { float tables[]; };
layout(std430, set = 0, binding = 3) readonly buffer Ready { float ready[]; };
layout(std430, set = 0, binding = 4) readonly buffer TreeItems { float tree_items[]; };
layout(std430, set = 0, binding = 5) readonly buffer Nodes { float nodes[]; };
layout(std430, set = 0, binding = 6) readonly buffer Ids { uint ids[]; };
layout(std430, set = 0, binding = 7) readonly buffer Everywhere { uint everywhere[]; };
layout(std430, set = 0, binding = 8) buffer Offsets { uint offsets[]; };  // counts, then scanned
layout(std430, set = 0, binding = 9) buffer Cells { uvec2 cells[]; };     // offset, count
layout(std430, set = 0, binding = 10) buffer List { uint list[]; };
layout(push_constant) uniform Constants {
    uint fill;
    uint groups;
    uint columns;
    uint rows;
    uint slices;
    uint perspective;
    uint cells;
    uint packed;  // 0: keys are dense numbers
} c;

const uint level_shift = 27u;

shared uint stack[256];   // level << 27 | node
shared uint queue[128];   // slots of items
shared uint stack_count;
shared uint queue_count;
shared uint found;

GnRowBorder border(uint j) {
    uint at = 2u * c.columns + j;
    return GnRowBorder(tables[at], tables[at + c.rows + 1u], tables[at + 2u * (c.rows + 1u)]);
}

GnSlicePlane plane(uint k) {
    uint at = 2u * c.columns + 3u * (c.rows + 1u) + k;
    return GnSlicePlane(tables[at], tables[at + c.slices + 1u], tables[at + 2u * (c.slices + 1u)]);
}

GnBox item_box(uint slot) {
    uint slots = state.item_slots;
    vec3 center = vec3(tree_items[slot], tree_items[slots + slot], tree_items[2u * slots + slot]);
    return gn_box_of(GnSphere(center, tree_items[3u * slots + slot]));
}

GnBox node_box(uint level, uint node) {
    uint slots = state.node_slots;
    uint at = state.first[level] + node;
    return GnBox(vec3(nodes[at], nodes[slots + at], nodes[2u * slots + at]),
                 vec3(nodes[3u * slots + at], nodes[4u * slots + at], nodes[5u * slots + at]));
}

vec3 vec3_at(uint at) { return vec3(ready[at], ready[at + 1u], ready[at + 2u]); }
GnSpan span_at(uint at) { return GnSpan(ready[at], ready[at + 1u]); }

GnReadyBall ball_at(uint at) {
    GnBall ball = GnBall(vec3_at(at), ready[at + 3u], ready[at + 4u], ready[at + 5u]);
    GnArc cap = GnArc(span_at(at + 6u), ready[at + 8u], ready[at + 9u], ready[at + 10u], ready[at + 11u]);
    return GnReadyBall(ball, cap, ready[at + 12u], ready[at + 13u], span_at(at + 14u), span_at(at + 16u));
}

GnSilhouette silhouette_at(uint at) { return GnSilhouette(ready[at] != 0.0, ready[at + 1u], ready[at + 2u], ready[at + 3u]); }

GnLine line_at(uint at) { return GnLine(ready[at], ready[at + 1u], ready[at + 2u]); }

GnReadySpot spot_at(uint at) {
    GnReadySpot spot;
    spot.ready = ball_at(at);
    spot.cone = GnCone(vec3_at(at + 18u), ready[at + 21u], ready[at + 22u], ready[at + 23u], ready[at + 24u], span_at(at + 25u));
    spot.outline = GnOutline(silhouette_at(at + 27u), silhouette_at(at + 31u));
    for (uint k = 0u; k < 4u; ++k) {
        uint side = at + 35u + 8u * k;
        spot.side[k] = GnSide(ready[side], line_at(side + 1u), line_at(side + 4u), ready[side + 7u]);
    }
    return spot;
}

/// The predicate.
bool touches(uint light, GnRow row, float left, float right) {
    bool perspective = c.perspective != 0u;
    uint at = light * ready_words;
    GnSpan span;
    if (ready[at + ready_kind] == 2.0) span = gn_spot_row(spot_at(at), row, perspective);
    else span = gn_ball_row(ball_at(at), row, perspective);
    return gn_touches(span, left, right);
}

void take(uint first, uint light) {
    uint at = atomicAdd(found, 1u);
    if (c.fill != 0u) list[first + at] = light;
}

void assign_cluster(uint cluster, uint lane) {
    uint key = unique_keys[cluster];
    uint number = key / c.cells;  // of tile and slice
    uint slice = c.packed != 0u ? gn_key_slice(key) : number % c.slices;
    uint column = c.packed != 0u ? gn_key_column(key) : number / c.slices % c.columns;
    uint j = c.packed != 0u ? gn_key_row(key) : number / c.slices / c.columns;
    float left = tables[column];
    float right = tables[c.columns + column];
    bool perspective = c.perspective != 0u;
    GnRow row = GnRow(border(j), border(j + 1u), plane(slice), plane(slice + 1u));
    GnBox box = gn_cluster_box(row, left, right, perspective);
    uint first = c.fill != 0u ? offsets[cluster] : 0u;
    barrier();
    if (lane == 0u) {
        stack_count = state.levels > 0u ? 1u : 0u;
        stack[0] = state.levels << level_shift;
        queue_count = 0u;
        found = 0u;
    }
    barrier();
    for (uint i = lane; i < state.everywhere; i += lanes) take(first, everywhere[i]);
    for (;;) {
        barrier();
        uint in_stack = stack_count;
        uint in_queue = queue_count;
        uint top = stack[in_stack > 0u ? in_stack - 1u : 0u];
        barrier();
        if (in_queue >= lanes || (in_stack == 0u && in_queue > 0u)) {
            uint batch = min(in_queue, lanes);
            if (lane < batch) {
                uint light = ids[queue[in_queue - batch + lane]];
                if (touches(light, row, left, right)) take(first, light);
            }
            barrier();
            if (lane == 0u) queue_count = in_queue - batch;
        } else if (in_stack > 0u) {
            if (lane == 0u) stack_count = in_stack - 1u;
            barrier();
            uint level = top >> level_shift;
            uint child = (top & ((1u << level_shift) - 1u)) * 32u + lane;
            if (lane < 32u && child < state.count[level - 1u]) {
                if (level == 1u) {
                    if (gn_may_hold(box, item_box(child))) queue[atomicAdd(queue_count, 1u)] = child;
                } else if (gn_may_hold(box, node_box(level - 1u, child))) {
                    stack[atomicAdd(stack_count, 1u)] = (level - 1u) << level_shift | child;
                }
            }
        } else {
            break;
        }
    }
    barrier();
    if (lane == 0u && c.fill == 0u) {
        offsets[cluster] = found;
        atomicMax(state.longest, found);
    }
    if (lane == 0u && c.fill != 0u) cells[cluster] = uvec2(first, found);
}

void main() {
    if (tile_index() >= c.groups) return;  // a grid's last row may be longer
    uint clusters = state.clusters;
    for (uint cluster = tile_index(); cluster < clusters; cluster += c.groups) assign_cluster(cluster, gl_LocalInvocationID.x);
}
