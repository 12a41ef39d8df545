// The kernels of keys and unique clusters: their C++ halves. [Olsson 2014, Paper II, 3.1, 3.2]

#include <shaders/bound_clusters_comp.hpp>
#include <shaders/clear_words_comp.hpp>
#include <shaders/cluster_keys_comp.hpp>
#include <shaders/link_clusters_comp.hpp>
#include <shaders/mark_clusters_comp.hpp>
#include <shaders/rank_clusters_comp.hpp>
#include <shaders/store_clusters_comp.hpp>

#include "../detail.hpp"
#include "device_kernels.hpp"
#include "device_layout.hpp"

#include <gnomon/cluster/formula/grid.glsl>
#include <gnomon/cluster/key.hpp>
#include <gnomon/math/formula/bits.glsl>
#include <gnomon/math/scalar.hpp>
#include <gnomon/sample/view_sample.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>

namespace gnomon::pipeline {

namespace {

using Key = std::uint32_t;

formula::Vec3<float> vec3_of(float const (&v)[3]) noexcept { return {v[0], v[1], v[2]}; }

DeviceLayout layout_of(ClusterLayoutStd const& c) noexcept { return {{c.columns, c.rows, c.slices, c.cells, 0}, c.packed != 0}; }

void find_device_keys(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<ClusterKeysStd>();
    auto const samples = data.buffer<sample::ViewSample const>(0);
    auto const pixels = data.buffer<std::uint32_t const>(1);
    auto const normals = data.buffer<math::vec3 const>(2);
    formula::Words const words{data.buffer<std::uint32_t const>(3).data()};
    auto const keys = data.buffer<Key>(4);
    std::uint32_t const cells = c.normal_n != 0 ? 6 * c.normal_n * c.normal_n : 1;
    DeviceLayout const layout{{c.grid.columns, c.grid.rows, c.grid.depth.slices, cells, c.normal_n}, c.packed != 0};
    using Uint = formula::Uint<float>;
    for (std::size_t i = begin; i < std::min<std::size_t>(end, c.count); ++i) {
        formula::Vec3<float> const offset = formula::Vec3<float>(samples[i].position) - vec3_of(c.eye);
        std::uint32_t const cell = c.normal_n != 0 ? cluster::normal_cell(normals[i], c.normal_n) : 0;
        keys[i] = layout.key({gn_column_of(c.grid, Uint(pixels[i] % c.width)).v, gn_row_of(c.grid, Uint(pixels[i] / c.width)).v,
                              gn_slice_at(c.grid.depth, words, gn_along(offset, vec3_of(c.forward))).v, cell});
    }
}

void clear_device_words(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<ClearWordsStd>();
    auto const words = data.buffer<std::uint32_t>(0);
    for (std::size_t i = begin; i < std::min<std::size_t>(end, c.count); ++i) words[i] = c.value;
}

void mark_device_clusters(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<ClusterLayoutStd>();
    auto const keys = data.buffer<Key const>(0);
    auto const bits = data.buffer<std::uint32_t>(1);
    DeviceStateStd& state = data.buffer<DeviceStateStd>(2)[0];
    auto const layout = layout_of(c);
    for (std::size_t i = begin; i < std::min<std::size_t>(end, c.count); ++i) {
        if (!layout.holds(keys[i])) {
            std::atomic_ref<std::uint32_t>(keys[i] == cluster::no_key<Key> ? state.background : state.invalid).fetch_add(1, std::memory_order_relaxed);
            continue;
        }
        if (i != begin && keys[i - 1] == keys[i]) continue;
        std::uint32_t const number = layout.number(keys[i]);
        std::atomic_ref<std::uint32_t>(bits[number >> 5U]).fetch_or(1U << (number & 31U), std::memory_order_relaxed);
    }
}

void rank_device_clusters(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    std::size_t const words = data.constant<std::uint32_t>();
    auto const bits = data.buffer<std::uint32_t const>(0);
    auto const ranks = data.buffer<std::uint32_t>(1);
    for (std::size_t i = begin; i < std::min(end, words + 1); ++i)
        ranks[i] = i < words ? static_cast<std::uint32_t>(std::popcount(bits[i])) : 0;
}

void link_device_clusters(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<ClusterLayoutStd>();
    auto const keys = data.buffer<Key const>(0);
    auto const bits = data.buffer<std::uint32_t const>(1);
    auto const ranks = data.buffer<std::uint32_t const>(2);
    auto const index = data.buffer<std::uint32_t>(3);
    auto const layout = layout_of(c);
    for (std::size_t i = begin; i < std::min<std::size_t>(end, c.count); ++i) {
        index[i] = cluster::no_cluster;
        if (!layout.holds(keys[i])) continue;
        std::uint32_t const number = layout.number(keys[i]);
        std::uint32_t const below = bits[number >> 5U] & ((1U << (number & 31U)) - 1U);
        index[i] = ranks[number >> 5U] + static_cast<std::uint32_t>(std::popcount(below));
    }
}

void store_device_clusters(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<ClusterLayoutStd>();
    auto const bits = data.buffer<std::uint32_t const>(0);
    auto const ranks = data.buffer<std::uint32_t const>(1);
    auto const unique = data.buffer<Key>(2);
    auto const layout = layout_of(c);
    if (begin == 0) data.buffer<DeviceStateStd>(3)[0].clusters = ranks[c.count];
    for (std::size_t i = begin; i < std::min<std::size_t>(end, c.count); ++i) {
        std::uint32_t at = ranks[i];
        for (std::uint32_t left = bits[i]; left != 0; left &= left - 1U)
            unique[at++] = layout.key(static_cast<std::uint32_t>(i * 32) + static_cast<std::uint32_t>(std::countr_zero(left)));
    }
}

/// Lowers a place that other threads may be lowering.
void lower_place(std::int32_t& value, std::int32_t other) noexcept {
    std::atomic_ref<std::int32_t> const shared(value);
    std::int32_t now = shared.load(std::memory_order_relaxed);
    while (other < now && !shared.compare_exchange_weak(now, other, std::memory_order_relaxed)) {}
}

void bound_device_clusters(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<BoundClustersStd>();
    auto const samples = data.buffer<sample::ViewSample const>(0);
    auto const index = data.buffer<std::uint32_t const>(1);
    auto const places = data.buffer<std::int32_t>(2);
    for (std::size_t i = begin * 16; i < std::min<std::size_t>(end * 16, c.count); ++i) {
        if (index[i] == cluster::no_cluster) continue;
        formula::Vec3<float> const offset = formula::Vec3<float>(samples[i].position) - vec3_of(c.eye);
        std::array const at{gn_along(offset, vec3_of(c.right)).v, gn_along(offset, vec3_of(c.down)).v,
                            gn_along(offset, vec3_of(c.forward)).v};
        if (!math::is_finite(math::vec3(at[0], at[1], at[2]))) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lower_place(places[std::size_t{6} * index[i] + axis], math::ordinal(at[axis]));
            lower_place(places[std::size_t{6} * index[i] + axis + 3], -math::ordinal(at[axis]));
        }
    }
}

}  // namespace

