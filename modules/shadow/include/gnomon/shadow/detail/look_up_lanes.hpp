#pragma once
// The lookup's formula over N receivers at once, and the same compiled for AVX2: gn_look_up's bits, whatever N.

#include <gnomon/shadow/lookup.hpp>

#include <cstddef>
#include <span>

namespace gnomon::shadow::detail {

/// Looks up `out.size()` surfaces, at most N of them; lanes beyond repeat the last.
template <std::size_t N, TexelSource Source>
[[gnu::always_inline]] inline void look_up_group(MapView const& map, Source const& texels,
                                                 formula::GnShadowConfig const& config,
                                                 std::span<Surface const> surfaces, std::span<Lookup> out) noexcept {
    using Group = math::Lanes<float, N>;
    float at[6][N];
    for (std::size_t k = 0; k < N; ++k) {
        Surface const& surface = surfaces[k < surfaces.size() ? k : surfaces.size() - 1];
        at[0][k] = surface.position.x;
        at[1][k] = surface.position.y;
        at[2][k] = surface.position.z;
        at[3][k] = surface.normal.x;
        at[4][k] = surface.normal.y;
        at[5][k] = surface.normal.z;
    }
    formula::Vec3<Group> const position(Group::load(at[0]), Group::load(at[1]), Group::load(at[2]));
    formula::Vec3<Group> const normal(Group::load(at[3]), Group::load(at[4]), Group::load(at[5]));
    formula::GnLookup<Group> const seen = gn_look_up(map, texels, position, normal, config);
    seen.visibility.v.store(at[0]);
    seen.bias_m.v.store(at[1]);
    for (std::size_t k = 0; k < out.size() && k < N; ++k) out[k] = {at[0][k], at[1][k]};
}

template <std::size_t N, TexelSource Source>
[[gnu::always_inline]] inline void look_up_lanes(MapView const& map, Source const& texels,
                                                 formula::GnShadowConfig const& config,
                                                 std::span<Surface const> surfaces, std::span<Lookup> out) noexcept {
    for (std::size_t i = 0; i < surfaces.size(); i += N) {
        std::size_t const count = surfaces.size() - i < N ? surfaces.size() - i : N;
        look_up_group<N>(map, texels, config, surfaces.subspan(i, count), out.subspan(i, count));
    }
}

#if GNOMON_VECTOR_EXTENSION && (defined(__x86_64__) || defined(__i386__))
#define GNOMON_SHADOW_AVX2 1

[[nodiscard]] inline bool has_avx2() noexcept { return __builtin_cpu_supports("avx2"); }

template <TexelSource Source>
[[gnu::target("avx2"), gnu::flatten]] void look_up_avx2(MapView const& map, Source const& texels,
                                                        formula::GnShadowConfig const& config,
                                                        std::span<Surface const> surfaces,
                                                        std::span<Lookup> out) noexcept {
    look_up_lanes<8>(map, texels, config, surfaces, out);
}
#else
#define GNOMON_SHADOW_AVX2 0
#endif

}  // namespace gnomon::shadow::detail
