#pragma once
// Eight triangles at a time; the arithmetic of setup.cpp for triangles of at most 64 pixels on a side, whose products
// fit 32 bits. The others, and those that need the clipper, go through the reference, in order. Included by
// kernel_simd.cpp only.

#include "avx2_orient.hpp"

namespace gnomon::raster::detail {

namespace {

GNOMON_AVX2_INLINE __m256i load_pair(Corner const* low, Corner const* high) {
    __m256i const v = _mm256_castsi128_si256(_mm_load_si128(reinterpret_cast<__m128i const*>(low)));
    return _mm256_inserti128_si256(v, _mm_load_si128(reinterpret_cast<__m128i const*>(high)), 1);
}

GNOMON_AVX2_INLINE Corner8 load_corners(Corner const* corners, std::uint32_t const* index) {
    auto const at = [&](int i) { return corners + index[3 * i]; };
    Four const t = transposed_4x4(load_pair(at(0), at(4)), load_pair(at(1), at(5)), load_pair(at(2), at(6)),
                                  load_pair(at(3), at(7)));
    return {t.v[0], t.v[1], t.v[2], t.v[3]};
}

/// The 24 indices of eight triangles, counted from the first corner.
///
/// returns: false when one is out of range.
GNOMON_AVX2_INLINE bool load_indices(SetupJob const& job, std::size_t triangle, std::uint32_t (&index)[24]) {
    __m256i const first = all_of(static_cast<std::int32_t>(job.first_corner));
    __m256i const last = all_of(static_cast<std::int32_t>(job.corner_count - 1));
    __m256i good = all_of(-1);
    for (std::size_t k = 0; k < 3; ++k) {
        std::size_t const at = triangle * 3 + k * 8;
        __m256i v;
        if (job.index32 != nullptr)
            v = _mm256_loadu_si256(reinterpret_cast<__m256i const*>(job.index32 + at));
        else if (job.index16 != nullptr)
            v = _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<__m128i const*>(job.index16 + at)));
        else
            v = _mm256_add_epi32(iota(), all_of(static_cast<std::int32_t>(static_cast<std::uint32_t>(at))));
        v = _mm256_sub_epi32(v, first);
        good = _mm256_and_si256(good, _mm256_cmpeq_epi32(_mm256_min_epu32(v, last), v));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(index + k * 8), v);
    }
    return job.corner_count != 0 && sign_bits(good) == 0xFFU;
}

struct Bounds8 {
    __m256i min_x, min_y, max_x, max_y;
    __m256i is_small, no_sample, outside;
};

GNOMON_AVX2_INLINE __m256i least(__m256i a, __m256i b, __m256i c) {
    return _mm256_min_epi32(_mm256_min_epi32(a, b), c);
}
GNOMON_AVX2_INLINE __m256i greatest(__m256i a, __m256i b, __m256i c) {
    return _mm256_max_epi32(_mm256_max_epi32(a, b), c);
}

GNOMON_AVX2_INLINE Bounds8 bounds_of(SetupJob const& job, Corner8 const& a, Corner8 const& b, Corner8 const& c) {
    __m256i const low_x = least(a.x, b.x, c.x);
    __m256i const low_y = least(a.y, b.y, c.y);
    __m256i const high_x = greatest(a.x, b.x, c.x);
    __m256i const high_y = greatest(a.y, b.y, c.y);
    Bounds8 r;
    __m256i const extent = _mm256_max_epi32(_mm256_sub_epi32(high_x, low_x), _mm256_sub_epi32(high_y, low_y));
    r.is_small = is_less(extent, all_of(small_extent + 1));
    r.min_x = _mm256_srai_epi32(_mm256_add_epi32(low_x, all_of(127)), fraction_bits);
    r.min_y = _mm256_srai_epi32(_mm256_add_epi32(low_y, all_of(127)), fraction_bits);
    r.max_x = _mm256_srai_epi32(_mm256_sub_epi32(high_x, all_of(129)), fraction_bits);
    r.max_y = _mm256_srai_epi32(_mm256_sub_epi32(high_y, all_of(129)), fraction_bits);
    r.no_sample = _mm256_or_si256(is_less(r.max_x, r.min_x), is_less(r.max_y, r.min_y));
    r.min_x = _mm256_max_epi32(r.min_x, all_of(job.x0));
    r.min_y = _mm256_max_epi32(r.min_y, all_of(job.y0));
    r.max_x = _mm256_min_epi32(r.max_x, all_of(job.x1 - 1));
    r.max_y = _mm256_min_epi32(r.max_y, all_of(job.y1 - 1));
    r.outside = _mm256_or_si256(is_less(r.max_x, r.min_x), is_less(r.max_y, r.min_y));
    return r;
}