constinit backend::Kernel const cluster_keys_kernel{.name = "cluster_keys",
                                                    .cpu = &find_device_keys,
                                                    .spirv = cluster_keys_comp,
                                                    .buffers = 5,
                                                    .constant_bytes = sizeof(ClusterKeysStd),
                                                    .grain = sample_grain};
constinit backend::Kernel const clear_words_kernel{
    .name = "clear_words", .cpu = &clear_device_words, .spirv = clear_words_comp, .buffers = 1, .constant_bytes = sizeof(ClearWordsStd), .grain = 65536};
constinit backend::Kernel const mark_clusters_kernel{.name = "mark_clusters",
                                                     .cpu = &mark_device_clusters,
                                                     .spirv = mark_clusters_comp,
                                                     .buffers = 3,
                                                     .constant_bytes = sizeof(ClusterLayoutStd),
                                                     .grain = sample_grain};
constinit backend::Kernel const rank_clusters_kernel{
    .name = "rank_clusters", .cpu = &rank_device_clusters, .spirv = rank_clusters_comp, .buffers = 2, .constant_bytes = 4, .grain = 65536};
constinit backend::Kernel const link_clusters_kernel{.name = "link_clusters",
                                                     .cpu = &link_device_clusters,
                                                     .spirv = link_clusters_comp,
                                                     .buffers = 4,
                                                     .constant_bytes = sizeof(ClusterLayoutStd),
                                                     .grain = sample_grain};
constinit backend::Kernel const store_clusters_kernel{.name = "store_clusters",
                                                      .cpu = &store_device_clusters,
                                                      .spirv = store_clusters_comp,
                                                      .buffers = 4,
                                                      .constant_bytes = sizeof(ClusterLayoutStd),
                                                      .grain = sample_grain};
constinit backend::Kernel const bound_clusters_kernel{.name = "bound_clusters",
                                                      .cpu = &bound_device_clusters,
                                                      .spirv = bound_clusters_comp,
                                                      .buffers = 3,
                                                      .constant_bytes = sizeof(BoundClustersStd),
                                                      .grain = 1024};

}  // namespace gnomon::pipeline
