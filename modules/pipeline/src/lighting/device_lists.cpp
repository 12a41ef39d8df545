#include "device_lists.hpp"

#include <gnomon/cull/rows.hpp>

#include "../detail.hpp"
#include "device_tree.hpp"
#include "lighting.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

namespace gnomon::pipeline {

namespace {

constexpr std::uint32_t most_groups = 4096;

std::uint32_t tiles_of(std::uint32_t count) noexcept { return std::max(1U, (count + tile_numbers - 1) / tile_numbers); }

/// Groups that take at most `each` clusters.
std::uint32_t groups_for(std::uint32_t clusters, std::uint32_t each) noexcept {
    std::uint32_t const least = (clusters + std::max(1U, each) - 1) / std::max(1U, each);
    return std::max({1U, std::min(most_groups, clusters), least});
}

/// Most rounds of a group over a cluster that all lights touch: a node of 32, or 64 lights, in each.
std::uint32_t assign_rounds(std::size_t lights) noexcept {
    return static_cast<std::uint32_t>(lights / 31 + lights / backend::kernel_local_size) + 2 * bvh::max_levels + 8;
}

std::uint32_t words_of_bits(DeviceListsInput const& in) noexcept { return static_cast<std::uint32_t>((in.layout.domain() + 31) / 32); }

std::uint32_t count_of(std::size_t n) noexcept { return static_cast<std::uint32_t>(n); }

void to_floats(math::vec3 const& v, float (&out)[3]) noexcept {
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

ClusterLayoutStd layout_std(DeviceListsInput const& in, std::size_t count) noexcept {
    auto const& counts = in.layout.counts;
    return {count_of(count), counts.columns, counts.rows, counts.slices, counts.cells, in.layout.packed ? 1U : 0U};
}

/// Runs a kernel with its constants.
template <class Constants, std::size_t n>
void run_kernel(Verbs& verbs, backend::Kernel const& kernel, std::size_t count, std::array<backend::BufferId, n> const& buffers,
                Constants const& constants) {
    verbs(verbs.device().run(kernel, {count, buffers, {}, backend::bytes_of(constants)}));
}

void clear_words(Verbs& verbs, backend::BufferId words, std::uint32_t count, std::uint32_t value) {
    run_kernel(verbs, clear_words_kernel, count, std::array{words}, ClearWordsStd{count, value});
}

}  // namespace

void DeviceScan::scan(Verbs& verbs, backend::BufferId values, std::uint32_t count) {
    std::array<std::uint32_t, 3> const counts{count, tiles_of(count), tiles_of(tiles_of(count))};
    std::array const ids{values, sums_[0].fit(verbs, counts[1] * std::size_t{4}), sums_[1].fit(verbs, counts[2] * std::size_t{4})};
    std::size_t top = 0;
    for (; tiles_of(counts[top]) > 1; ++top)
        run_kernel(verbs, scan_sums_kernel, tiles_of(counts[top]) * std::size_t{backend::kernel_local_size},
                   std::array{ids[top], ids[top + 1]}, counts[top]);
    for (std::size_t level = top + 1; level-- > 0;)
        run_kernel(verbs, scan_apply_kernel, tiles_of(counts[level]) * std::size_t{backend::kernel_local_size},
                   std::array{ids[level], level < top ? ids[level + 1] : ids[(level + 1) % 3]},
                   ScanStd{counts[level], level < top ? 1U : 0U});
}

backend::BufferId DeviceScan::sort(Verbs& verbs, backend::BufferId pairs, backend::BufferId spare, SortStd const& by) {
    std::uint32_t const tiles = tiles_of(by.count);
    backend::BufferId const counts = counts_.fit(verbs, std::size_t{sort_digits} * tiles * 4);
    std::size_t const items = std::size_t{tiles} * backend::kernel_local_size;
    for (std::uint32_t shift = 0; shift < by.shift; shift += sort_digit_bits) {
        run_kernel(verbs, sort_count_kernel, items, std::array{pairs, counts}, SortStd{by.count, shift});
        scan(verbs, counts, sort_digits * tiles);
        run_kernel(verbs, sort_scatter_kernel, items, std::array{pairs, counts, spare}, SortStd{by.count, shift});
        std::swap(pairs, spare);
    }
    return pairs;
}

void row_tables(cluster::GridView const& grid, std::vector<float>& out) {
    cull::RowGrid const g = cull::make_row_grid(grid);
    auto const append = [&out](std::vector<float> const& list, std::uint32_t count) { out.insert(out.end(), list.begin(), list.begin() + count); };
    out.clear();
    for (auto const* list : {&g.left, &g.right}) append(*list, g.columns);
    for (auto const* list : {&g.y, &g.secant, &g.cosine}) append(*list, g.rows + 1);
    for (auto const* list : {&g.depth_m, &g.scale, &g.inverse}) append(*list, g.slices + 1);
}

std::uint32_t DeviceLists::capacity(DeviceListsInput const& in) const noexcept {
    return count_of(std::min<std::uint64_t>(in.frame.samples.size(), in.layout.domain()));
}

Result<core::Done> DeviceLists::upload(Verbs& verbs, DeviceListsInput const& in) {
    GNOMON_EXPECT(in.layout.domain() < 0xFFFFFFFFU);
    if (in.lights.size() > 1U << 30U)
        return core::Failure{Error::too_large, std::to_string(in.lights.size()) + " lights; a device takes 2^30"};
    if (assign_rounds(in.lights.size()) > verbs.device().limits().loop_rounds)
        return core::Failure{Error::too_large, std::to_string(in.lights.size()) + " lights: the loops of this device end after " +
                                                   std::to_string(verbs.device().limits().loop_rounds) + " rounds"};
    if (pixels_of_ != in.frame.state) {
        pixels_of_ = nullptr;
        pixels.fill<std::uint32_t>(verbs, in.frame.samples.pixel);
        if (verbs.good()) pixels_of_ = in.frame.state;
    }
    slice_words.fill<std::uint32_t>(verbs, in.grid.slices().words());
    row_tables(in.grid.view(), numbers_);
    tables.fill<float>(verbs, numbers_);
    lights.fill<lights::Light>(verbs, in.lights);
    start_ = {};
    state.fill<DeviceStateStd>(verbs, {&start_, 1});
    return core::Done{};
}

void DeviceLists::find_keys(Verbs& verbs, DeviceListsInput const& in) {
    std::size_t const n = in.frame.samples.size();
    SampleDepth const depth(in.frame);
    ClusterKeysStd c{in.grid.table(), count_of(n), static_cast<std::uint32_t>(in.frame.view.size_px.x), {}, {},
                     in.layout.counts.normal_n, in.layout.packed ? 1U : 0U};
    to_floats(depth.eye(), c.eye);
    to_floats(depth.forward(), c.forward);
    run_kernel(verbs, cluster_keys_kernel, n,
               std::array{in.samples, pixels.get(), in.layout.counts.normal_n != 0 ? in.normals : in.samples, slice_words.get(), keys.fit(verbs, n * 4)}, c);
}

void DeviceLists::find_unique(Verbs& verbs, DeviceListsInput const& in) {
    std::size_t const n = in.frame.samples.size();
    std::uint32_t const words = words_of_bits(in);
    clear_words(verbs, bits.fit(verbs, std::size_t{words} * 4), words, 0);
    run_kernel(verbs, mark_clusters_kernel, n, std::array{keys.get(), bits.get(), state.get()}, layout_std(in, n));
    run_kernel(verbs, rank_clusters_kernel, std::size_t{words} + 1, std::array{bits.get(), ranks.fit(verbs, (std::size_t{words} + 1) * 4)}, words);
    scan_.scan(verbs, ranks.get(), words + 1);
    run_kernel(verbs, link_clusters_kernel, n, std::array{keys.get(), bits.get(), ranks.get(), index.fit(verbs, n * 4)}, layout_std(in, n));
    run_kernel(verbs, store_clusters_kernel, words,
               std::array{bits.get(), ranks.get(), unique_keys.fit(verbs, std::size_t{capacity(in)} * 4), state.get()}, layout_std(in, words));
}

void DeviceLists::find_bounds(Verbs& verbs, DeviceListsInput const& in) {
    std::size_t const n = in.frame.samples.size();
    std::uint32_t const numbers = 6 * capacity(in);
    clear_words(verbs, places.fit(verbs, std::size_t{numbers} * 4), numbers, DeviceStateStd::last_place);
    BoundClustersStd c{count_of(n), {}, {}, {}, {}};
    SampleDepth const depth(in.frame);
    to_floats(depth.eye(), c.eye);
    to_floats(math::to_float(in.frame.view.right), c.right);
    to_floats(math::to_float(-in.frame.view.up), c.down);
    to_floats(depth.forward(), c.forward);
    run_kernel(verbs, bound_clusters_kernel, (n + 15) / 16, std::array{in.samples, index.get(), places.get()}, c);
}

void DeviceLists::build_tree(Verbs& verbs, DeviceListsInput const& in) {
    std::size_t const n = in.lights.size();
    bvh::Layout const most = bvh::make_layout(count_of(n), tree_width);
    run_kernel(verbs, light_items_kernel, n,
               std::array{lights.get(), balls.fit(verbs, n * 16), everywhere.fit(verbs, n * 4), state.get()}, LightItemsStd{count_of(n), ~0U});
    pairs[1].fit(verbs, n * 8);
    // One item more: the first lays the tree out, of no lights too.
    run_kernel(verbs, light_codes_kernel, n + 1, std::array{balls.get(), state.get(), pairs[0].fit(verbs, n * 8)}, count_of(n));
    constexpr std::uint32_t code_bits = 31;  // and one for lights that take no part
    backend::BufferId const sorted = scan_.sort(verbs, pairs[0].get(), pairs[1].get(), {count_of(n), code_bits});
    std::array const leaves{balls.get(), sorted, state.get(), items.fit(verbs, std::size_t{most.item_slots} * 16), ids.fit(verbs, n * 4)};
    verbs(verbs.device().run(tree_leaves_kernel, {most.item_slots, leaves, {}, {}}));
    nodes.fit(verbs, std::size_t{most.node_slots} * 24);
    for (std::uint32_t level = 1; level <= most.levels; ++level) {
        std::size_t const slots = (std::size_t{most.count[level]} + tree_width - 1) / tree_width * tree_width;
        run_kernel(verbs, tree_nodes_kernel, slots, std::array{items.get(), state.get(), nodes.get()}, level);
    }
}

void DeviceLists::assign(Verbs& verbs, DeviceListsInput const& in, bool fill) {
    auto const& counts = in.layout.counts;
    std::uint32_t const groups = groups_for(capacity(in), verbs.device().limits().loop_rounds / assign_rounds(in.lights.size()));
    AssignLightsStd const c{fill ? 1U : 0U, groups, counts.columns, counts.rows, counts.slices,
                            in.grid.table().perspective, counts.cells, in.layout.packed ? 1U : 0U};
    run_kernel(verbs, assign_lights_kernel, std::size_t{c.groups} * backend::kernel_local_size,
               std::array{state.get(), unique_keys.get(), tables.get(), ready.get(), items.get(), nodes.get(), ids.get(), everywhere.get(),
                          offsets.get(), cells.get(), list.get()},
               c);
}

void DeviceLists::count(Verbs& verbs, DeviceListsInput const& in) {
    std::uint32_t const numbers = capacity(in) + 1;
    cells.fit(verbs, std::size_t{capacity(in)} * 8);
    list.fit(verbs, 4);
    std::size_t const n = in.lights.size();
    run_kernel(verbs, ready_lights_kernel, n, std::array{lights.get(), balls.get(), ready.fit(verbs, n * ready_words * 4)},
               ReadyLightsStd{count_of(n), in.grid.table().perspective});
    clear_words(verbs, offsets.fit(verbs, std::size_t{numbers} * 4), numbers, 0);
    assign(verbs, in, false);
    scan_.scan(verbs, offsets.get(), numbers);
    verbs(verbs.device().read(state.get(), 0, std::as_writable_bytes(std::span(&sizes_.state, 1))));
    verbs(verbs.device().read(offsets.get(), std::size_t{capacity(in)} * 4, std::as_writable_bytes(std::span(&sizes_.pairs, 1))));
}

void DeviceLists::fill(Verbs& verbs, DeviceListsInput const& in) {
    GNOMON_EXPECT(sizes_.pairs != ~0U);
    list.fit(verbs, std::size_t{sizes_.pairs} * 4);
    assign(verbs, in, true);
    // A lane compares a 64th of a short list's lights with all of it. Of long ones a group takes one.
    std::uint32_t const longest = sizes_.state.longest;
    std::uint32_t const share = (longest + backend::kernel_local_size - 1) / backend::kernel_local_size;
    std::uint32_t const at_once = longest > rank_longest ? 1 : most_iterations / (share * (longest + 2) + 1);
    std::uint32_t const groups = groups_for(sizes_.state.clusters, at_once);
    std::array const buffers{state.get(), cells.get(), list.get(), ordered.fit(verbs, std::size_t{sizes_.pairs} * 4)};
    std::uint32_t const most_steps = std::max(1U, (most_iterations - 1024) / std::max(1U, share));
    for (std::uint32_t step = 0; step < order_steps(longest); step += most_steps)
        run_kernel(verbs, order_lists_kernel, std::size_t{groups} * backend::kernel_local_size, buffers,
                   OrderListsStd{groups, step, step + most_steps});
}

}  // namespace gnomon::pipeline
