#include <gnomon/raster/pass.hpp>

#include <gnomon/math/scalar.hpp>
#include <gnomon/raster/triangle.hpp>

#include "bins.hpp"
#include "buffer.hpp"
#include "kernel.hpp"
#include "masked.hpp"

#include <algorithm>
#include <vector>

namespace gnomon::raster {

namespace {

using detail::Buffer;
using detail::Corner;
using detail::Record;

/// A draw with everything that is fixed for the pass.
struct DrawState {
    detail::VertexJob vertex;
    detail::SetupJob setup;
    std::size_t first_corner;    // In the workspace's corners.
    std::size_t first_triangle;  // In the pass.
    std::size_t triangles;
};

/// A run of triangles, set up by one thread into lists of its own.
struct Chunk {
    Buffer<Record> records;
    Buffer<std::uint32_t> entries;
    std::size_t record_count = 0;
    detail::SetupCounts counts;
};

constexpr std::size_t vertex_grain = 4096;
constexpr std::size_t max_chunks = 64;
constexpr std::size_t min_chunk_triangles = 4096;
constexpr std::int64_t streamed_pixels = std::int64_t{1} << 23U;  // 32 MiB of depth

}  // namespace

struct Workspace::State {
    std::vector<DrawState> draws;
    std::vector<detail::MaskedDraw> masked;
    std::vector<Chunk> chunks;
    Buffer<Corner> corners;
    Buffer<std::uint32_t> bins;     // One array of bin starts per chunk.
    Buffer<std::uint64_t> written;  // Samples per tile.
};

Workspace::Workspace() : state_(std::make_unique<State>()) {}
Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

std::size_t Workspace::size_bytes() const noexcept {
    State const& s = *state_;
    std::size_t bytes = s.corners.size_bytes() + s.bins.size_bytes() + s.written.size_bytes();
    bytes += s.draws.capacity() * sizeof(DrawState) + s.masked.capacity() * sizeof(detail::MaskedDraw);
    for (Chunk const& chunk : s.chunks)
        bytes += sizeof(Chunk) + chunk.records.size_bytes() + chunk.entries.size_bytes();
    return bytes;
}

namespace {

/// One pass over one target, from the draws to the last tile.
class Pass {
  public:
    Pass(PassConfig const& config, DepthTarget const& depth, ImageView<std::uint32_t> const* triangle,
         Workspace::State& state, core::ExecutorRef executor)
        : config_(config), depth_(depth), triangle_(triangle), state_(state), executor_(executor) {
        detail::KernelTable const* const simd = detail::simd_kernel();
        kernel_ = config.kernel == Kernel::scalar || simd == nullptr ? &detail::scalar_kernel() : simd;
    }

    PassStats run(std::span<Draw const> draws) {
        PassStats stats;
        for (Draw const& draw : draws) stats.triangles += triangle_count(draw);
        Rect const whole{0, 0, depth_.width(), depth_.height()};
        GNOMON_EXPECT(whole.width <= max_size_px && whole.height <= max_size_px);
        Rect const viewport = config_.viewport.value_or(whole);
        set_scissor(config_.scissor.value_or(whole), whole);
        if (x1_ <= x0_ || y1_ <= y0_) {
            stats.outside = stats.triangles;
            return stats;
        }
        streams_ = kernel_->stream != nullptr && !depth_.is_unorm16() &&
                   std::int64_t{whole.width} * whole.height >= streamed_pixels;
        grid_ = detail::make_bin_grid(whole.width, whole.height, streams_ ? columns_past_a_line() : 0);
        bool const visible = viewport.width > 0 && viewport.height > 0;
        if (!visible) stats.outside = stats.triangles;
        prepare(visible ? draws : std::span<Draw const>{}, viewport);
        transform();
        std::size_t const total = visible ? static_cast<std::size_t>(stats.triangles) : 0;
        std::size_t begin = 0;
        do {  // Once at least: an empty pass still clears.
            std::size_t const end = std::min(total, begin + batch_size());
            set_up(begin, end, stats);
            stats.samples_written += draw_tiles(begin == 0 ? config_.load : Load::keep);
            begin = end;
        } while (begin < total);
        return stats;
    }