struct Edge8 {
    __m256i value, fraction, step_x, step_y;
};

GNOMON_AVX2_INLINE Edge8 edge_x8(Corner8 const& a, Corner8 const& b, __m256i sample_x, __m256i sample_y) {
    __m256i const dx = _mm256_sub_epi32(b.x, a.x);
    __m256i const dy = _mm256_sub_epi32(b.y, a.y);
    __m256i const zero = _mm256_setzero_si256();
    __m256i const flat_right = _mm256_and_si256(_mm256_cmpeq_epi32(dy, zero), is_less(zero, dx));
    __m256i const top_left = _mm256_or_si256(is_less(dy, zero), flat_right);
    __m256i const bias = _mm256_xor_si256(top_left, all_of(-1));
    __m256i const e = _mm256_sub_epi32(_mm256_mullo_epi32(dx, _mm256_sub_epi32(sample_y, a.y)),
                                       _mm256_mullo_epi32(dy, _mm256_sub_epi32(sample_x, a.x)));
    __m256i const biased = _mm256_add_epi32(e, bias);
    return {_mm256_srai_epi32(biased, fraction_bits), _mm256_sub_epi32(_mm256_and_si256(biased, all_of(255)), bias),
            _mm256_sub_epi32(zero, dy), dx};
}

struct Gradient4 {
    __m128 z0, g1, g2;
};

GNOMON_AVX2_INLINE Gradient4 gradient_x4(__m128i area, __m128 z0f, __m128 z1f, __m128 z2f, __m128i fraction20,
                                         __m128i fraction01) {
    __m256d const scale = _mm256_div_pd(_mm256_set1_pd(256.0), _mm256_cvtepi32_pd(area));
    __m256d const z0 = _mm256_cvtps_pd(z0f);
    __m256d const g1 = _mm256_mul_pd(_mm256_sub_pd(_mm256_cvtps_pd(z1f), z0), scale);
    __m256d const g2 = _mm256_mul_pd(_mm256_sub_pd(_mm256_cvtps_pd(z2f), z0), scale);
    __m256d const unit = _mm256_set1_pd(0.00390625);
    __m256d const f20 = _mm256_mul_pd(_mm256_cvtepi32_pd(fraction20), unit);
    __m256d const f01 = _mm256_mul_pd(_mm256_cvtepi32_pd(fraction01), unit);
    __m256d const shifted = _mm256_add_pd(_mm256_mul_pd(f20, g1), _mm256_mul_pd(f01, g2));
    return {_mm256_cvtpd_ps(_mm256_add_pd(z0, shifted)), _mm256_cvtpd_ps(g1), _mm256_cvtpd_ps(g2)};
}

/// The words of eight records, each vector one field.
GNOMON_AVX2_INLINE void set_depth(Corner8 const (&v)[3], __m256i area, Edge8 const& e01, Edge8 const& e20,
                                  __m256i (&words)[16]) {
    Gradient4 const low =
        gradient_x4(low_half(area), _mm_castsi128_ps(low_half(v[0].z)), _mm_castsi128_ps(low_half(v[1].z)),
                    _mm_castsi128_ps(low_half(v[2].z)), low_half(e20.fraction), low_half(e01.fraction));
    Gradient4 const high =
        gradient_x4(high_half(area), _mm_castsi128_ps(high_half(v[0].z)), _mm_castsi128_ps(high_half(v[1].z)),
                    _mm_castsi128_ps(high_half(v[2].z)), high_half(e20.fraction), high_half(e01.fraction));
    words[9] = joined(low.z0, high.z0);
    words[10] = joined(low.g1, high.g1);
    words[11] = joined(low.g2, high.g2);
}

