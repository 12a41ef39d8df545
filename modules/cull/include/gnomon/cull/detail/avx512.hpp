#pragma once
// Sixteen floats in an AVX-512 register: the names of avx2.hpp, with masks of a bit a lane.

#include <gnomon/cull/detail/avx2.hpp>

#if GNOMON_CULL_AVX2

#include <bit>

#define GNOMON_WIDE_ISA "avx2,bmi,bmi2,popcnt,lzcnt,avx512f,avx512vl,avx512bw,avx512dq,avx512vbmi2"
#define GNOMON_WIDE_INLINE [[gnu::target(GNOMON_WIDE_ISA), gnu::always_inline]] inline
#if defined(__clang__)
#define GNOMON_WIDE_TARGET [[gnu::target(GNOMON_WIDE_ISA)]]
#else
#define GNOMON_WIDE_TARGET [[gnu::target(GNOMON_WIDE_ISA), gnu::optimize("fp-contract=off")]]
#endif

/// GCC takes the undefined vectors of its own header for ours (its bug 105593), and, without optimization, its gathers are
/// macros whose masks of sixteen ones become signed numbers.
#if defined(__clang__)
#define GNOMON_WIDE_BEGIN
#define GNOMON_WIDE_END
#else
#define GNOMON_WIDE_BEGIN \
    _Pragma("GCC diagnostic push") _Pragma("GCC diagnostic ignored \"-Wmaybe-uninitialized\"") _Pragma("GCC diagnostic ignored \"-Wuninitialized\"") \
    _Pragma("GCC diagnostic ignored \"-Wsign-conversion\"")
#define GNOMON_WIDE_END _Pragma("GCC diagnostic pop")
#endif

GNOMON_WIDE_BEGIN
namespace gnomon::cull::detail {

/// Sixteen lanes, of floats and of 16-bit numbers that can be packed: Ice Lake, Zen 4, and later.
[[nodiscard]] inline bool has_wide_lanes() noexcept {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vbmi2") && has_avx2();
}

struct F16 {
    __m512 v;
};
struct I16 {
    __m512i v;
};
struct M16 {
    __mmask16 v;
};

GNOMON_WIDE_INLINE F16 wide(float x) noexcept { return {_mm512_set1_ps(x)}; }
GNOMON_WIDE_INLINE F16 wide_load(float const* from) noexcept { return {_mm512_loadu_ps(from)}; }
GNOMON_WIDE_INLINE F16 operator+(F16 a, F16 b) noexcept { return {_mm512_add_ps(a.v, b.v)}; }
GNOMON_WIDE_INLINE F16 operator-(F16 a, F16 b) noexcept { return {_mm512_sub_ps(a.v, b.v)}; }
GNOMON_WIDE_INLINE F16 operator*(F16 a, F16 b) noexcept { return {_mm512_mul_ps(a.v, b.v)}; }
GNOMON_WIDE_INLINE F16 operator/(F16 a, F16 b) noexcept { return {_mm512_div_ps(a.v, b.v)}; }
GNOMON_WIDE_INLINE F16 magnitude(F16 a) noexcept { return {_mm512_abs_ps(a.v)}; }
GNOMON_WIDE_INLINE F16 root(F16 a) noexcept { return {_mm512_sqrt_ps(a.v)}; }
GNOMON_WIDE_INLINE F16 least(F16 a, F16 b) noexcept { return {_mm512_min_ps(b.v, a.v)}; }
GNOMON_WIDE_INLINE F16 greatest(F16 a, F16 b) noexcept { return {_mm512_max_ps(b.v, a.v)}; }
GNOMON_WIDE_INLINE M16 operator<=(F16 a, F16 b) noexcept { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ)}; }
GNOMON_WIDE_INLINE M16 operator>=(F16 a, F16 b) noexcept { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_GE_OQ)}; }
GNOMON_WIDE_INLINE M16 operator<(F16 a, F16 b) noexcept { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)}; }
GNOMON_WIDE_INLINE M16 operator>(F16 a, F16 b) noexcept { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_GT_OQ)}; }
GNOMON_WIDE_INLINE M16 operator|(M16 a, M16 b) noexcept { return {static_cast<__mmask16>(a.v | b.v)}; }
GNOMON_WIDE_INLINE M16 operator&(M16 a, M16 b) noexcept { return {static_cast<__mmask16>(a.v & b.v)}; }
GNOMON_WIDE_INLINE M16 and_not(M16 a, M16 b) noexcept { return {static_cast<__mmask16>(a.v & ~b.v)}; }  ///< a and not b
GNOMON_WIDE_INLINE F16 select(M16 mask, F16 yes, F16 no) noexcept { return {_mm512_mask_blend_ps(mask.v, no.v, yes.v)}; }
/// Each lane's right neighbour; the last lane gets the first.
GNOMON_WIDE_INLINE F16 next_lane(F16 a) noexcept {
    return {_mm512_castsi512_ps(_mm512_alignr_epi32(_mm512_castps_si512(a.v), _mm512_castps_si512(a.v), 1))};
}

