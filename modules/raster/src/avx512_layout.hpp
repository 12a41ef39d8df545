#pragma once
// The local image of a tile in blocks of 4 x 4 samples, a cache line each: cleared, filled, copied out. See
// `blocked_offset`. Included by kernel_avx512.cpp only.

#include "avx512.hpp"

namespace gnomon::raster::detail {

namespace {

GNOMON_AVX512 void avx512_clear(TileJob const& job, float farthest, std::uint32_t no_id) {
    __m512 const z = all16(farthest);
    for (std::ptrdiff_t i = 0; i < tile_size * tile_size; i += 16) _mm512_store_ps(job.depth + i, z);
    for (int i = 0; i < farthest_size; i += 16) _mm512_store_ps(job.farthest + i, z);
    if (job.id == nullptr) return;
    __m512i const none = all16(static_cast<std::int32_t>(no_id));
    for (std::ptrdiff_t i = 0; i < tile_size * tile_size; i += 16) _mm512_store_si512(job.id + i, none);
}

/// Four rows of sixteen samples from four blocks side by side.
GNOMON_AVX512_INLINE Four16 four_rows(std::uint32_t const* blocks) {
    __m512i const* const from = reinterpret_cast<__m512i const*>(blocks);
    return transposed_quarters(_mm512_load_si512(from), _mm512_load_si512(from + 1), _mm512_load_si512(from + 2),
                               _mm512_load_si512(from + 3));
}

GNOMON_AVX512 void avx512_to_rows(std::uint32_t const* blocks, std::uint32_t* rows) {
    for (std::ptrdiff_t by = 0; by < tile_size / 4; ++by, rows += 4 * tile_pitch)
        for (std::ptrdiff_t x = 0; x < tile_size; x += 16, blocks += 64) {
            Four16 const four = four_rows(blocks);
            for (std::ptrdiff_t y = 0; y < 4; ++y) _mm512_storeu_si512(rows + y * tile_pitch + x, four.v[y]);
        }
}

GNOMON_AVX512 void avx512_from_rows(std::uint32_t const* rows, std::uint32_t* blocks) {
    for (std::ptrdiff_t by = 0; by < tile_size / 4; ++by, rows += 4 * tile_pitch)
        for (std::ptrdiff_t x = 0; x < tile_size; x += 16, blocks += 64) {
            std::uint32_t const* const from = rows + x;
            Four16 const four = transposed_quarters(_mm512_loadu_si512(from), _mm512_loadu_si512(from + tile_pitch),
                                                    _mm512_loadu_si512(from + 2 * tile_pitch),
                                                    _mm512_loadu_si512(from + 3 * tile_pitch));
            for (std::ptrdiff_t b = 0; b < 4; ++b) _mm512_store_si512(blocks + b * 16, four.v[b]);
        }
}

/// Copies the rows of a whole tile past the caches. The image's rows begin on cache lines.
GNOMON_AVX512 void avx512_stream(TileRows const& to, void const* from) {
    auto const* blocks = static_cast<std::uint32_t const*>(from);
    char* row = static_cast<char*>(to.first);
    for (std::int32_t y = 0; y < to.count; y += 4, row += 4 * to.stride_bytes) {
        std::int32_t const rows = to.count - y < 4 ? to.count - y : 4;
        for (std::ptrdiff_t x = 0; x < 4; ++x, blocks += 64) {
            Four16 const four = four_rows(blocks);
            for (std::ptrdiff_t i = 0; i < rows; ++i)
                _mm512_stream_si512(reinterpret_cast<__m512i*>(row + i * to.stride_bytes + x * 64), four.v[i]);
        }
    }
    _mm_sfence();  // Ordered before whatever tells another thread that the tile is done.
}

}  // namespace

}  // namespace gnomon::raster::detail
