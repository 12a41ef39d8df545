#pragma once
// What the stages hand to each other, and the functions that a kernel supplies. Plain data only: this is shared by
// units that are compiled for different instruction sets.

#include <cstddef>
#include <cstdint>

namespace gnomon::raster::detail {

inline constexpr std::int32_t tile_shift = 6;
inline constexpr std::int32_t tile_size = 1 << tile_shift;
inline constexpr std::int32_t blocks_per_tile = (tile_size / 4) * (tile_size / 4);  // Of the smallest blocks.
inline constexpr std::int32_t farthest_size = blocks_per_tile + tile_size;          // A window may reach below.
inline constexpr std::int32_t tile_pitch = tile_size + 8;  // A vector may start at the tile's last column.

inline constexpr std::int32_t fraction_bits = 8;
inline constexpr std::int32_t half_pixel = 128;
inline constexpr std::int32_t small_extent = 64 * 256;      // Products of two differences fit 32 bits.
inline constexpr std::int32_t regular_extent = 1024 * 256;  // Shifted edge functions fit 32 bits inside the bounds.

/// A transformed corner: 16 bytes, so that a triangle is three loads.
struct Corner {
    std::int32_t x;
    std::int32_t y;
    float z;
    std::uint32_t code;  // Bits 0-7: see `outcode`; 0 where the rest is valid. Above: 12 bits of residue each, x and y.
};
inline constexpr std::uint32_t outcode_bits = 0xFFU;
inline constexpr int residue_scale = 4096;  // Residues count in 1/4096 of a fixed-point unit.

/// A triangle on its way to the tiles, in one cache line.
///
/// Corners are turned so that the area is positive and corner 0 has the least depth. An edge function is kept shifted:
/// E' = floor((E + bias) / 256), bias 0 on top-left edges, else -1. Its steps are whole multiples of 256, so
/// E + bias >= 0 exactly when E' >= 0, and E' moves by `step_x`, `step_y` per pixel.
struct alignas(64) Record {
    std::int32_t edge[3];    // E' of edges 01, 12, 20 at the first pixel of the bounds. Large: the corners' x.
    std::int32_t step_x[3];  // Large: the corners' y.
    std::int32_t step_y[3];
    float z0;  // With the fractions that the shift took from E.
    float g1;  // Depth per E'20. Large: the depth of corner 1.
    float g2;  // Depth per E'01. Large: the depth of corner 2.
    std::uint32_t id;
    std::uint16_t min_x, min_y, max_x, max_y;  // Pixels, inclusive, within the scissor rectangle.
    std::uint32_t tag;                         // Bit 0: large. The rest: 1 + index of the masked draw, or 0.
};
static_assert(sizeof(Record) == 64);

struct TileJob;
using MaskedFn = std::uint64_t (*)(TileJob const&, Record const&);

/// Where a kernel with `to_rows` keeps sample (x, y) of a tile: in blocks of 4 x 4, row by row, as are the samples of a
/// block.
[[nodiscard]] constexpr std::ptrdiff_t blocked_offset(std::int32_t x, std::int32_t y) noexcept {
    return std::ptrdiff_t{(y >> 2) * (tile_size / 4) + (x >> 2)} * 16 + (y & 3) * 4 + (x & 3);
}

/// One tile's local image and its limits; rows are `tile_pitch` apart.
struct TileJob {
    std::int32_t x0, y0, x1, y1;  // Pixels of the target, end exclusive.
    float* depth;                 // Depths, or codes as floats for a 16-bit target.
    std::uint32_t* id;            // Null in a depth pass.
    float* farthest;              // Per block of the kernel's: no sample of the block is farther.
    bool blocked;                 // `depth` and `id` are in the order of `blocked_offset`, not in rows.
    bool reversed;
    bool quantize;
    bool clamp;  // Depths may leave [0, 1].
    void const* masked_context;
    MaskedFn masked;  // Draws one record of an alpha-tested draw, its range within the tile not empty.
};

/// What vertex work needs of a draw and the viewport.
struct VertexJob {
    unsigned char const* positions;
    std::size_t stride;
    float origin[3];
    float row[4][4];  // row[r][c]: clip component r from position component c.
    float half_width, half_height;
    std::int32_t offset_x, offset_y;
    float guard_x, guard_y;
    bool clip_depth;
};

enum class Facing : std::uint8_t { any, positive_only, negative_only };

/// Triangles of one draw that become records.
struct SetupJob {
    Corner const* corners;
    std::uint32_t const* index32;
    std::uint16_t const* index16;  // Neither: corners in threes.
    std::uint32_t first_corner;    // Index of corners[0].
    std::uint32_t corner_count;
    std::uint32_t id_base;
    std::uint32_t tag;
    Facing facing;
    std::int32_t x0, y0, x1, y1;  // Scissor rectangle, end exclusive.
    VertexJob const* vertex;      // For the clipper, which starts again from the positions.
};

struct SetupCounts {
    std::uint64_t bad_index = 0, not_finite = 0, outside = 0, degenerate = 0, culled = 0, no_sample = 0, drawn = 0,
                  clipped = 0;
};

/// Records in draw order. `grow` gives room for at least `more` beyond `size`.
struct RecordSink {
    Record* data;
    std::size_t size;
    std::size_t capacity;
    void* owner;
    void (*grow)(RecordSink&, std::size_t more);

    Record* room(std::size_t more) {
        if (capacity - size < more) grow(*this, more);
        return data + size;
    }
};

/// Where a tile's rows of `tile_size` elements go.
struct TileRows {
    void* first;  // On 64 bytes, as are all rows.
    std::ptrdiff_t stride_bytes;
    std::int32_t count;
};

struct KernelTable {
    void (*transform)(VertexJob const&, std::size_t begin, std::size_t end, Corner* out);
    void (*setup)(SetupJob const&, std::size_t begin, std::size_t end, RecordSink&, SetupCounts&);
    /// Draws `count` records, `entries[i]` into `records`, in order; returns the samples written.
    std::uint64_t (*tile)(TileJob const&, Record const* records, std::uint32_t const* entries, std::size_t count);
    /// Fills the tile's images, margins included.
    void (*clear)(TileJob const&, float farthest, std::uint32_t no_id);
    /// Copies a whole tile of 32-bit elements out past the caches; null where there is no such store.
    void (*stream)(TileRows const& to, void const* from);
    MaskedFn masked;  // For `TileJob::masked`.
    /// Between a tile's blocks and rows `tile_pitch` apart; null where the kernel itself works in rows.
    void (*to_rows)(std::uint32_t const* blocks, std::uint32_t* rows);
    void (*from_rows)(std::uint32_t const* rows, std::uint32_t* blocks);
};

/// Sets up triangle `triangle` of the job through the reference path, clipping it where needed.
void setup_one(SetupJob const&, std::size_t triangle, RecordSink&, SetupCounts&);

[[nodiscard]] KernelTable const& scalar_kernel() noexcept;
/// Null where the machine or the build has none.
[[nodiscard]] KernelTable const* avx2_kernel() noexcept;
[[nodiscard]] KernelTable const* avx512_kernel() noexcept;
/// The widest of them.
[[nodiscard]] inline KernelTable const* simd_kernel() noexcept {
    KernelTable const* const wide = avx512_kernel();
    return wide != nullptr ? wide : avx2_kernel();
}

}  // namespace gnomon::raster::detail
