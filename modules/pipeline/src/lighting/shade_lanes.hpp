#pragma once
// Samples read from the G-buffer and shaded several at a time: gn_shade's bits, whatever the number of lanes.

#include <gnomon/backend/kernel.hpp>
#include <gnomon/math/half.hpp>
#include <gnomon/math/lanes.hpp>

#include "light_kernels.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace gnomon::pipeline {

/// What the kernels read of samples.
struct ShadedSamples {
    std::span<sample::ViewSample const> samples;
    std::span<std::uint32_t const> gbuffer;
    bool halves = false;
    bool orthographic = false;
    math::vec3 eye{0.0F};

    [[nodiscard]] GBufferTexel texel(std::size_t i) const noexcept {
        float numbers[16];
        if (halves)
            for (std::size_t k = 0; k < 16; ++k)
                numbers[k] = math::float_of_half(static_cast<std::uint16_t>(gbuffer[8 * i + k / 2] >> (k % 2 * 16)));
        else
            std::memcpy(numbers, gbuffer.data() + 16 * i, sizeof numbers);
        GBufferTexel texel;
        std::memcpy(&texel, numbers, sizeof texel);
        return texel;
    }
};

/// Up to N samples, a component after the other; lanes beyond repeat the last.
template <std::size_t N>
struct SampleLanes {
    float position[3][N];
    float normal[3][N];
    float diffuse[3][N];
    float specular[3][N];
    float emissive[3][N];
    float shininess[N];

    /// `index_of(k)` is the k-th of `count` samples, 1 to N of them.
    template <class IndexOf>
    void load(ShadedSamples const& from, std::size_t count, IndexOf&& index_of) noexcept {
        for (std::size_t k = 0; k < N; ++k) {
            std::size_t const i = index_of(k < count ? k : count - 1);
            GBufferTexel const t = from.texel(i);
            math::vec3 const& p = from.samples[i].position;
            position[0][k] = p.x;
            position[1][k] = p.y;
            position[2][k] = p.z;
            for (std::size_t c = 0; c < 3; ++c) {
                normal[c][k] = t.normal[c];
                diffuse[c][k] = t.diffuse[c];
                specular[c][k] = t.specular[c];
                emissive[c][k] = t.emissive[c];
            }
            shininess[k] = t.shininess;
        }
    }
};

template <std::size_t N>
[[gnu::always_inline]] inline formula::Vec3<math::Lanes<float, N>> lanes_of(float const (&v)[3][N]) noexcept {
    using Group = math::Lanes<float, N>;
    return {Group::load(v[0]), Group::load(v[1]), Group::load(v[2])};
}

template <std::size_t N>
[[gnu::always_inline]] inline formula::GnSurface<math::Lanes<float, N>> surface_of(SampleLanes<N> const& s,
                                                                                   ShadedSamples const& from) noexcept {
    using Group = math::Lanes<float, N>;
    formula::Vec3<Group> const position = lanes_of(s.position);
    formula::Vec3<Group> const eye(from.eye);
    return {position,
            lanes_of(s.normal),
            from.orthographic ? eye : gn_unit_or_up(eye - position),
            lanes_of(s.diffuse),
            lanes_of(s.specular),
            formula::Float<Group>(Group::load(s.shininess))};
}

}  // namespace gnomon::pipeline
