#pragma once
// Samples of one tile, eight at a time: narrow triangles row by row, wide ones by blocks. Included by kernel_simd.cpp
// only.

#include "avx2_blocks.hpp"

namespace gnomon::raster::detail {

namespace {

template <class M, class W>
GNOMON_AVX2_INLINE void draw_narrow(TileJob const& job, Record const& r, PixelRange const& range, W& writer) {
    std::int32_t const dx = range.x0 - r.min_x;
    std::int32_t const dy = range.y0 - r.min_y;
    __m256i e[3];
    __m256i step[3];
    for (int i = 0; i < 3; ++i) {
        e[i] = _mm256_add_epi32(all_of(r.edge[i] + r.step_x[i] * dx + r.step_y[i] * dy),
                                _mm256_mullo_epi32(iota(), all_of(r.step_x[i])));
        step[i] = all_of(r.step_y[i]);
    }
    RegularDepth const plane{all_of(r.z0), all_of(r.g1), all_of(r.g2)};
    __m256i const counted = first_columns(range.x1 - range.x0);
    writer.to_row(job, std::ptrdiff_t{range.y0 - job.y0} * tile_pitch + (range.x0 - job.x0));
    for (std::int32_t y = range.y0; y < range.y1; ++y, writer.next_row()) {
        writer.write(plane.at(e[2], e[0]), _mm256_or_si256(_mm256_or_si256(e[0], e[1]), e[2]), counted);
        for (int i = 0; i < 3; ++i) e[i] = _mm256_add_epi32(e[i], step[i]);
    }
}

GNOMON_AVX2_INLINE PixelRange from_tile(TileJob const& job, PixelRange const& range) {
    return {range.x0 - job.x0, range.y0 - job.y0, range.x1 - job.x0, range.y1 - job.y0};
}

template <class M, class W>
GNOMON_AVX2 void draw_wide(TileJob const& job, Record const& r, PixelRange const& range, W& writer) {
    TileEdge edge[3];
    for (int i = 0; i < 3; ++i)
        edge[i] = {r.edge[i] + r.step_x[i] * (job.x0 - r.min_x) + r.step_y[i] * (job.y0 - r.min_y), r.step_x[i],
                   r.step_y[i]};
    RegularBlocks const depth{{all_of(r.z0), all_of(r.g1), all_of(r.g2)}};
    draw_blocks<M>(job, edge, from_tile(job, range), depth, writer);
}

/// The edge over the tile in 32 bits. Where it does not change sign within the tile, only the sign is kept; where it
/// does, all its values are within 63 (|step_x| + |step_y|) < 2^31.
///
/// returns: false when the whole tile is outside.
GNOMON_AVX2_INLINE bool narrow_edge(ShiftedEdge const& e, TileEdge& out) {
    std::int64_t const x = std::int64_t{e.step_x} * (tile_size - 1);
    std::int64_t const y = std::int64_t{e.step_y} * (tile_size - 1);
    std::int64_t const highest = e.value + (x > 0 ? x : 0) + (y > 0 ? y : 0);
    std::int64_t const lowest = e.value + (x < 0 ? x : 0) + (y < 0 ? y : 0);
    if (highest < 0) return false;
    out = lowest >= 0 ? TileEdge{0, 0, 0} : TileEdge{static_cast<std::int32_t>(e.value), e.step_x, e.step_y};
    return true;
}

template <class M, class W>
GNOMON_AVX2 void draw_large_x8(TileJob const& job, Record const& r, PixelRange const& range, W& writer) {
    Oriented const t = oriented_of_large(r);
    ShiftedEdge e[3];
    TileEdge edge[3];
    for (int i = 0; i < 3; ++i) {
        e[i] = shifted_edge(t, i, job.x0, job.y0);
        if (!narrow_edge(e[i], edge[i])) return;
    }
    LargeBlocks const depth{depth_gradient(t, e[2].fraction, e[0].fraction),
                            static_cast<double>(e[2].value),
                            static_cast<double>(e[0].value),
                            static_cast<double>(e[2].step_x),
                            static_cast<double>(e[0].step_x),
                            static_cast<double>(e[2].step_y),
                            static_cast<double>(e[0].step_y)};
    draw_blocks<M>(job, edge, from_tile(job, range), depth, writer);
}

template <class M>
GNOMON_AVX2 std::uint64_t draw_tile_x8(TileJob const& job, Record const* records, std::uint32_t const* entries,
                                       std::size_t count) {
    std::uint64_t masked = 0;
    Writer<M> writer{job.depth, job.id, _mm256_setzero_si256(), _mm256_setzero_si256()};
    for (std::size_t i = 0; i < count; ++i) {
        // The records of a tile lie scattered over the chunk's.
        if (i + 4 < count) __builtin_prefetch(records + entries[i + 4]);
        Record const& r = records[entries[i]];
        PixelRange const range = range_in_tile(job, r);
        if (range.x1 <= range.x0 || range.y1 <= range.y0) continue;
        writer.record_id = all_of(static_cast<std::int32_t>(r.id));
        if (r.tag == 0 && range.x1 - range.x0 <= 8)
            draw_narrow<M>(job, r, range, writer);
        else if (r.tag == 0)
            draw_wide<M>(job, r, range, writer);
        else if (r.tag == 1)
            draw_large_x8<M>(job, r, range, writer);
        else
            masked += job.masked(job, r);
    }
    alignas(32) std::uint32_t written[8];
    _mm256_store_si256(reinterpret_cast<__m256i*>(written), writer.written);
    for (std::uint32_t n : written) masked += n;
    return masked;
}

template <bool Ids, bool Quantize, bool Clamp>
GNOMON_AVX2_INLINE std::uint64_t draw_either_way(TileJob const& job, Record const* records,
                                                 std::uint32_t const* entries, std::size_t count) {
    return job.reversed ? draw_tile_x8<Mode<true, Quantize, Ids, Clamp>>(job, records, entries, count)
                        : draw_tile_x8<Mode<false, Quantize, Ids, Clamp>>(job, records, entries, count);
}

GNOMON_AVX2 std::uint64_t avx2_tile(TileJob const& job, Record const* records, std::uint32_t const* entries,
                                    std::size_t count) {
    if (job.id != nullptr)
        return job.clamp ? draw_either_way<true, false, true>(job, records, entries, count)
                         : draw_either_way<true, false, false>(job, records, entries, count);
    if (job.quantize)
        return job.clamp ? draw_either_way<false, true, true>(job, records, entries, count)
                         : draw_either_way<false, true, false>(job, records, entries, count);
    return job.clamp ? draw_either_way<false, false, true>(job, records, entries, count)
                     : draw_either_way<false, false, false>(job, records, entries, count);
}

/// Fills the tile's images with the farthest depth and no triangle.
GNOMON_AVX2 void avx2_clear(TileJob const& job, float farthest, std::uint32_t no_id) {
    __m256 const z = all_of(farthest);
    __m256i const none = all_of(static_cast<std::int32_t>(no_id));
    std::ptrdiff_t const end = std::ptrdiff_t{job.y1 - job.y0} * tile_pitch;
    for (std::ptrdiff_t i = 0; i < end; i += 8) _mm256_store_ps(job.depth + i, z);
    for (int i = 0; i < blocks_per_tile; i += 8) _mm256_store_ps(job.farthest + i, z);
    if (job.id == nullptr) return;
    for (std::ptrdiff_t i = 0; i < end; i += 8) _mm256_store_si256(reinterpret_cast<__m256i*>(job.id + i), none);
}

/// Copies the rows of a whole tile past the caches. The image's rows begin on cache lines.
GNOMON_AVX2 void avx2_stream(TileRows const& to, void const* from) {
    char const* source = static_cast<char const*>(from);
    char* row = static_cast<char*>(to.first);
    for (std::int32_t y = 0; y < to.count; ++y, row += to.stride_bytes, source += tile_pitch * 4)
        for (std::ptrdiff_t i = 0; i < tile_size * 4; i += 32)
            _mm256_stream_si256(reinterpret_cast<__m256i*>(row + i),
                                _mm256_load_si256(reinterpret_cast<__m256i const*>(source + i)));
    _mm_sfence();  // Ordered before whatever tells another thread that the tile is done.
}

}  // namespace

}  // namespace gnomon::raster::detail