  private:
    void set_scissor(Rect const& scissor, Rect const& whole) {
        auto const end = [](std::int32_t at, std::int32_t size, std::int32_t limit) {
            return static_cast<std::int32_t>(std::min<std::int64_t>(std::int64_t{at} + std::max(size, 0), limit));
        };
        x0_ = std::max(scissor.x, 0);
        y0_ = std::max(scissor.y, 0);
        x1_ = end(scissor.x, scissor.width, whole.width);
        y1_ = end(scissor.y, scissor.height, whole.height);
    }

    /// How far into a cache line the image's rows begin: with the grid shifted by it, tiles are whole lines.
    [[nodiscard]] std::int32_t columns_past_a_line() const {
        auto const address = reinterpret_cast<std::uintptr_t>(depth_.f32().data);
        return depth_.f32().stride % 16 == 0 ? static_cast<std::int32_t>(address % 64 / sizeof(float)) : 0;
    }

    /// Triangles set up before their tiles are drawn: enough that a tile is visited seldom, few enough that their
    /// records stay in the cache. A function of the target alone, so that nothing depends on the machine.
    [[nodiscard]] std::size_t batch_size() const {
        std::size_t const pixels = static_cast<std::size_t>(depth_.width()) * static_cast<std::size_t>(depth_.height());
        return std::clamp<std::size_t>(pixels / 8, std::size_t{1} << 17U, std::size_t{1} << 20U);
    }

    void prepare(std::span<Draw const> draws, Rect const& viewport) {
        state_.draws.clear();
        state_.masked.clear();
        corner_total_ = 0;
        std::size_t triangles = 0;
        for (Draw const& draw : draws) {
            state_.draws.push_back(make_state(draw, viewport));
            DrawState& added = state_.draws.back();
            added.first_corner = corner_total_;
            added.first_triangle = triangles;
            corner_total_ += added.setup.corner_count;
            triangles += added.triangles;
            bool const masked =
                draw.alpha_test != nullptr && detail::is_complete(*draw.alpha_test, draw.positions.size());
            if (masked) {
                state_.masked.push_back({draw.alpha_test, nullptr, draw.indices, draw.first_triangle});
                added.setup.tag = static_cast<std::uint32_t>(state_.masked.size()) << 1U;
            }
        }
        Corner* const corners = state_.corners.fit(corner_total_);
        for (DrawState& draw : state_.draws) {  // The draws no longer move: pointers into them hold.
            draw.setup.corners = corners + draw.first_corner;
            draw.setup.vertex = &draw.vertex;
            if (draw.setup.tag != 0) state_.masked[(draw.setup.tag >> 1U) - 1].vertex = &draw.vertex;
        }
    }

    [[nodiscard]] DrawState make_state(Draw const& draw, Rect const& viewport) const {
        ViewportTransform const v = make_viewport(viewport, config_.range == DepthRange::clip);
        DrawState s{};
        s.vertex = {.positions = reinterpret_cast<unsigned char const*>(draw.positions.data()),
                    .stride = draw.positions.stride_bytes(),
                    .origin = {draw.origin.x, draw.origin.y, draw.origin.z},
                    .row = {},
                    .half_width = v.half_width_px,
                    .half_height = v.half_height_px,
                    .offset_x = v.offset_x,
                    .offset_y = v.offset_y,
                    .guard_x = v.guard_x,
                    .guard_y = v.guard_y,
                    .clip_depth = v.clip_depth};
        for (math::axis_t row = 0; row < 4; ++row)
            for (math::axis_t column = 0; column < 4; ++column)
                s.vertex.row[row][column] = draw.clip_from_relative[column][row];
        s.triangles = triangle_count(draw);
        s.setup.index32 = draw.indices.wide();
        s.setup.index16 = draw.indices.narrow();
        s.setup.id_base = draw.first_triangle;
        s.setup.facing = draw.cull == Cull::none   ? detail::Facing::any
                         : draw.cull == Cull::back ? detail::Facing::negative_only
                                                   : detail::Facing::positive_only;
        s.setup.x0 = x0_;
        s.setup.y0 = y0_;
        s.setup.x1 = x1_;
        s.setup.y1 = y1_;
        set_corner_range(draw, s.setup);
        return s;
    }