GNOMON_WIDE_INLINE I16 wide(std::uint32_t x) noexcept { return {_mm512_set1_epi32(static_cast<int>(x))}; }
GNOMON_WIDE_INLINE I16 wide_load(std::uint32_t const* from) noexcept { return {_mm512_loadu_si512(from)}; }
GNOMON_WIDE_INLINE void wide_store(std::uint32_t* to, I16 a) noexcept { _mm512_storeu_si512(to, a.v); }
GNOMON_WIDE_INLINE I16 lane_numbers() noexcept { return {_mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)}; }
GNOMON_WIDE_INLINE I16 operator+(I16 a, I16 b) noexcept { return {_mm512_add_epi32(a.v, b.v)}; }
GNOMON_WIDE_INLINE I16 operator-(I16 a, I16 b) noexcept { return {_mm512_sub_epi32(a.v, b.v)}; }
GNOMON_WIDE_INLINE I16 operator*(I16 a, I16 b) noexcept { return {_mm512_mullo_epi32(a.v, b.v)}; }
GNOMON_WIDE_INLINE I16 operator&(I16 a, I16 b) noexcept { return {_mm512_and_si512(a.v, b.v)}; }
template <unsigned places>
GNOMON_WIDE_INLINE I16 shift_right(I16 a) noexcept { return {_mm512_srli_epi32(a.v, places)}; }
GNOMON_WIDE_INLINE M16 operator==(I16 a, I16 b) noexcept { return {_mm512_cmpeq_epi32_mask(a.v, b.v)}; }
GNOMON_WIDE_INLINE M16 operator<(I16 a, I16 b) noexcept { return {_mm512_cmplt_epu32_mask(a.v, b.v)}; }
GNOMON_WIDE_INLINE M16 operator<=(I16 a, I16 b) noexcept { return {_mm512_cmple_epu32_mask(a.v, b.v)}; }
GNOMON_WIDE_INLINE I16 least(I16 a, I16 b) noexcept { return {_mm512_min_epu32(a.v, b.v)}; }
/// a + 1 where the mask is set.
GNOMON_WIDE_INLINE I16 add_one(I16 a, M16 mask) noexcept { return {_mm512_mask_add_epi32(a.v, mask.v, a.v, _mm512_set1_epi32(1))}; }
/// a - 1, at least 0.
GNOMON_WIDE_INLINE I16 one_less(I16 a) noexcept { return {_mm512_sub_epi32(_mm512_max_epu32(a.v, _mm512_set1_epi32(1)), _mm512_set1_epi32(1))}; }
/// The mask's lanes to the front.
GNOMON_WIDE_INLINE I16 packed(M16 mask, I16 a) noexcept { return {_mm512_maskz_compress_epi32(mask.v, a.v)}; }
/// The lanes at indices, of which the lower four bits count.
GNOMON_WIDE_INLINE F16 lookup(F16 from, I16 at) noexcept { return {_mm512_permutexvar_ps(at.v, from.v)}; }
GNOMON_WIDE_INLINE I16 lookup(I16 from, I16 at) noexcept { return {_mm512_permutexvar_epi32(at.v, from.v)}; }

/// A list of numbers to look up: where it is small, in two registers, with what lies behind it.
struct Table16 {
    float const* numbers;
    std::uint32_t count;
    __m512 low, high;
};
/// expects: 16 NaN behind the numbers.
GNOMON_WIDE_INLINE Table16 make_table(float const* numbers, std::uint32_t count) noexcept {
    return {numbers, count, _mm512_loadu_ps(numbers), _mm512_loadu_ps(numbers + (count > 16 ? 16 : count))};
}
/// expects: indices below the count, or, where that is `small` (at most 31), below 32: NaN.
template <bool small>
GNOMON_WIDE_INLINE F16 lookup(Table16 const& t, I16 at) noexcept {
    if constexpr (small) return {_mm512_permutex2var_ps(t.low, at.v, t.high)};
    else return {_mm512_i32gather_ps(at.v, t.numbers, 4)};
}
/// How many of a table's numbers, which ascend, are below x, or at it.
template <bool small, bool or_equal>
GNOMON_WIDE_INLINE I16 count_below(Table16 const& t, F16 x) noexcept {
    I16 n = wide(0U);
#pragma GCC unroll 5
    for (std::uint32_t step = small ? 16 : std::bit_floor(t.count); step > 0; step /= 2) {
        I16 at = n + wide(step - 1);
        __mmask16 const within = small ? 0xFFFFU : _mm512_cmplt_epu32_mask(at.v, wide(t.count).v);
        if constexpr (!small) at.v = _mm512_maskz_mov_epi32(within, at.v);
        F16 const number = lookup<small>(t, at);
        n.v = _mm512_mask_add_epi32(n.v, (or_equal ? number <= x : number < x).v & within, n.v, wide(step).v);
    }
    return n;
}

}  // namespace gnomon::cull::detail
GNOMON_WIDE_END
#endif
