// The kernel `shade_tiles`: its C++ half.

#include <shaders/shade_tiles_comp.hpp>

#include <gnomon/cull/tile_planes.hpp>
#include <gnomon/math/formula/view.glsl>

#include "../detail.hpp"
#include "device_kernels.hpp"
#include "light_kernels.hpp"
#include "shade_lanes.hpp"
#include "tile_kernels.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace gnomon::pipeline {

namespace {

struct TileShading {
    ShadeTilesStd c;
    ShadedSamples from;
    std::span<lights::ShadedLight const> lights;
    std::span<std::uint32_t const> sample_of;
    std::span<float const> balls;
    std::span<cull::TileBorder const> borders;
    std::span<math::vec3> radiance;
    std::span<std::uint32_t> computations;
    std::span<std::uint32_t> lights_of;
    std::span<std::uint32_t const> marks;

    explicit TileShading(backend::KernelData const& data)
        : c(data.constant<ShadeTilesStd>()),
          from{data.buffer<sample::ViewSample const>(0), data.buffer<std::uint32_t const>(1), c.halves != 0, c.orthographic != 0,
               math::vec3(c.eye[0], c.eye[1], c.eye[2])},
          lights(data.buffer<lights::ShadedLight const>(2)),
          sample_of(data.buffer<std::uint32_t const>(3)),
          balls(data.buffer<float const>(4)),
          borders(data.buffer<cull::TileBorder const>(5)),
          radiance(data.buffer<math::vec3>(6)),
          computations(data.buffer<std::uint32_t>(7)),
          lights_of(data.buffer<std::uint32_t>(8)),
          marks(data.buffer<std::uint32_t const>(9)) {}

    [[nodiscard]] float depth_of(std::size_t sample) const noexcept {
        math::vec3 const offset = from.samples[sample].position - math::vec3(c.from[0], c.from[1], c.from[2]);
        return formula::gn_dot(formula::Vec3<float>(offset), formula::Vec3<float>(c.forward[0], c.forward[1], c.forward[2])).v;
    }
    /// Calls `use(sample)` for those of a tile.
    template <class F>
    [[gnu::always_inline]] void each_sample(std::uint32_t tile, F&& use) const {
        std::uint32_t const x = tile % c.columns * c.tile, y = tile / c.columns * c.tile;
        for (std::uint32_t row = y; row < std::min(y + c.tile, c.height); ++row)
            for (std::uint32_t column = x; column < std::min(x + c.tile, c.width); ++column)
                if (std::uint32_t const i = sample_of[std::size_t{row} * c.width + column]; i != no_sample) use(i);
    }
    /// Bits of N lights of a tile from `first`, a multiple of N.
    template <std::size_t N>
    [[nodiscard]] std::uint32_t marks_of(std::uint32_t tile, std::uint32_t first) const noexcept {
        return marks[std::size_t{tile} * (c.lights / 32) + first / 32] >> (first % 32) & ((1U << N) - 1U);
    }
    [[nodiscard]] cull::TilePlanes planes_of(std::uint32_t tile, cull::DepthRange const& depths) const noexcept {
        std::size_t const column = tile % c.columns, row = c.columns + 1 + tile / c.columns;
        return formula::gn_tile_planes({borders[column], borders[column + 1], borders[row], borders[row + 1], depths.near_m, depths.far_m},
                                       c.orthographic == 0);
    }
};

/// What a tile tests lights by.
struct BallTest {
    std::uint32_t tile;
    cull::DepthRange depths;
    cull::TilePlanes planes;

    template <std::size_t N>
    [[nodiscard, gnu::always_inline]] inline std::uint32_t keep(TileShading const& s, std::uint32_t first) const noexcept {
        using Group = math::Lanes<float, N>;
        std::uint32_t const marked = s.c.marked != 0 ? s.marks_of<N>(tile, first) : ~0U;
        if (marked == 0) return 0;
        std::size_t const n = s.c.lights;
        float const* const at = s.balls.data() + first;
        formula::GnSphere<Group> const balls{{Group::load(at), Group::load(at + n), Group::load(at + 2 * n)}, Group::load(at + 3 * n)};
        if (s.c.marked != 0) return marked & math::bits(gn_touches_depths(depths.near_m, depths.far_m, balls).v);
        return math::bits(gn_touches_tile(planes, balls).v);
    }
};

/// The lights of a tile, ascending, as many at a time as a list holds.
struct TileList {
    std::uint32_t light[tile_list_size];
    std::uint32_t count = 0;
    std::uint32_t next;  ///< The first light that was not tested.