    /// Which positions to transform: all, or those that few indices into a large buffer name.
    static void set_corner_range(Draw const& draw, detail::SetupJob& setup) {
        std::size_t const size = std::min<std::size_t>(draw.positions.size(), ~0U);
        setup.corner_count = static_cast<std::uint32_t>(size);
        if (draw.indices.empty() || draw.indices.size() >= size) return;
        std::uint32_t low = ~0U;
        std::uint32_t high = 0;
        for (std::size_t i = 0; i < draw.indices.size(); ++i) {
            std::uint32_t const index = draw.indices[i];
            if (index >= size) continue;
            low = std::min(low, index);
            high = std::max(high, index);
        }
        setup.first_corner = low <= high ? low : 0;
        setup.corner_count = low <= high ? high - low + 1 : 0;
    }

    template <class Offset>
    [[nodiscard]] std::size_t draw_holding(std::size_t item, Offset offset) const {
        auto const after = std::upper_bound(state_.draws.begin(), state_.draws.end(), item,
                                            [offset](std::size_t i, DrawState const& d) { return i < d.*offset; });
        return static_cast<std::size_t>(after - state_.draws.begin()) - 1;
    }

    void transform() {
        executor_.parallel_for(corner_total_, vertex_grain, [this](std::size_t begin, std::size_t end) {
            std::size_t d = begin < end ? draw_holding(begin, &DrawState::first_corner) : 0;
            for (; begin < end; ++d) {
                DrawState const& draw = state_.draws[d];
                std::size_t const stop = std::min<std::size_t>(end, draw.first_corner + draw.setup.corner_count);
                if (begin >= stop) continue;
                std::size_t const shift = draw.first_corner - draw.setup.first_corner;  // wraps; undone below
                kernel_->transform(draw.vertex, begin - shift, stop - shift, state_.corners.data() + begin);
                begin = stop;
            }
        });
    }

    void set_up(std::size_t begin, std::size_t end, PassStats& stats) {
        std::size_t const size = std::max(min_chunk_triangles, (end - begin + max_chunks - 1) / max_chunks);
        chunk_count_ = (end - begin + size - 1) / size;
        if (state_.chunks.size() < chunk_count_) state_.chunks.resize(chunk_count_);
        state_.bins.fit(chunk_count_ * (grid_.total + 2));
        executor_.parallel_for(chunk_count_, 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t c = first; c < last; ++c)
                set_up_chunk(c, begin + c * size, std::min(end, begin + (c + 1) * size));
        });
        for (std::size_t c = 0; c < chunk_count_; ++c) {
            detail::SetupCounts const& n = state_.chunks[c].counts;
            stats.bad_index += n.bad_index;
            stats.not_finite += n.not_finite;
            stats.outside += n.outside;
            stats.degenerate += n.degenerate;
            stats.culled += n.culled;
            stats.no_sample += n.no_sample;
            stats.drawn += n.drawn;
            stats.clipped += n.clipped;
        }
    }

    void set_up_chunk(std::size_t c, std::size_t begin, std::size_t end) {
        Chunk& chunk = state_.chunks[c];
        chunk.counts = {};
        detail::RecordSink sink{chunk.records.data(), 0, chunk.records.capacity(), &chunk,
                                [](detail::RecordSink& s, std::size_t more) {
                                    Buffer<Record>& records = static_cast<Chunk*>(s.owner)->records;
                                    s.data = records.fit(s.size + more, s.size);
                                    s.capacity = records.capacity();
                                }};
        for (std::size_t d = draw_holding(begin, &DrawState::first_triangle); begin < end; ++d) {
            DrawState const& draw = state_.draws[d];
            std::size_t const stop = std::min(end, draw.first_triangle + draw.triangles);
            if (begin >= stop) continue;
            kernel_->setup(draw.setup, begin - draw.first_triangle, stop - draw.first_triangle, sink, chunk.counts);
            begin = stop;
        }
        chunk.record_count = sink.size;
        detail::sort_into_bins(grid_, sink.data, sink.size, bin_begin(c),
                               [&](std::size_t n) { return chunk.entries.fit(n); });
    }

