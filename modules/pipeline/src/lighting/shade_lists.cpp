// The kernel `shade_lists`: its C++ half.

#include <shaders/shade_lists_comp.hpp>

#include "../detail.hpp"
#include "light_kernels.hpp"
#include "shade_lanes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace gnomon::pipeline {

namespace {

/// lights::Cell.
struct Cell {
    std::uint32_t offset;
    std::uint32_t count;
};

struct Shaded {
    ShadedSamples from;
    std::span<lights::ShadedLight const> lights;
    std::span<std::uint32_t const> list_of;
    std::span<Cell const> cells;
    std::span<std::uint32_t const> indices;
    std::span<math::vec3> radiance;
    std::span<std::uint32_t> computations;
    std::uint32_t begin, end;  ///< Places in lists.

    [[nodiscard]] Cell cell(std::uint32_t list) const noexcept { return list != no_list ? cells[list] : Cell{0, 0}; }
};

/// Shades samples [first, first + count), count <= N, which share a list.
template <std::size_t N>
[[gnu::always_inline]] inline void shade_group(Shaded const& s, std::size_t first, std::size_t count) noexcept {
    Cell const cell = s.cell(s.list_of[first]);
    if (s.begin != 0 && cell.count <= s.begin) return;
    SampleLanes<N> lanes;
    lanes.load(s.from, count, [&](std::size_t k) { return first + k; });
    auto const surface = surface_of(lanes, s.from);
    auto sum = lanes_of(lanes.emissive);
    if (s.begin != 0) {
        float held[3][N] = {};
        for (std::size_t k = 0; k < count; ++k)
            for (math::axis_t axis = 0; axis < 3; ++axis) held[axis][k] = s.radiance[first + k][axis];
        sum = lanes_of(held);
    }
    for (std::uint32_t const index : s.indices.subspan(cell.offset + s.begin, std::min(s.end, cell.count) - s.begin)) sum = sum + gn_shade(s.lights[index], surface);
    float out[3][N];
    sum.x.v.store(out[0]);
    sum.y.v.store(out[1]);
    sum.z.v.store(out[2]);
    for (std::size_t k = 0; k < count; ++k) {
        s.radiance[first + k] = math::vec3(out[0][k], out[1][k], out[2][k]);
        s.computations[first + k] = cell.count;
    }
}

template <std::size_t N>
[[gnu::always_inline]] inline void shade_samples(Shaded const& s, std::size_t begin, std::size_t end) noexcept {
    for (std::size_t i = begin; i < end;) {
        std::size_t count = 1;
        while (count < N && i + count < end && s.list_of[i + count] == s.list_of[i]) ++count;
        shade_group<N>(s, i, count);
        i += count;
    }
}

#if GNOMON_VECTOR_EXTENSION && defined(__x86_64__)
[[gnu::target("avx2"), gnu::flatten]] void shade_avx2(Shaded const& s, std::size_t begin, std::size_t end) noexcept {
    shade_samples<8>(s, begin, end);
}
#endif

void shade(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<ShadeListsStd>();
    Shaded const s{{data.buffer<sample::ViewSample const>(0), data.buffer<std::uint32_t const>(1), c.halves != 0,
                    c.orthographic != 0, math::vec3(c.eye[0], c.eye[1], c.eye[2])},
                   data.buffer<lights::ShadedLight const>(2),
                   data.buffer<std::uint32_t const>(3),
                   data.buffer<Cell const>(4),
                   data.buffer<std::uint32_t const>(5),
                   data.buffer<math::vec3>(6),
                   data.buffer<std::uint32_t>(7),
                   c.first,
                   c.end};
#if GNOMON_VECTOR_EXTENSION && defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return shade_avx2(s, begin, end);
#endif
    shade_samples<4>(s, begin, end);
}

}  // namespace

constinit backend::Kernel const shade_lists_kernel{.name = "shade_lists",
                                                   .cpu = &shade,
                                                   .spirv = shade_lists_comp,
                                                   .buffers = 8,
                                                   .constant_bytes = sizeof(ShadeListsStd),
                                                   .grain = sample_grain};

}  // namespace gnomon::pipeline
