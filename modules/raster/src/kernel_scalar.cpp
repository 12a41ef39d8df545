// The reference kernel: one vertex, one triangle, one sample at a time.

#include "masked.hpp"
#include "pieces.hpp"
#include "sample_loop.hpp"

namespace gnomon::raster::detail {

namespace {

void transform(VertexJob const& job, std::size_t begin, std::size_t end, Corner* out) {
    for (std::size_t i = begin; i < end; ++i) {
        float position[3];
        __builtin_memcpy(position, job.positions + i * job.stride, sizeof position);
        Clip4 const c = to_clip(job, position);
        std::uint32_t const code = outcode_of(c, job.guard_x, job.guard_y, job.clip_depth);
        *out++ = code != 0 ? Corner{0, 0, 0.0F, code} : snap_of(c, job, job.half_width, job.half_height);
    }
}

void setup(SetupJob const& job, std::size_t begin, std::size_t end, RecordSink& sink, SetupCounts& counts) {
    for (std::size_t i = begin; i < end; ++i) setup_one(job, i, sink, counts);
}

std::uint64_t tile(TileJob const& job, Record const* records, std::uint32_t const* entries, std::size_t count) {
    std::uint64_t written = 0;
    for (std::size_t i = 0; i < count; ++i) {
        Record const& record = records[entries[i]];
        written += (record.tag >> 1U) != 0 ? job.masked(job, record)
                                           : draw_samples(job, record, [](std::int32_t, std::int32_t) { return true; });
    }
    return written;
}

void clear(TileJob const& job, float farthest, std::uint32_t no_id) {
    for (std::ptrdiff_t i = 0; i < std::ptrdiff_t{job.y1 - job.y0} * tile_pitch; ++i) {
        job.depth[i] = farthest;
        if (job.id != nullptr) job.id[i] = no_id;
    }
    for (int i = 0; i < blocks_per_tile; ++i) job.farthest[i] = farthest;
}

}  // namespace

KernelTable const& scalar_kernel() noexcept {
    static constexpr KernelTable table{&transform, &setup, &tile, &clear, nullptr, &draw_masked, nullptr, nullptr};
    return table;
}

}  // namespace gnomon::raster::detail