    [[nodiscard]] std::uint32_t* bin_begin(std::size_t chunk) const {
        return state_.bins.data() + chunk * (grid_.total + 2);
    }

    [[nodiscard]] std::uint64_t draw_tiles(Load load) {
        std::int32_t const first_x = (x0_ + grid_.shift_x) >> detail::tile_shift;
        std::int32_t const first_y = y0_ >> detail::tile_shift;
        auto const across = static_cast<std::size_t>(((x1_ - 1 + grid_.shift_x) >> detail::tile_shift) - first_x + 1);
        auto const down = static_cast<std::size_t>(((y1_ - 1) >> detail::tile_shift) - first_y + 1);
        std::uint64_t* const written = state_.written.fit(across * down);
        executor_.parallel_for(across * down, 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t t = begin; t < end; ++t)
                written[t] = draw_tile(first_x + static_cast<std::int32_t>(t % across),
                                       first_y + static_cast<std::int32_t>(t / across), load);
        });
        std::uint64_t sum = 0;
        for (std::size_t t = 0; t < across * down; ++t) sum += written[t];
        return sum;
    }

    [[nodiscard]] std::uint64_t draw_tile(std::int32_t tile_x, std::int32_t tile_y, Load load) const {
        alignas(64) float depth[detail::tile_size * detail::tile_pitch];
        alignas(64) std::uint32_t id[detail::tile_size * detail::tile_pitch];
        alignas(64) float farthest[detail::blocks_per_tile];
        detail::TileJob job{.x0 = std::max(x0_, (tile_x << detail::tile_shift) - grid_.shift_x),
                            .y0 = std::max(y0_, tile_y << detail::tile_shift),
                            .x1 = std::min(x1_, ((tile_x + 1) << detail::tile_shift) - grid_.shift_x),
                            .y1 = std::min(y1_, (tile_y + 1) << detail::tile_shift),
                            .depth = depth,
                            .id = triangle_ != nullptr ? id : nullptr,
                            .farthest = farthest,
                            .reversed = config_.depth == math::Depth::reversed,
                            .quantize = depth_.is_unorm16(),
                            .clamp = config_.range == DepthRange::clamp,
                            .masked_context = state_.masked.data(),
                            .masked = &detail::draw_masked};
        bool loaded = load == Load::clear;
        if (loaded) load_tile(job, load);
        std::uint64_t written = 0;
        for (std::size_t c = 0; c < chunk_count_; ++c) {
            Chunk const& chunk = state_.chunks[c];
            detail::for_each_run(grid_, bin_begin(c), chunk.entries.data(), tile_x, tile_y,
                                 [&](std::uint32_t const* entries, std::size_t count) {
                                     if (!loaded) load_tile(job, load);
                                     loaded = true;
                                     written += kernel_->tile(job, chunk.records.data(), entries, count);
                                 });
        }
        if (loaded) store_tile(job);
        return written;
    }

    void load_tile(detail::TileJob const& job, Load load) const {
        float const farthest = job.reversed ? 0.0F : job.quantize ? 65535.0F : 1.0F;
        kernel_->clear(job, farthest, no_triangle);
        if (load == Load::clear) return;
        for (std::int32_t y = job.y0; y < job.y1; ++y) {
            std::ptrdiff_t const row = std::ptrdiff_t{y - job.y0} * detail::tile_pitch;
            std::int32_t const width = job.x1 - job.x0;
            if (job.quantize)
                std::copy_n(depth_.unorm16().row(y) + job.x0, width, job.depth + row);
            else
                std::copy_n(depth_.f32().row(y) + job.x0, width, job.depth + row);
            if (job.id != nullptr) std::copy_n(triangle_->row(y) + job.x0, width, job.id + row);
        }
    }

    /// Copies a tile out; past the caches where the image is too large to be found there again.
    template <class T>
    void store_rows(detail::TileJob const& job, T const* from, ImageView<T> const& to) const {
        detail::TileRows const rows{to.row(job.y0) + job.x0, to.stride * static_cast<std::ptrdiff_t>(sizeof(T)),
                                    job.y1 - job.y0};
        bool const aligned =
            (reinterpret_cast<std::uintptr_t>(rows.first) | static_cast<std::uintptr_t>(rows.stride_bytes)) % 64 == 0;
        if (streams_ && aligned && job.x1 - job.x0 == detail::tile_size) {
            kernel_->stream(rows, from);
            return;
        }
        for (std::int32_t y = job.y0; y < job.y1; ++y, from += detail::tile_pitch)
            std::copy_n(from, job.x1 - job.x0, to.row(y) + job.x0);
    }

    void store_tile(detail::TileJob const& job) const {
        if (job.id != nullptr) store_rows(job, job.id, *triangle_);
        if (!job.quantize) {
            store_rows(job, job.depth, depth_.f32());
            return;
        }
        for (std::int32_t y = job.y0; y < job.y1; ++y) {
            float const* const row = job.depth + std::ptrdiff_t{y - job.y0} * detail::tile_pitch;
            std::transform(row, row + (job.x1 - job.x0), depth_.unorm16().row(y) + job.x0,
                           [](float code) { return static_cast<std::uint16_t>(code); });
        }
    }

    PassConfig const& config_;
    DepthTarget const& depth_;
    ImageView<std::uint32_t> const* triangle_;
    Workspace::State& state_;
    core::ExecutorRef executor_;
    detail::KernelTable const* kernel_ = nullptr;
    detail::BinGrid grid_;
    bool streams_ = false;
    std::int32_t x0_ = 0, y0_ = 0, x1_ = 0, y1_ = 0;  // What is drawn: scissor and target.
    std::size_t corner_total_ = 0;
    std::size_t chunk_count_ = 0;
};

}  // namespace

