// Keys and their dense numbers, ascending with the keys: DeviceLayout in device_layout.hpp.
#ifndef PIPELINE_SHADERS_CLUSTER_LAYOUT_GLSL
#define PIPELINE_SHADERS_CLUSTER_LAYOUT_GLSL

#include <gnomon/cluster/formula/key.glsl>

const uint no_key = 0xFFFFFFFFu;

layout(push_constant) uniform Constants {
    uint count;
    uint columns;
    uint rows;
    uint slices;
    uint cells;
    uint packed;  // 0: keys are the numbers
} c;

bool holds(uint key) {
    if (c.packed == 0u) return key < c.columns * c.rows * c.slices * c.cells;
    return gn_key_column(key) < c.columns && gn_key_row(key) < c.rows && gn_key_slice(key) < c.slices &&
           gn_key_cell(key) < c.cells;
}

uint number_of(uint key) {
    if (c.packed == 0u) return key;
    return ((gn_key_row(key) * c.columns + gn_key_column(key)) * c.slices + gn_key_slice(key)) * c.cells + gn_key_cell(key);
}

uint key_of(uint number) {
    if (c.packed == 0u) return number;
    uint depth = number / c.cells;
    uint tile = depth / c.slices;
    return gn_pack_key(tile % c.columns, tile / c.columns, depth % c.slices, number % c.cells);
}

#endif
