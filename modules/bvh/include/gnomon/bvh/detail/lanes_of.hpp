#pragma once
// Loading and storing items for one number or for lanes, and which lane count a function is compiled for.

#include <gnomon/bvh/items.hpp>
#include <gnomon/math/lanes.hpp>

#include <array>
#include <cstddef>

#if GNOMON_VECTOR_EXTENSION && (defined(__x86_64__) || defined(__i386__))
#define GNOMON_BVH_AVX2 1
#else
#define GNOMON_BVH_AVX2 0
#endif

namespace gnomon::bvh::detail {

[[nodiscard]] inline bool has_avx2() noexcept {
#if GNOMON_BVH_AVX2
    return __builtin_cpu_supports("avx2");
#else
    return false;
#endif
}

template <class S>
inline constexpr std::size_t lane_count = 1;
template <std::size_t N>
inline constexpr std::size_t lane_count<math::Lanes<float, N>> = N;

template <class S>
[[nodiscard, gnu::always_inline]] inline S load(float const* from) noexcept {
    if constexpr (lane_count<S> == 1) return *from;
    else return S::load(from);
}

template <class S>
[[gnu::always_inline]] inline void store(float* to, formula::Float<S> const& x) noexcept {
    if constexpr (lane_count<S> == 1) *to = x.v;
    else x.v.store(to);
}

/// Element `at` and, with lanes, those behind it.
template <class S, std::size_t fields>
[[nodiscard, gnu::always_inline]] inline ItemOf<S, fields> load_item(std::array<float const*, fields> const& arrays,
                                                                     std::size_t at) noexcept {
    ItemOf<S, fields> item;
    for (std::size_t k = 0; k < fields; ++k) item[k] = load<S>(arrays[k] + at);
    return item;
}

/// One bit per lane, lane 0 lowest.
template <class S>
[[nodiscard, gnu::always_inline]] inline std::uint32_t bits_of(formula::Bool<S> const& mask) noexcept {
    if constexpr (lane_count<S> == 1) return mask.v ? 1U : 0U;
    else return math::bits(mask.v);
}

}  // namespace gnomon::bvh::detail
