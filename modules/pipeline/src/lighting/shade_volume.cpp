// The kernel `shade_volume`: its C++ half.

#include <shaders/shade_volume_comp.hpp>

#include "light_kernels.hpp"
#include "shade_lanes.hpp"

#include <cstddef>
#include <cstdint>

namespace gnomon::pipeline {

namespace {

struct Volume {
    ShadedSamples from;
    lights::ShadedLight light;
    std::span<math::vec3> radiance;
    std::span<std::uint32_t> computations;
    bool stencil = false;

    [[nodiscard]] bool evaluates(std::size_t i) const noexcept {
        formula::Vec3<float> const p(from.samples[i].position);
        if (stencil) return gn_see_light(light, p).within.v;
        formula::Vec3<float> const eye(from.eye);
        return gn_covered(light, p, from.orthographic ? eye : gn_unit_or_up(eye - p)).v;
    }
};

/// Samples that are waiting for a full group.
template <std::size_t N>
struct Group {
    std::size_t sample[N];
    std::size_t count = 0;
};

template <std::size_t N>
[[gnu::always_inline]] inline void add_light(Volume const& v, Group<N>& group) noexcept {
    if (group.count == 0) return;
    SampleLanes<N> lanes;
    lanes.load(v.from, group.count, [&](std::size_t k) { return group.sample[k]; });
    auto const added = gn_shade(v.light, surface_of(lanes, v.from));
    float out[3][N];
    added.x.v.store(out[0]);
    added.y.v.store(out[1]);
    added.z.v.store(out[2]);
    for (std::size_t k = 0; k < group.count; ++k) {
        math::vec3& sum = v.radiance[group.sample[k]];
        sum = sum + math::vec3(out[0][k], out[1][k], out[2][k]);
        ++v.computations[group.sample[k]];
    }
    group.count = 0;
}

template <std::size_t N>
[[gnu::always_inline]] inline void add_pixels(Volume const& v, backend::KernelData const& data, ShadeVolumeStd const& c,
                                              std::size_t begin, std::size_t end) noexcept {
    auto const sample_of = data.buffer<std::uint32_t const>(3);
    Group<N> group;
    for (std::size_t item = begin; item < end; ++item) {
        std::uint32_t const i = sample_of[(c.y + item / c.width) * c.image_width + c.x + item % c.width];
        if (i == no_sample || !v.evaluates(i)) continue;
        group.sample[group.count++] = i;
        if (group.count == N) add_light(v, group);
    }
    add_light(v, group);
}

#if GNOMON_VECTOR_EXTENSION && defined(__x86_64__)
[[gnu::target("avx2"), gnu::flatten]] void add_avx2(Volume const& v, backend::KernelData const& data, ShadeVolumeStd const& c,
                                                    std::size_t begin, std::size_t end) noexcept {
    add_pixels<8>(v, data, c, begin, end);
}
#endif

void add(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<ShadeVolumeStd>();
    Volume const v{{data.buffer<sample::ViewSample const>(0), data.buffer<std::uint32_t const>(1), c.halves != 0,
                    c.orthographic != 0, math::vec3(c.eye[0], c.eye[1], c.eye[2])},
                   data.buffer<lights::ShadedLight const>(2)[c.light],
                   data.buffer<math::vec3>(4),
                   data.buffer<std::uint32_t>(5),
                   c.stencil != 0};
#if GNOMON_VECTOR_EXTENSION && defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return add_avx2(v, data, c, begin, end);
#endif
    add_pixels<4>(v, data, c, begin, end);
}

}  // namespace

constinit backend::Kernel const shade_volume_kernel{.name = "shade_volume",
                                                    .cpu = &add,
                                                    .spirv = shade_volume_comp,
                                                    .buffers = 6,
                                                    .constant_bytes = sizeof(ShadeVolumeStd),
                                                    .grain = 4096};

}  // namespace gnomon::pipeline
