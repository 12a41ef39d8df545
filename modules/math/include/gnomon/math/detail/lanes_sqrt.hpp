#pragma once
// Square roots of lanes: std::sqrt's bits, by the machine's vector instruction where there is one.

#include <gnomon/math/lanes.hpp>

#include <cmath>
#include <cstddef>

#if GNOMON_VECTOR_EXTENSION && defined(__SSE2__)
#include <immintrin.h>
#endif

namespace gnomon::math {

/// The root of each lane, rounded to nearest; NaN below zero.
template <std::floating_point T, std::size_t N>
[[nodiscard, gnu::always_inline]] inline Lanes<T, N> sqrt(Lanes<T, N> const& a) noexcept {
    Lanes<T, N> r;
#if GNOMON_VECTOR_EXTENSION && defined(__SSE2__)
    if constexpr (sizeof(T) == 4 && N >= 4) {
        alignas(16) T parts[N];
        a.store(parts);
        for (std::size_t i = 0; i < N; i += 4) _mm_store_ps(parts + i, _mm_sqrt_ps(_mm_load_ps(parts + i)));
        return Lanes<T, N>::load(parts);
    }
#endif
    for (std::size_t i = 0; i < N; ++i) r.v[i] = std::sqrt(a.v[i]);
    return r;
}

}  // namespace gnomon::math
