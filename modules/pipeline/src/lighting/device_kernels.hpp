#pragma once
// The kernels that make light lists on a backend: what stands in their buffers and constants, laid out by std430. The GLSL
// halves (shaders/*.comp) declare the same.
//
// In the buffers' lists: `out` is written; `state` is a DeviceStateStd; words are uint32. Kernels of tiles and of groups
// have 64 items for each: a tile is 1024 numbers; a group takes every `groups`-th cluster.

#include <gnomon/backend/kernel.hpp>
#include <gnomon/bvh/tree.hpp>
#include <gnomon/cluster/grid.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>

namespace gnomon::pipeline {

inline constexpr std::uint32_t tile_numbers = 1024;

/// What the kernels count, and the layout of the tree, see bvh::Layout.
struct DeviceStateStd {
    std::uint32_t clusters = 0;
    std::uint32_t usable = 0;      ///< Lights in the tree.
    std::uint32_t everywhere = 0;  ///< Directional lights.
    std::uint32_t masked = 0;
    std::uint32_t bad = 0;
    std::uint32_t background = 0;  ///< Samples without a key.
    std::uint32_t invalid = 0;     ///< Samples whose key is none of the layout.
    std::uint32_t levels = 0;
    std::int32_t places[6] = {last_place, last_place, last_place, last_place, last_place, last_place};  ///< Of halved centres.
    std::uint32_t item_slots = 0;
    std::uint32_t node_slots = 0;
    std::uint32_t count[bvh::max_levels] = {};
    std::uint32_t first[bvh::max_levels] = {};
    std::uint32_t longest = 0;  ///< List, in lights.