/// Whether bounds of at most 2 x 2 samples hold none that is covered.
GNOMON_AVX2_INLINE __m256i covers_none(Edge8 const (&e)[3], Bounds8 const& bounds) {
    __m256i here = _mm256_setzero_si256();
    __m256i right = here;
    __m256i below = here;
    __m256i both = here;
    for (Edge8 const& edge : e) {
        __m256i const at_right = _mm256_add_epi32(edge.value, edge.step_x);
        here = _mm256_or_si256(here, edge.value);
        right = _mm256_or_si256(right, at_right);
        below = _mm256_or_si256(below, _mm256_add_epi32(edge.value, edge.step_y));
        both = _mm256_or_si256(both, _mm256_add_epi32(at_right, edge.step_y));
    }
    __m256i const columns = _mm256_sub_epi32(bounds.max_x, bounds.min_x);
    __m256i const rows = _mm256_sub_epi32(bounds.max_y, bounds.min_y);
    __m256i const one_column = _mm256_cmpeq_epi32(columns, _mm256_setzero_si256());
    __m256i const one_row = _mm256_cmpeq_epi32(rows, _mm256_setzero_si256());
    __m256i const tiny = is_less(_mm256_max_epi32(columns, rows), all_of(2));
    right = _mm256_or_si256(right, one_column);
    below = _mm256_or_si256(below, one_row);
    both = _mm256_or_si256(both, _mm256_or_si256(one_column, one_row));
    __m256i const none = _mm256_and_si256(_mm256_and_si256(here, right), _mm256_and_si256(below, both));
    return _mm256_and_si256(none, tiny);  // only the signs count
}

/// Stores the records of the lanes in `keep`, in order, through words in [field][lane].
GNOMON_AVX2_INLINE void store_records(__m256i (&words)[16], std::uint32_t keep, RecordSink& sink) {
    __m256i low[8];
    __m256i high[8];
    for (int i = 0; i < 8; ++i) {
        low[i] = words[i];
        high[i] = words[i + 8];
    }
    transpose_8x8(low);
    transpose_8x8(high);
    Record* out = sink.data + sink.size;
    for (std::uint32_t i = 0; i < 8; ++i) {
        __m256i* const to = reinterpret_cast<__m256i*>(out);
        _mm256_store_si256(to, low[i]);
        _mm256_store_si256(to + 1, high[i]);
        out += (keep >> i) & 1U;
    }
    sink.size += static_cast<std::size_t>(__builtin_popcount(keep));
}

GNOMON_AVX2_INLINE std::uint64_t take(std::uint32_t& alive, std::uint32_t mask) {
    std::uint32_t const taken = alive & mask;
    alive &= ~mask;
    return static_cast<std::uint64_t>(__builtin_popcount(taken));
}

/// Rejects and words of eight triangles; returns the lanes to keep. Lanes not in `alive` are left out.
GNOMON_AVX2_INLINE std::uint32_t make_words(SetupJob const& job, Corner8 (&v)[3], Bounds8 const& bounds,
                                            std::uint32_t alive, SetupCounts& counts, __m256i (&words)[16]) {
    __m256i const zero = _mm256_setzero_si256();
    __m256i const area =
        _mm256_sub_epi32(_mm256_mullo_epi32(_mm256_sub_epi32(v[1].x, v[0].x), _mm256_sub_epi32(v[2].y, v[0].y)),
                         _mm256_mullo_epi32(_mm256_sub_epi32(v[2].x, v[0].x), _mm256_sub_epi32(v[1].y, v[0].y)));
    counts.degenerate += take(alive, sign_bits(_mm256_cmpeq_epi32(area, zero)));
    if (job.facing != Facing::any)
        counts.culled += take(alive, job.facing == Facing::positive_only ? sign_bits(area) : ~sign_bits(area));
    counts.no_sample += take(alive, sign_bits(bounds.no_sample));
    counts.outside += take(alive, sign_bits(bounds.outside));
    if (alive == 0) return 0;
    orient_x8(v, _mm256_abs_epi32(area), area);
    __m256i const sample_x = _mm256_add_epi32(_mm256_slli_epi32(bounds.min_x, fraction_bits), all_of(half_pixel));
    __m256i const sample_y = _mm256_add_epi32(_mm256_slli_epi32(bounds.min_y, fraction_bits), all_of(half_pixel));
    Edge8 const e[3] = {edge_x8(v[0], v[1], sample_x, sample_y), edge_x8(v[1], v[2], sample_x, sample_y),
                        edge_x8(v[2], v[0], sample_x, sample_y)};
    counts.no_sample += take(alive, sign_bits(covers_none(e, bounds)));
    if (alive == 0) return 0;
    for (int i = 0; i < 3; ++i) {
        words[i] = e[i].value;
        words[3 + i] = e[i].step_x;
        words[6 + i] = e[i].step_y;
    }
    set_depth(v, _mm256_abs_epi32(area), e[0], e[2], words);
    words[13] = _mm256_or_si256(bounds.min_x, _mm256_slli_epi32(bounds.min_y, 16));
    words[14] = _mm256_or_si256(bounds.max_x, _mm256_slli_epi32(bounds.max_y, 16));
    words[15] = all_of(static_cast<std::int32_t>(job.tag));
    counts.drawn += static_cast<std::uint64_t>(__builtin_popcount(alive));
    return alive;
}

