#pragma once
// The frame of the passes with a record of their own: chunks of triangles in parallel, bins, tiles in parallel, batch
// by batch. The order within a tile is the draw order, so the image does not depend on the executor.

#include <gnomon/core/executor.hpp>
#include <gnomon/raster/target.hpp>

#include "bins.hpp"
#include "buffer.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::raster::detail {

/// A run of triangles, set up by one thread. A record has its bounds in pixels: min_x, min_y, max_x, max_y, within the
/// drawn rectangle.
template <class Rules>
struct TiledChunk {
    Buffer<typename Rules::Record> records;
    Buffer<typename Rules::Extra> extras;  // What few records need beside themselves.
    Buffer<std::uint32_t> entries;
    std::size_t size = 0, extra_size = 0;
    typename Rules::Counts counts{};

    typename Rules::Record& add_record() {
        records.fit(size + 1, size);
        return records.data()[size++];
    }
    typename Rules::Extra& add_extra() {
        extras.fit(extra_size + 1, extra_size);
        return extras.data()[extra_size++];
    }
};

template <class Rules>
struct TiledState {
    std::vector<TiledChunk<Rules>> chunks;
    Buffer<std::uint32_t> bins;     // One array of bin starts per chunk.
    Buffer<std::uint64_t> written;  // Pixels per tile.

    [[nodiscard]] std::size_t size_bytes() const noexcept {
        std::size_t bytes = bins.size_bytes() + written.size_bytes();
        for (TiledChunk<Rules> const& c : chunks)
            bytes += sizeof c + c.records.size_bytes() + c.extras.size_bytes() + c.entries.size_bytes();
        return bytes;
    }
};

/// A tile's pixels, end exclusive.
struct TileRect {
    std::int32_t x0, y0, x1, y1;
};

/// What is drawn, and how it is cut into tiles.
struct TiledArea {
    std::int32_t x0, y0, x1, y1;
    BinGrid grid;
};

/// Draws triangles [0, total) by
///
///     rules.set_up(begin, end, chunk)               in parallel; adds records and counts
///     rules.draw(tile, first, for_each) -> written  in parallel; for_each(f) calls f(record, chunk) in draw order
///     rules.add(counts)                             one by one
///
/// returns: the sum of what the tiles have written.
template <class Rules>
class TiledPass {
  public:
    TiledPass(Rules& rules, TiledState<Rules>& state, TiledArea const& area, core::ExecutorRef executor)
        : rules_(rules), state_(state), area_(area), executor_(executor) {}

    std::uint64_t run(std::size_t total) {
        std::uint64_t written = 0;
        std::size_t begin = 0;
        do {  // Once at least: an empty pass still clears.
            std::size_t const end = std::min(total, begin + max_batch);
            set_up(begin, end);
            written += draw(begin == 0);
            begin = end;
        } while (begin < total);
        return written;
    }

  private:
    static constexpr std::size_t max_batch = std::size_t{1} << 18U;
    static constexpr std::size_t max_chunks = 64;
    static constexpr std::size_t min_chunk_triangles = 1024;

    [[nodiscard]] std::uint32_t* bin_begin(std::size_t chunk) const {
        return state_.bins.data() + chunk * (area_.grid.total + 2);
    }

    void set_up(std::size_t begin, std::size_t end) {
        std::size_t const size = std::max(min_chunk_triangles, (end - begin + max_chunks - 1) / max_chunks);
        chunk_count_ = (end - begin + size - 1) / size;
        if (state_.chunks.size() < chunk_count_) state_.chunks.resize(chunk_count_);
        state_.bins.fit(chunk_count_ * (area_.grid.total + 2));
        executor_.parallel_for(chunk_count_, 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t c = first; c < last; ++c) {
                TiledChunk<Rules>& chunk = state_.chunks[c];
                chunk.size = chunk.extra_size = 0;
                chunk.counts = {};
                rules_.set_up(begin + c * size, std::min(end, begin + (c + 1) * size), chunk);
                sort_into_bins(area_.grid, chunk.records.data(), chunk.size, bin_begin(c),
                               [&](std::size_t n) { return chunk.entries.fit(n); });
            }
        });
        for (std::size_t c = 0; c < chunk_count_; ++c) rules_.add(state_.chunks[c].counts);
    }

    [[nodiscard]] std::uint64_t draw(bool first_batch) {
        std::int32_t const first_x = (area_.x0 + area_.grid.shift_x) >> tile_shift;
        std::int32_t const first_y = area_.y0 >> tile_shift;
        auto const across = static_cast<std::size_t>(((area_.x1 - 1 + area_.grid.shift_x) >> tile_shift) - first_x + 1);
        auto const down = static_cast<std::size_t>(((area_.y1 - 1) >> tile_shift) - first_y + 1);
        std::uint64_t* const written = state_.written.fit(across * down);
        executor_.parallel_for(across * down, 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t t = begin; t < end; ++t)
                written[t] = draw_tile(first_x + static_cast<std::int32_t>(t % across),
                                       first_y + static_cast<std::int32_t>(t / across), first_batch);
        });
        std::uint64_t sum = 0;
        for (std::size_t t = 0; t < across * down; ++t) sum += written[t];
        return sum;
    }

    [[nodiscard]] std::uint64_t draw_tile(std::int32_t tile_x, std::int32_t tile_y, bool first_batch) const {
        TileRect const tile{std::max(area_.x0, (tile_x << tile_shift) - area_.grid.shift_x),
                            std::max(area_.y0, tile_y << tile_shift),
                            std::min(area_.x1, ((tile_x + 1) << tile_shift) - area_.grid.shift_x),
                            std::min(area_.y1, (tile_y + 1) << tile_shift)};
        return rules_.draw(tile, first_batch, [&](auto&& draw_record) {
            for (std::size_t c = 0; c < chunk_count_; ++c) {
                TiledChunk<Rules> const& chunk = state_.chunks[c];
                for_each_run(area_.grid, bin_begin(c), chunk.entries.data(), tile_x, tile_y,
                             [&](std::uint32_t const* entries, std::size_t count) {
                                 for (std::size_t i = 0; i < count; ++i)
                                     draw_record(chunk.records.data()[entries[i]], chunk);
                             });
            }
        });
    }

    Rules& rules_;
    TiledState<Rules>& state_;
    TiledArea const& area_;
    core::ExecutorRef executor_;
    std::size_t chunk_count_ = 0;
};

}  // namespace gnomon::raster::detail
