#pragma once
// Alpha-tested triangles: the samples that are covered and nearer are collected first, whatever the triangle's shape,
// and their texels are asked for in full vectors. Included by kernel_simd.cpp only.

#include "avx2_texture.hpp"
#include "avx2_tile.hpp"

#include <array>

namespace gnomon::raster::detail {

namespace {

/// For each mask of eight: the places of its bits, lowest first, a byte each.
constexpr std::array<std::uint64_t, 256> make_bit_places() {
    std::array<std::uint64_t, 256> table{};
    for (std::uint32_t mask = 0; mask < 256; ++mask) {
        std::uint32_t n = 0;
        for (std::uint64_t bit = 0; bit < 8; ++bit)
            if (((mask >> bit) & 1U) != 0) table[mask] |= bit << (8 * n++);
    }
    return table;
}
constexpr std::array<std::uint64_t, 256> bit_places = make_bit_places();

/// Takes the place of a `Writer`: keeps a record's samples that would be written, until their texels are known. No
/// sample comes twice, so it does not matter when they are written.
template <class M>
class Collector {
  public:
    GNOMON_AVX2_INLINE Collector(TileJob const& job, Record const& record) : job_(job), record_(record) {}

    GNOMON_AVX2_INLINE void to_row(TileJob const&, std::ptrdiff_t at) {
        if (count_ > capacity - most_per_block) flush();
        depth_ = job_.depth + at;
        auto const place = static_cast<std::int32_t>(at);
        place_ = _mm256_add_epi32(all_of((place / tile_pitch) << row_shift | place % tile_pitch), iota());
    }
    GNOMON_AVX2_INLINE void next_row() {
        depth_ += tile_pitch;
        place_ = _mm256_add_epi32(place_, all_of(1 << row_shift));
    }

    /// As `Writer::write`, but nothing is written yet.
    GNOMON_AVX2_INLINE __m256 write(__m256 z, __m256i outside, __m256i counted) {
        z = stored_depth<M>(z);
        __m256 const held = _mm256_loadu_ps(depth_);
        __m256 const nearer = _mm256_andnot_ps(as_float(outside), is_nearer<M>(z, held));
        auto const mask = static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_and_ps(nearer, as_float(counted))));
        if (mask == 0) return held;
        __m256i const order = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(bit_places[mask])));
        _mm256_storeu_ps(z_ + count_, _mm256_permutevar8x32_ps(z, order));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(at_ + count_), _mm256_permutevar8x32_epi32(place_, order));
        count_ += static_cast<std::size_t>(__builtin_popcount(mask));
        return held;
    }

    /// Writes the samples that the texture lets stand.
    GNOMON_AVX2 void flush() {
        if (count_ == 0) return;
        if (!planned_) {
            MaskedDraw const& draw = masked_draw(job_, record_);
            texture_.set(draw, record_.id - draw.id_base);
            planned_ = true;
        }
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(at_ + count_), _mm256_setzero_si256());
        __m128i const x0 = all_of_4(job_.x0);
        __m128i const y0 = all_of_4(job_.y0);
        for (std::size_t i = 0; i < count_; i += 4) {
            __m128i const at = _mm_loadu_si128(reinterpret_cast<__m128i const*>(at_ + i));
            __m128i const px = _mm_add_epi32(x0, _mm_and_si128(at, all_of_4((1 << row_shift) - 1)));
            __m128i const py = _mm_add_epi32(y0, _mm_srli_epi32(at, row_shift));
            std::size_t const left = count_ - i;
            std::uint32_t const wanted = left >= 4 ? 0xFU : (1U << left) - 1U;
            put(i, texture_.accepts(px, py, wanted) & wanted);
        }
        count_ = 0;
    }

    [[nodiscard]] std::uint64_t written() const { return written_; }

  private:
    static constexpr int row_shift = 8;
    static constexpr std::size_t most_per_block = 8 * tile_size;  // A narrow triangle's, in all its rows.
    static constexpr std::size_t capacity = 2 * most_per_block;

    GNOMON_AVX2_INLINE void put(std::size_t first, std::uint32_t accepted) {
        written_ += static_cast<std::uint64_t>(__builtin_popcount(accepted));
        for (; accepted != 0; accepted &= accepted - 1) {
            std::size_t const i = first + static_cast<std::size_t>(__builtin_ctz(accepted));
            std::size_t const at = (at_[i] >> row_shift) * tile_pitch + (at_[i] & ((1U << row_shift) - 1U));
            job_.depth[at] = z_[i];
            if (job_.id != nullptr) job_.id[at] = record_.id;
        }
    }

    TileJob const& job_;
    Record const& record_;
    float const* depth_ = nullptr;
    __m256i place_;  // Of eight samples: row and column in the tile.
    std::size_t count_ = 0;
    std::uint64_t written_ = 0;
    bool planned_ = false;
    Texture4 texture_;
    float z_[capacity + 8];
    std::uint32_t at_[capacity + 8];
};

template <class M>
GNOMON_AVX2 std::uint64_t draw_masked_x8(TileJob const& job, Record const& r) {
    PixelRange const range = range_in_tile(job, r);
    Collector<M> samples(job, r);
    if ((r.tag & 1U) != 0)
        draw_large_x8<M>(job, r, range, samples);
    else if (range.x1 - range.x0 <= 8)
        draw_narrow<M>(job, r, range, samples);
    else
        draw_wide<M>(job, r, range, samples);
    samples.flush();
    return samples.written();
}

template <bool Quantize, bool Clamp>
GNOMON_AVX2_INLINE std::uint64_t draw_masked_either_way(TileJob const& job, Record const& r) {
    return job.reversed ? draw_masked_x8<Mode<true, Quantize, false, Clamp>>(job, r)
                        : draw_masked_x8<Mode<false, Quantize, false, Clamp>>(job, r);
}

/// `draw_masked`, bit for bit.
GNOMON_AVX2 std::uint64_t avx2_masked(TileJob const& job, Record const& r) {
    if (!fits_gather(masked_draw(job, r).test->texture)) return draw_masked(job, r);
    if (job.quantize)
        return job.clamp ? draw_masked_either_way<true, true>(job, r) : draw_masked_either_way<true, false>(job, r);
    return job.clamp ? draw_masked_either_way<false, true>(job, r) : draw_masked_either_way<false, false>(job, r);
}

}  // namespace

}  // namespace gnomon::raster::detail
