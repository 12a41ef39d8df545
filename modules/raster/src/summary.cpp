// Blocks' least and greatest depths: the reference, and eight columns at a time.

#include "summary.hpp"

#include "kernel.hpp"

#include <limits>

namespace gnomon::raster::detail {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Columns [x0, x1) of the rows.
void summarize_block(SampleRows const& rows, std::int32_t x0, std::int32_t x1, float& least, float& greatest) {
    float low = infinity;
    float high = -infinity;
    for (std::int32_t y = 0; y < rows.height; ++y)
        for (std::int32_t x = x0; x < x1; ++x) {
            float const z = rows.first[y * rows.pitch + x];
            low = z < low ? z : low;
            high = z > high ? z : high;
        }
    least = low;
    greatest = high;
}

void summarize(SampleRows const& rows, float* least, float* greatest) {
    for (std::int32_t x = 0; x < rows.width; x += 8)
        summarize_block(rows, x, x + 8 < rows.width ? x + 8 : rows.width, least[x >> 3], greatest[x >> 3]);
}

struct RowPair {
    float const* upper;
    float const* lower;
    std::int32_t width;
};

void summarize_blocked(float const* first, float* least, float* greatest) {
    for (std::int32_t b = 0; b < 8; ++b) {
        float low[2];
        float high[2];
        for (std::int32_t half = 0; half < 2; ++half)  // Two blocks of 4 x 4 lie one after the other.
            summarize_block({first + 32 * b + blocked_offset(0, 4 * half), 32, 32, 1}, 0, 32, low[half], high[half]);
        least[b] = low[0] < low[1] ? low[0] : low[1];
        greatest[b] = high[0] > high[1] ? high[0] : high[1];
    }
}

/// Elements [x, ceil(width / 2)) of the halved row.
template <class Pick>
void halve_from(std::int32_t x, RowPair const& rows, float* out, Pick pick) {
    for (; 2 * x < rows.width; ++x) {
        std::int32_t const a = 2 * x;
        std::int32_t const b = a + 1 < rows.width ? a + 1 : a;
        out[x] = pick(pick(rows.upper[a], rows.upper[b]), pick(rows.lower[a], rows.lower[b]));
    }
}

float lesser(float a, float b) { return a < b ? a : b; }
float greater(float a, float b) { return a > b ? a : b; }

void halve_least(float const* upper, float const* lower, std::int32_t width, float* out) {
    halve_from(0, {upper, lower, width}, out, lesser);
}
void halve_greatest(float const* upper, float const* lower, std::int32_t width, float* out) {
    halve_from(0, {upper, lower, width}, out, greater);
}

}  // namespace

SummaryTable const& scalar_summary() noexcept {
    static constexpr SummaryTable table{&summarize, &summarize_blocked, &halve_least, &halve_greatest};
    return table;
}

}  // namespace gnomon::raster::detail

#if defined(__x86_64__) && defined(__GNUC__) && !defined(GNOMON_FORCE_SCALAR) && !defined(GNOMON_SCALAR)

#include "avx2.hpp"

namespace gnomon::raster::detail {

namespace {

/// Element i: the least (or greatest) of v[i].
template <bool Least>
GNOMON_AVX2_INLINE __m256 reduced(__m256 (&v)[8]) {
    __m256i rows[8];
    for (int i = 0; i < 8; ++i) rows[i] = as_int(v[i]);
    transpose_8x8(rows);
    __m256 all = as_float(rows[0]);
    for (int i = 1; i < 8; ++i)
        all = Least ? _mm256_min_ps(as_float(rows[i]), all) : _mm256_max_ps(as_float(rows[i]), all);
    return all;
}

GNOMON_AVX2 void avx2_summarize(SampleRows const& rows, float* least, float* greatest) {
    std::int32_t x = 0;
    for (; x + 64 <= rows.width; x += 64) {
        __m256 low[8];
        __m256 high[8];
        for (int b = 0; b < 8; ++b) {
            low[b] = all_of(infinity);
            high[b] = all_of(-infinity);
            float const* at = rows.first + x + 8 * b;
            for (std::int32_t y = 0; y < rows.height; ++y, at += rows.pitch) {
                __m256 const z = _mm256_loadu_ps(at);
                low[b] = _mm256_min_ps(z, low[b]);  // The second where one is NaN.
                high[b] = _mm256_max_ps(z, high[b]);
            }
        }
        _mm256_storeu_ps(least + (x >> 3), reduced<true>(low));
        _mm256_storeu_ps(greatest + (x >> 3), reduced<false>(high));
    }
    for (; x < rows.width; x += 8)
        summarize_block(rows, x, x + 8 < rows.width ? x + 8 : rows.width, least[x >> 3], greatest[x >> 3]);
}

GNOMON_AVX2 void avx2_summarize_blocked(float const* first, float* least, float* greatest) {
    __m256 low[8];
    __m256 high[8];
    for (int b = 0; b < 8; ++b) {
        low[b] = all_of(infinity);
        high[b] = all_of(-infinity);
        for (int half = 0; half < 2; ++half) {
            float const* const at = first + 32 * b + blocked_offset(0, 4 * half);
            for (int i = 0; i < 32; i += 8) {
                __m256 const z = _mm256_loadu_ps(at + i);
                low[b] = _mm256_min_ps(z, low[b]);
                high[b] = _mm256_max_ps(z, high[b]);
            }
        }
    }
    _mm256_storeu_ps(least, reduced<true>(low));
    _mm256_storeu_ps(greatest, reduced<false>(high));
}

template <bool Least>
GNOMON_AVX2_INLINE __m256 pick(__m256 a, __m256 b) {
    return Least ? _mm256_min_ps(a, b) : _mm256_max_ps(a, b);
}

template <bool Least>
GNOMON_AVX2 void avx2_halve(float const* upper, float const* lower, std::int32_t width, float* out) {
    std::int32_t x = 0;
    for (; 2 * x + 16 <= width; x += 8) {
        __m256 const a = pick<Least>(_mm256_loadu_ps(upper + 2 * x), _mm256_loadu_ps(lower + 2 * x));
        __m256 const b = pick<Least>(_mm256_loadu_ps(upper + 2 * x + 8), _mm256_loadu_ps(lower + 2 * x + 8));
        __m256 const pairs = pick<Least>(_mm256_shuffle_ps(a, b, 0x88), _mm256_shuffle_ps(a, b, 0xDD));
        __m256d const ordered = _mm256_castsi256_pd(_mm256_permute4x64_epi64(as_int(pairs), 0xD8));
        _mm256_storeu_ps(out + x, _mm256_castpd_ps(ordered));
    }
    halve_from(x, {upper, lower, width}, out, Least ? lesser : greater);
}

}  // namespace

SummaryTable const& best_summary() noexcept {
    static constexpr SummaryTable table{&avx2_summarize, &avx2_summarize_blocked, &avx2_halve<true>,
                                        &avx2_halve<false>};
    return __builtin_cpu_supports("avx2") ? table : scalar_summary();
}

}  // namespace gnomon::raster::detail

#else

namespace gnomon::raster::detail {

SummaryTable const& best_summary() noexcept { return scalar_summary(); }

}  // namespace gnomon::raster::detail

#endif