/// Some of eight triangles need the reference path: keeps the order.
GNOMON_AVX2 void store_mixed(SetupJob const& job, std::size_t triangle, __m256i (&words)[16], std::uint32_t keep,
                             std::uint32_t slow, RecordSink& sink, SetupCounts& counts) {
    alignas(64) std::uint32_t word[16][8];
    for (int i = 0; i < 16; ++i) _mm256_store_si256(reinterpret_cast<__m256i*>(word[i]), words[i]);
    for (std::uint32_t lane = 0; lane < 8; ++lane) {
        if (((slow >> lane) & 1U) != 0) {
            setup_one(job, triangle + lane, sink, counts);
        } else if (((keep >> lane) & 1U) != 0) {
            std::uint32_t row[16];
            for (int i = 0; i < 16; ++i) row[i] = word[i][lane];
            __builtin_memcpy(static_cast<void*>(sink.room(1)), row, sizeof(Record));
            ++sink.size;
        }
    }
}

GNOMON_AVX2 void avx2_setup(SetupJob const& job, std::size_t begin, std::size_t end, RecordSink& sink,
                            SetupCounts& counts) {
    std::uint32_t index[24];
    for (; begin + 8 <= end; begin += 8) {
        sink.room(8);
        if (!load_indices(job, begin, index)) {
            for (std::size_t i = begin; i < begin + 8; ++i) setup_one(job, i, sink, counts);
            continue;
        }
        Corner8 v[3] = {load_corners(job.corners, index), load_corners(job.corners, index + 1),
                        load_corners(job.corners, index + 2)};
        __m256i const any = _mm256_and_si256(_mm256_or_si256(_mm256_or_si256(v[0].code, v[1].code), v[2].code),
                                             all_of(static_cast<std::int32_t>(outcode_bits)));
        Bounds8 const bounds = bounds_of(job, v[0], v[1], v[2]);
        std::uint32_t alive = 0xFFU;
        std::uint32_t slow = ~sign_bits(bounds.is_small) & 0xFFU;
        if (!_mm256_testz_si256(any, any)) {
            __m256i const zero = _mm256_setzero_si256();
            __m256i const common =
                _mm256_and_si256(_mm256_and_si256(v[0].code, v[1].code), _mm256_and_si256(v[2].code, any));
            __m256i const finite =
                _mm256_cmpeq_epi32(_mm256_and_si256(any, all_of(static_cast<std::int32_t>(code_not_finite))), zero);
            std::uint32_t const out = sign_bits(_mm256_andnot_si256(_mm256_cmpeq_epi32(common, zero), finite));
            counts.outside += take(alive, out);
            slow = (slow | ~sign_bits(_mm256_cmpeq_epi32(any, zero))) & alive;
        }
        alive &= ~slow;
        __m256i words[16] = {};  // store_mixed copies all of it, also where no lane is alive
        std::uint32_t const keep = alive != 0 ? make_words(job, v, bounds, alive, counts, words) : 0;
        if ((keep | slow) == 0) continue;
        words[12] = _mm256_add_epi32(
            iota(), all_of(static_cast<std::int32_t>(job.id_base + static_cast<std::uint32_t>(begin))));
        if (slow == 0)
            store_records(words, keep, sink);
        else
            store_mixed(job, begin, words, keep, slow, sink, counts);
    }
    scalar_kernel().setup(job, begin, end, sink, counts);
}

}  // namespace

}  // namespace gnomon::raster::detail