PassStats depth_pass(std::span<Draw const> draws, DepthTarget const& target, PassConfig const& config,
                     Workspace& workspace, core::ExecutorRef executor) {
    return Pass(config, target, nullptr, workspace.state(), executor).run(draws);
}

PassStats camera_pass(std::span<Draw const> draws, VisibilityTarget const& target, PassConfig const& config,
                      Workspace& workspace, core::ExecutorRef executor) {
    GNOMON_EXPECT(target.depth.width == target.triangle.width && target.depth.height == target.triangle.height);
    return Pass(config, DepthTarget(target.depth), &target.triangle, workspace.state(), executor).run(draws);
}

bool has_simd_kernel() noexcept { return detail::simd_kernel() != nullptr; }

DrawFaults validate(Draw const& draw) noexcept {
    DrawFaults faults;
    std::size_t const count = draw.indices.empty() ? draw.positions.size() : draw.indices.size();
    faults.loose_indices = static_cast<std::uint32_t>(count % 3);
    for (std::size_t i = 0; i < draw.positions.size(); ++i)
        if (!math::is_finite(draw.positions[i])) ++faults.not_finite_positions;
    for (std::size_t i = 0; i + 2 < draw.indices.size(); i += 3) {
        bool bad = false;
        for (std::size_t k = 0; k < 3; ++k) bad = bad || draw.indices[i + k] >= draw.positions.size();
        if (bad) ++faults.bad_index_triangles;
    }
    faults.uv_missing = draw.alpha_test != nullptr && !detail::is_complete(*draw.alpha_test, draw.positions.size());
    return faults;
}

}  // namespace gnomon::raster
