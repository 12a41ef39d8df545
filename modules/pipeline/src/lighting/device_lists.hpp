#pragma once
// Light lists made on a backend: keys of samples, unique clusters, the light tree, lights per cluster. Every step gives what
// the host's gives: cluster::key_at, unique_by_bitmap, explicit_bounds, lights::build_light_tree, lights::count_lists.
//
// Verbs are recorded in this order: `upload`, `find_keys`, `find_unique`, (`find_bounds`,) `build_tree`, `count`; then
// `finish` reads the sizes back, the one time that the host waits, and `fill` writes lists that fit exactly.

#include <gnomon/cluster/grid.hpp>
#include <gnomon/cluster/key.hpp>
#include <gnomon/lights/light.hpp>
#include <gnomon/pipeline/frame.hpp>

#include "../staged.hpp"
#include "device_kernels.hpp"
#include "device_layout.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace gnomon::pipeline {

/// Exclusive scans and stable sorts over buffers of a backend.
class DeviceScan {
  public:
    /// Each number becomes the sum of those before it, at most 2^32 - 1.
    ///
    /// expects: at most 2^30 numbers.
    void scan(Verbs& verbs, backend::BufferId values, std::uint32_t count);
    /// Pairs of words by the lowest `bits` of the first, equal ones in their order. `pairs` is scratch afterwards.
    ///
    /// returns: where the result is: `pairs` or `spare`.
    backend::BufferId sort(Verbs& verbs, backend::BufferId pairs, backend::BufferId spare, SortStd const& by);

  private:
    StagedBuffer sums_[2];  ///< Of tiles, and of tiles of those.
    StagedBuffer counts_;
};

/// What lists are made of.
struct DeviceListsInput {
    Frame const& frame;
    cluster::Grid const& grid;
    DeviceLayout layout;  ///< Of the grid.
    std::span<lights::Light const> lights;  ///< Culling space; no boxes, which count as bad.
    backend::BufferId samples;
    backend::BufferId normals;              ///< Read if the layout has normals.
};

/// Sizes that `count` found.
struct DeviceListsSizes {
    DeviceStateStd state;
    std::uint32_t pairs = 0;  ///< 2^32 - 1: that many or more.
};

/// Buffers, kept from frame to frame.
class DeviceLists {
  public:
    /// returns: `too_large` above 2^30 lights, or above what a group may loop over.
    [[nodiscard]] Result<core::Done> upload(Verbs& verbs, DeviceListsInput const& in);
    void find_keys(Verbs& verbs, DeviceListsInput const& in);
    void find_unique(Verbs& verbs, DeviceListsInput const& in);
    /// Boxes of the clusters' samples in culling space, as places of floats: lo x y z, then of -hi x y z.
    void find_bounds(Verbs& verbs, DeviceListsInput const& in);
    void build_tree(Verbs& verbs, DeviceListsInput const& in);
    /// Counts, and reads the sizes back: they are there after `finish`.
    void count(Verbs& verbs, DeviceListsInput const& in);
    /// expects: `sizes()` of this frame, whose pairs are fewer than 2^32 - 1.
    void fill(Verbs& verbs, DeviceListsInput const& in);

    [[nodiscard]] DeviceListsSizes const& sizes() const noexcept { return sizes_; }
    /// Most clusters that there can be.
    [[nodiscard]] std::uint32_t capacity(DeviceListsInput const& in) const noexcept;

    StagedBuffer state, pixels, slice_words, tables, lights;
    StagedBuffer keys, bits, ranks, unique_keys, index, places;
    StagedBuffer balls, everywhere, pairs[2], items, nodes, ids;
    StagedBuffer ready, offsets, cells, list, ordered;

  private:
    void assign(Verbs& verbs, DeviceListsInput const& in, bool fill);

    DeviceScan scan_;
    DeviceListsSizes sizes_;
    std::shared_ptr<FrameState const> pixels_of_;
    std::vector<float> numbers_;
    DeviceStateStd start_;
};

/// The tables of the predicate: left borders, right borders; y, secant and cosine of the rows' borders; depth, scale and its
/// inverse of the slices' planes.
void row_tables(cluster::GridView const& grid, std::vector<float>& out);

}  // namespace gnomon::pipeline