    template <std::size_t N>
    [[gnu::always_inline]] void fill(TileShading const& s, BallTest const& test) noexcept {
        for (count = 0; next < s.c.end && count + backend::kernel_local_size <= tile_list_size; next += N)
            for (std::uint32_t kept = test.keep<N>(s, next); kept != 0; kept &= kept - 1)
                light[count++] = next + static_cast<std::uint32_t>(__builtin_ctz(kept));
    }
};

/// Adds the lights of a list to at most N samples; `before` of them were added already.
template <std::size_t N>
[[gnu::always_inline]] inline void add_lights(TileShading const& s, TileList const& list, std::uint32_t before, std::uint32_t const (&sample)[N],
                                              std::size_t count) noexcept {
    SampleLanes<N> lanes;
    lanes.load(s.from, count, [&](std::size_t k) { return sample[k]; });
    auto const surface = surface_of(lanes, s.from);
    float out[3][N];
    if (before != 0)
        for (std::size_t k = 0; k < N; ++k)
            for (math::axis_t axis = 0; axis < 3; ++axis) lanes.emissive[axis][k] = s.radiance[sample[k < count ? k : count - 1]][axis];
    auto sum = lanes_of(lanes.emissive);
    for (std::uint32_t i = 0; i < list.count; ++i) sum = sum + gn_shade(s.lights[list.light[i]], surface);
    sum.x.v.store(out[0]);
    sum.y.v.store(out[1]);
    sum.z.v.store(out[2]);
    for (std::size_t k = 0; k < count; ++k) {
        s.radiance[sample[k]] = math::vec3(out[0][k], out[1][k], out[2][k]);
        s.computations[sample[k]] = before + list.count;
    }
}

template <std::size_t N>
[[gnu::always_inline]] inline void shade_tile(TileShading const& s, std::uint32_t tile) noexcept {
    cull::DepthRange depths;
    s.each_sample(tile, [&](std::uint32_t i) { depths.add(s.depth_of(i)); });
    bool const any = depths.near_m <= depths.far_m;
    BallTest const test{tile, depths, s.planes_of(tile, depths)};
    TileList list;
    list.next = s.c.first;
    std::uint32_t before = s.c.first != 0 ? s.lights_of[tile] : 0;
    do {
        if (any) list.fill<N>(s, test);
        else list.next = s.c.end;
        std::uint32_t sample[N];
        std::size_t count = 0;
        s.each_sample(tile, [&](std::uint32_t i) {
            sample[count++] = i;
            if (count == N) add_lights<N>(s, list, before, sample, std::exchange(count, 0));
        });
        if (count != 0) add_lights<N>(s, list, before, sample, count);
        before += list.count;
    } while (list.next < s.c.end);
    s.lights_of[tile] = before;
}

template <std::size_t N>
[[gnu::always_inline]] inline void shade_range(TileShading const& s, std::size_t begin, std::size_t end) noexcept {
    for_each_group(begin, end, [&](std::size_t tile) { shade_tile<N>(s, static_cast<std::uint32_t>(tile)); });
}

#if GNOMON_VECTOR_EXTENSION && defined(__x86_64__)
[[gnu::target("avx2"), gnu::flatten]] void shade_tiles_avx2(TileShading const& s, std::size_t begin, std::size_t end) noexcept {
    shade_range<8>(s, begin, end);
}
#endif

void shade_tiles(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    TileShading const s(data);
#if GNOMON_VECTOR_EXTENSION && defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return shade_tiles_avx2(s, begin, end);
#endif
    shade_range<4>(s, begin, end);
}

}  // namespace

constinit backend::Kernel const shade_tiles_kernel{.name = "shade_tiles",
                                                   .cpu = &shade_tiles,
                                                   .spirv = shade_tiles_comp,
                                                   .buffers = 10,
                                                   .constant_bytes = sizeof(ShadeTilesStd),
                                                   .grain = 4 * backend::kernel_local_size};

}  // namespace gnomon::pipeline
