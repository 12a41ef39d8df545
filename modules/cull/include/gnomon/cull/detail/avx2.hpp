#pragma once
// Eight floats in an AVX2 register, for kernels that need the wide root and gathers; math::Lanes is the portable type.

#include <gnomon/math/lanes.hpp>

#if GNOMON_VECTOR_EXTENSION && defined(__x86_64__)
#define GNOMON_CULL_AVX2 1
#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#define GNOMON_ROWS_ISA gnu::target("avx2,bmi,bmi2,popcnt,lzcnt")
#define GNOMON_ROWS_INLINE [[GNOMON_ROWS_ISA, gnu::always_inline]] inline
#define GNOMON_ROWS_TARGET [[GNOMON_ROWS_ISA, gnu::flatten]]
/// The same code where there are 32 registers in place of 16: eight lights stay in them. These machines have fused
/// multiply-adds, which GCC would use unless told not to, and which change bits.
#if defined(__clang__)
#define GNOMON_ROWS_TARGET_32 [[gnu::target("avx2,bmi,bmi2,popcnt,lzcnt,avx512f,avx512vl"), gnu::flatten]]
#else
#define GNOMON_ROWS_TARGET_32 \
    [[gnu::target("avx2,bmi,bmi2,popcnt,lzcnt,avx512f,avx512vl"), gnu::optimize("fp-contract=off"), gnu::flatten]]
#endif

namespace gnomon::cull::detail {

[[nodiscard]] inline bool has_32_registers() noexcept {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl");
}
[[nodiscard]] inline bool has_avx2() noexcept {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("popcnt");
}

struct F8 {
    __m256 v;
};
struct I8 {
    __m256i v;
};

GNOMON_ROWS_INLINE F8 all(float x) noexcept { return {_mm256_set1_ps(x)}; }
GNOMON_ROWS_INLINE F8 load(float const* from) noexcept { return {_mm256_loadu_ps(from)}; }
GNOMON_ROWS_INLINE F8 spread(float const* from) noexcept { return {_mm256_broadcast_ss(from)}; }
GNOMON_ROWS_INLINE void store(float* to, F8 a) noexcept { _mm256_storeu_ps(to, a.v); }
GNOMON_ROWS_INLINE F8 operator+(F8 a, F8 b) noexcept { return {_mm256_add_ps(a.v, b.v)}; }
GNOMON_ROWS_INLINE F8 operator-(F8 a, F8 b) noexcept { return {_mm256_sub_ps(a.v, b.v)}; }
GNOMON_ROWS_INLINE F8 operator*(F8 a, F8 b) noexcept { return {_mm256_mul_ps(a.v, b.v)}; }
GNOMON_ROWS_INLINE F8 operator/(F8 a, F8 b) noexcept { return {_mm256_div_ps(a.v, b.v)}; }
GNOMON_ROWS_INLINE F8 root(F8 a) noexcept { return {_mm256_sqrt_ps(a.v)}; }
GNOMON_ROWS_INLINE F8 magnitude(F8 a) noexcept { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0F), a.v)}; }
/// b < a ? b : a, as gn_min: the instruction returns its second operand where the first is not less.
GNOMON_ROWS_INLINE F8 least(F8 a, F8 b) noexcept { return {_mm256_min_ps(b.v, a.v)}; }
GNOMON_ROWS_INLINE F8 greatest(F8 a, F8 b) noexcept { return {_mm256_max_ps(b.v, a.v)}; }
// Masks are F8 with all bits of a lane set or none.
GNOMON_ROWS_INLINE F8 operator<=(F8 a, F8 b) noexcept { return {_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)}; }
GNOMON_ROWS_INLINE F8 operator>=(F8 a, F8 b) noexcept { return {_mm256_cmp_ps(a.v, b.v, _CMP_GE_OQ)}; }
GNOMON_ROWS_INLINE F8 operator<(F8 a, F8 b) noexcept { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
GNOMON_ROWS_INLINE F8 operator>(F8 a, F8 b) noexcept { return {_mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ)}; }
GNOMON_ROWS_INLINE F8 operator&(F8 a, F8 b) noexcept { return {_mm256_and_ps(a.v, b.v)}; }
GNOMON_ROWS_INLINE F8 operator|(F8 a, F8 b) noexcept { return {_mm256_or_ps(a.v, b.v)}; }
GNOMON_ROWS_INLINE F8 and_not(F8 a, F8 b) noexcept { return {_mm256_andnot_ps(b.v, a.v)}; }  ///< a and not b
GNOMON_ROWS_INLINE F8 select(F8 mask, F8 yes, F8 no) noexcept { return {_mm256_blendv_ps(no.v, yes.v, mask.v)}; }
GNOMON_ROWS_INLINE std::uint32_t bits_of(F8 mask) noexcept { return static_cast<std::uint32_t>(_mm256_movemask_ps(mask.v)); }
/// One lane, by its bytes: the compiler may keep numbers of another type in another order.
template <class T>
[[nodiscard, gnu::always_inline]] inline T lane_of(void const* vector, std::uint32_t lane) noexcept {
    T one;
    __builtin_memcpy(&one, static_cast<unsigned char const*>(vector) + sizeof(T) * lane, sizeof(T));
    return one;
}
GNOMON_ROWS_INLINE F8 pick(F8 const& from, std::uint32_t lane) noexcept { return all(lane_of<float>(&from, lane)); }
/// Each lane's right neighbour; the last lane keeps its own.
GNOMON_ROWS_INLINE F8 next_lane(F8 a) noexcept {
    return {_mm256_permutevar8x32_ps(a.v, _mm256_setr_epi32(1, 2, 3, 4, 5, 6, 7, 7))};
}

GNOMON_ROWS_INLINE I8 all(std::int32_t x) noexcept { return {_mm256_set1_epi32(x)}; }
GNOMON_ROWS_INLINE I8 operator+(I8 a, I8 b) noexcept { return {_mm256_add_epi32(a.v, b.v)}; }
GNOMON_ROWS_INLINE I8 operator-(I8 a, I8 b) noexcept { return {_mm256_sub_epi32(a.v, b.v)}; }
GNOMON_ROWS_INLINE I8 operator*(I8 a, I8 b) noexcept { return {_mm256_mullo_epi32(a.v, b.v)}; }
GNOMON_ROWS_INLINE I8 least(I8 a, I8 b) noexcept { return {_mm256_min_epi32(a.v, b.v)}; }
GNOMON_ROWS_INLINE I8 greatest(I8 a, I8 b) noexcept { return {_mm256_max_epi32(a.v, b.v)}; }
GNOMON_ROWS_INLINE F8 operator>(I8 a, I8 b) noexcept { return {_mm256_castsi256_ps(_mm256_cmpgt_epi32(a.v, b.v))}; }
GNOMON_ROWS_INLINE I8 minus_one_where(F8 mask) noexcept { return {_mm256_castps_si256(mask.v)}; }
GNOMON_ROWS_INLINE void store(std::int32_t* to, I8 a) noexcept { _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), a.v); }
GNOMON_ROWS_INLINE std::uint32_t pick(I8 const& from, std::uint32_t lane) noexcept { return lane_of<std::uint32_t>(&from, lane); }
GNOMON_ROWS_INLINE F8 gather(float const* from, I8 at) noexcept { return {_mm256_i32gather_ps(from, at.v, 4)}; }

}  // namespace gnomon::cull::detail
#else
#define GNOMON_CULL_AVX2 0
#endif