    static constexpr std::int32_t last_place = std::numeric_limits<std::int32_t>::max();
};
static_assert(sizeof(DeviceStateStd) == 164);

// --- keys and unique clusters ----------------------------------------------------------------------------------------
//
// cluster_keys    0 sample::ViewSample[n]  1 words of pixels, y width + x  2 normals, three numbers  3 DepthSlices::words()
//                 4 out words of keys
// clear_words     0 out words
// mark_clusters   0 keys  1 bits, one a number of the layout  2 state. An item is a sample.
// rank_clusters   0 bits  1 out words: how many bits, then 0. An item is a word, and one more.
// link_clusters   0 keys  1 bits  2 scanned ranks  3 out index of samples
// store_clusters  0 bits  1 scanned ranks  2 out unique keys  3 state. An item is a word.
// bound_clusters  0 sample::ViewSample[n]  1 index of samples  2 places, six a cluster. An item is 16 samples.

struct ClusterKeysStd {
    cluster::GridTable grid;
    std::uint32_t count;
    std::uint32_t width;
    float eye[3];
    float forward[3];
    std::uint32_t normal_n;
    std::uint32_t packed;  ///< 0: keys are their dense numbers.
};
static_assert(sizeof(ClusterKeysStd) == 108);

struct ClearWordsStd {
    std::uint32_t count;
    std::uint32_t value;
};

/// A DeviceLayout; `count` items.
struct ClusterLayoutStd {
    std::uint32_t count;
    std::uint32_t columns, rows, slices, cells;
    std::uint32_t packed;
};

struct BoundClustersStd {
    std::uint32_t count;
    float eye[3];
    float right[3];
    float down[3];
    float forward[3];
};
static_assert(sizeof(BoundClustersStd) == 52);

extern backend::Kernel const cluster_keys_kernel;
extern backend::Kernel const clear_words_kernel;
extern backend::Kernel const mark_clusters_kernel;
extern backend::Kernel const rank_clusters_kernel;
extern backend::Kernel const link_clusters_kernel;
extern backend::Kernel const store_clusters_kernel;
extern backend::Kernel const bound_clusters_kernel;

// --- scan and sort ---------------------------------------------------------------------------------------------------
//
// scan_sums       0 words  1 out sums of tiles, at most 2^32 - 1
// scan_apply      0 words, which become the sums of all before them  1 scanned sums of tiles
// sort_count      0 pairs of words: key, value  1 out words: digit * tiles + tile
// sort_scatter    0 pairs  1 scanned counts  2 out pairs

struct ScanStd {
    std::uint32_t count;
    std::uint32_t has_bases;  ///< Of scan_apply alone.
};

struct SortStd {
    std::uint32_t count;
    std::uint32_t shift;
};

inline constexpr std::uint32_t sort_digit_bits = 5;
inline constexpr std::uint32_t sort_digits = 1U << sort_digit_bits;

extern backend::Kernel const scan_sums_kernel;
extern backend::Kernel const scan_apply_kernel;
extern backend::Kernel const sort_count_kernel;
extern backend::Kernel const sort_scatter_kernel;

// --- the light tree --------------------------------------------------------------------------------------------------
//
// light_items     0 lights::Light[n]  1 out balls: centre and radius, -1 if it takes no part  2 out everywhere  3 state
// light_codes     0 balls  1 state  2 out pairs: code, light
// tree_leaves     0 balls  1 sorted pairs  2 state  3 out items, an array a number  4 out ids. An item is a slot.
// tree_nodes      0 items  1 state  2 nodes, an array a number. An item is a slot of the level.

struct LightItemsStd {
    std::uint32_t count;
    std::uint32_t layers;
};

extern backend::Kernel const light_items_kernel;
extern backend::Kernel const light_codes_kernel;
extern backend::Kernel const tree_leaves_kernel;
extern backend::Kernel const tree_nodes_kernel;

// --- assignment ------------------------------------------------------------------------------------------------------
//
// ready_lights    0 lights::Light[n]  1 balls  2 out `ready_words` a light, which only the same backend's kernels read
// assign_lights   0 state, whose `longest` it counts  1 unique keys  2 tables: see row_tables  3 ready lights  4 items  5 nodes  6 ids  7 everywhere
//                 8 offsets: out counts, or in scanned  9 out cells  10 out list, in no order
// order_lists     0 state  1 cells  2 list  3 out ordered list. Lists above `rank_longest` in steps, see `order_steps`.

inline constexpr std::uint32_t ready_words = 68;

struct ReadyLightsStd {
    std::uint32_t count;
    std::uint32_t perspective;
};

struct AssignLightsStd {
    std::uint32_t fill;  ///< 0: count into the offsets; 1: write cells and list.
    std::uint32_t groups;
    std::uint32_t columns, rows, slices;
    std::uint32_t perspective;
    std::uint32_t cells;
    std::uint32_t packed;
};

struct OrderListsStd {
    std::uint32_t groups;
    std::uint32_t first_step, end_step;
};

/// Lists up to here are ordered in one step, the first.
inline constexpr std::uint32_t rank_longest = 1024;

/// Steps of the longest list: a copy, then those of a merge sort; each takes a lane through a 64th of the list.
[[nodiscard]] constexpr std::uint32_t order_steps(std::uint32_t longest) noexcept {
    if (longest <= rank_longest) return 1;
    std::uint32_t blocks = 0;
    while ((std::uint64_t{1} << blocks) < longest) ++blocks;
    return 1 + blocks * (blocks + 1) / 2;
}
static_assert(order_steps(1024) == 1 && order_steps(1025) == 67 && order_steps(65'536) == 137);

extern backend::Kernel const ready_lights_kernel;
extern backend::Kernel const assign_lights_kernel;
extern backend::Kernel const order_lists_kernel;

/// Calls `one(tile or group)` for those that begin in a range of items.
template <class F>
void for_each_group(std::size_t begin, std::size_t end, F&& one) {
    constexpr std::size_t lanes = backend::kernel_local_size;
    for (std::size_t group = (begin + lanes - 1) / lanes; group * lanes < end; ++group) one(group);
}

}  // namespace gnomon::pipeline
