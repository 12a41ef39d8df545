// Tiles of 1024 numbers, 16 to an invocation of a group of 64, and sums over them that stop at 2^32 - 1: for kernels that scan and sort.
#ifndef GNOMON_BACKEND_TILE_GLSL
#define GNOMON_BACKEND_TILE_GLSL

const uint lanes = 64u;
const uint lane_items = 16u;
const uint tile_items = lanes * lane_items;
const uint most = 0xFFFFFFFFu;

// Stopping at the end keeps the order of sums free: min(a + b, most) is associative.
uint add(uint a, uint b) {
    uint sum = a + b;
    return sum < a ? most : sum;
}

uint tile_index() { return gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x; }

// Lanes read 16 neighbours each: without the gaps all would meet in one memory bank.
uint padded(uint i) { return i + (i >> 4); }

shared uint lane_sums[lanes];

// The sum of what the lanes before this one give. Shared memory alone: subgroups may have any size.
uint sum_before(uint lane, uint value) {
    barrier();
    lane_sums[lane] = value;
    for (uint step = 1u; step < lanes; step *= 2u) {
        barrier();
        uint other = lane >= step ? lane_sums[lane - step] : 0u;
        barrier();
        lane_sums[lane] = add(lane_sums[lane], other);
    }
    barrier();
    return lane == 0u ? 0u : lane_sums[lane - 1u];
}

#endif
