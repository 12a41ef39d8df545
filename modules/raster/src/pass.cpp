#include <gnomon/raster/pass.hpp>

#include <gnomon/math/scalar.hpp>
#include <gnomon/raster/layers.hpp>

#include "plan.hpp"
#include "shading.hpp"
#include "tile_io.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace gnomon::raster {

namespace {

using detail::Buffer;
using detail::Corner;
using detail::Item;
using detail::LayerPlan;
using detail::Record;

/// A run of one layer's triangles, set up by one thread into lists of its own.
struct Chunk {
    Buffer<Record> records;
    Buffer<std::uint32_t> entries;
    std::size_t begin = 0, end = 0;  // Triangles of the pass.
    std::size_t first_bin = 0;       // Of its bin starts.
    LayerPlan const* layer = nullptr;
    detail::SetupCounts counts;
};

/// What a batch draws of one layer.
struct LayerBatch {
    std::size_t first_chunk = 0, chunks = 0;
    std::size_t first_tile = 0;  // In the batch.
    std::size_t tiles = 0, tiles_across = 0;
    std::int32_t tile_x = 0, tile_y = 0;  // The first tile.
    Load load = Load::keep;
};

constexpr std::size_t vertex_grain = 4096;
constexpr std::size_t max_chunks = 64;
constexpr std::size_t min_chunk_triangles = 4096;

}  // namespace

struct Workspace::State {
    detail::Plan plan;
    std::vector<LayerBatch> batches;  // One for each layer.
    std::vector<Chunk> chunks;
    Buffer<Corner> corners[2];
    Buffer<std::uint32_t> bins;     // One array of bin starts per chunk.
    Buffer<std::uint64_t> written;  // Samples per tile.
};

Workspace::Workspace() : state_(std::make_unique<State>()) {}
Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

std::size_t Workspace::size_bytes() const noexcept {
    State const& s = *state_;
    std::size_t bytes = s.corners[0].size_bytes() + s.corners[1].size_bytes() + s.bins.size_bytes();
    bytes += s.written.size_bytes() + s.plan.size_bytes() + s.batches.capacity() * sizeof(LayerBatch);
    for (Chunk const& chunk : s.chunks)
        bytes += sizeof(Chunk) + chunk.records.size_bytes() + chunk.entries.size_bytes();
    return bytes;
}

namespace {

/// One pass over its layers, batch of triangles by batch.
class Pass {
  public:
    Pass(Workspace::State& state, detail::Shading const* shading, core::ExecutorRef executor)
        : state_(state), plan_(state.plan), shading_(shading), executor_(executor) {}

    void run() {
        state_.batches.assign(plan_.layers.size(), LayerBatch{});
        std::size_t const size = batch_size();
        std::size_t begin = 0;
        do {  // Once at least: an empty pass still clears.
            std::size_t const end = std::min(plan_.triangles, begin + size);
            begin_batch(begin, end);
            transform(begin, end);
            set_up();
            draw_tiles();
            begin = end;
        } while (begin < plan_.triangles);
        for (LayerPlan const& layer : plan_.layers) finish_pyramid(layer);
    }

  private:
    /// Triangles set up before their tiles are drawn: enough that a tile is visited seldom, few enough that their
    /// records stay in the cache. A function of the targets alone, so that nothing depends on the machine.
    [[nodiscard]] std::size_t batch_size() const {
        return std::clamp<std::size_t>(plan_.pixels / 8, std::size_t{1} << 17U, std::size_t{1} << 20U);
    }

    /// Shares the triangles [begin, end) of the pass out to chunks, none in two layers, and lists the layers' tiles.
    void begin_batch(std::size_t begin, std::size_t end) {
        std::size_t const size = std::max(min_chunk_triangles, (end - begin + max_chunks - 1) / max_chunks);
        chunk_count_ = tile_count_ = 0;
        std::size_t bins = 0;
        for (std::size_t l = 0; l < plan_.layers.size(); ++l) {
            LayerPlan const& layer = plan_.layers[l];
            std::size_t const first = std::max(begin, layer.first_triangle);
            std::size_t const last = std::min(end, layer.end_triangle);
            bool const only_clears = layer.first_triangle == layer.end_triangle && begin == 0;
            LayerBatch& batch = state_.batches[l];
            batch = {};
            batch.first_tile = tile_count_;
            if (layer.is_empty() || (first >= last && !only_clears)) continue;
            batch.first_chunk = chunk_count_;
            batch.chunks = first < last ? (last - first + size - 1) / size : 0;
            chunk_count_ += batch.chunks;
            if (state_.chunks.size() < chunk_count_) state_.chunks.resize(chunk_count_);
            for (std::size_t c = 0; c < batch.chunks; ++c, bins += layer.grid.total + 2) {
                Chunk& chunk = state_.chunks[batch.first_chunk + c];
                chunk.begin = first + c * size;
                chunk.end = std::min(last, chunk.begin + size);
                chunk.first_bin = bins;
                chunk.layer = &layer;
            }
            batch.load = first == layer.first_triangle ? layer.layer->config.load : Load::keep;
            list_tiles(layer, batch);
        }
        state_.bins.fit(bins);
    }

    void list_tiles(LayerPlan const& layer, LayerBatch& batch) {
        batch.tile_x = (layer.x0 + layer.grid.shift_x) >> detail::tile_shift;
        batch.tile_y = layer.y0 >> detail::tile_shift;
        std::int32_t const last_x = (layer.x1 - 1 + layer.grid.shift_x) >> detail::tile_shift;
        std::int32_t const last_y = (layer.y1 - 1) >> detail::tile_shift;
        batch.tiles_across = static_cast<std::size_t>(last_x - batch.tile_x + 1);
        batch.tiles = batch.tiles_across * static_cast<std::size_t>(last_y - batch.tile_y + 1);
        tile_count_ += batch.tiles;
    }

    /// The item of [first, last) that holds element `at` of the sequence that `offset` counts.
    [[nodiscard]] std::size_t item_holding(std::size_t at, std::size_t Item::*offset, std::size_t first,
                                           std::size_t last) const {
        Item const* const items = plan_.items.data();
        auto const* const after = std::upper_bound(items + first, items + last, at,
                                                   [offset](std::size_t i, Item const& d) { return i < d.*offset; });
        return static_cast<std::size_t>(after - items) - 1;
    }
    [[nodiscard]] std::size_t item_of_triangle(std::size_t triangle) const {
        return item_holding(triangle, &Item::first_triangle, 0, plan_.item_count);
    }

    /// The corners of the items that begin in the batch. One that began in the last batch keeps its corners: the two
    /// take turns with two buffers.
    void transform(std::size_t begin, std::size_t end) {
        if (begin == end) return;
        std::size_t const first = transformed_;
        std::size_t const last = item_of_triangle(end - 1) + 1;
        if (first >= last) return;
        if (item_of_triangle(begin) < first) buffer_ ^= 1U;
        std::size_t total = 0;
        for (std::size_t i = first; i < last; ++i) {
            Item& item = plan_.items.data()[i];
            item.first_corner = total;
            total += item.setup.corner_count;
        }
        Corner* const corners = state_.corners[buffer_].fit(total);
        for (std::size_t i = first; i < last; ++i) {
            Item& item = plan_.items.data()[i];
            item.setup.corners = corners + item.first_corner;
        }
        executor_.parallel_for(total, vertex_grain, [&](std::size_t from, std::size_t to) {
            std::size_t i = from < to ? item_holding(from, &Item::first_corner, first, last) : 0;
            for (; from < to; ++i) {
                Item const& item = plan_.items.data()[i];
                std::size_t const stop = std::min<std::size_t>(to, item.first_corner + item.setup.corner_count);
                if (from >= stop) continue;
                std::size_t const shift = item.first_corner - item.setup.first_corner;  // wraps; undone below
                item.kernel->transform(item.vertex, from - shift, stop - shift, corners + from);
                from = stop;
            }
        });
        transformed_ = last;
    }

    void set_up() {
        executor_.parallel_for(chunk_count_, 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t c = first; c < last; ++c) set_up_chunk(state_.chunks[c]);
        });
        for (std::size_t l = 0; l < plan_.layers.size(); ++l) {
            LayerBatch const& batch = state_.batches[l];
            for (std::size_t c = 0; c < batch.chunks; ++c)
                add(plan_.stats[l], state_.chunks[batch.first_chunk + c].counts);
        }
    }

    static void add(PassStats& stats, detail::SetupCounts const& n) {
        stats.bad_index += n.bad_index;
        stats.not_finite += n.not_finite;
        stats.outside += n.outside;
        stats.degenerate += n.degenerate;
        stats.culled += n.culled;
        stats.no_sample += n.no_sample;
        stats.drawn += n.drawn;
        stats.clipped += n.clipped;
    }

    void set_up_chunk(Chunk& chunk) {
        chunk.counts = {};
        // Room for all, so that a camera that sees more than the last one asks for no memory.
        std::size_t const triangles = chunk.end - chunk.begin;
        chunk.records.fit(triangles + triangles / 8);
        detail::RecordSink sink{chunk.records.data(), 0, chunk.records.capacity(), &chunk,
                                [](detail::RecordSink& s, std::size_t more) {
                                    Buffer<Record>& records = static_cast<Chunk*>(s.owner)->records;
                                    s.data = records.fit(s.size + more, s.size);
                                    s.capacity = records.capacity();
                                }};
        std::size_t begin = chunk.begin;
        for (std::size_t i = item_of_triangle(begin); begin < chunk.end; ++i) {
            Item const& item = plan_.items.data()[i];
            std::size_t const stop = std::min(chunk.end, item.first_triangle + item.triangles);
            item.kernel->setup(item.setup, begin - item.first_triangle, stop - item.first_triangle, sink, chunk.counts);
            begin = stop;
        }
        detail::sort_into_bins(chunk.layer->grid, sink.data, sink.size, state_.bins.data() + chunk.first_bin,
                               [&](std::size_t n) { return chunk.entries.fit(std::max(n, 4 * triangles)); });
    }

    void draw_tiles() {
        std::uint64_t* const written = state_.written.fit(tile_count_);
        // Work gathers in few tiles: along the horizon of a street, say. They must not end up in one range.
        std::size_t const grain = std::clamp<std::size_t>(tile_count_ / 1024, 1, 4);
        executor_.parallel_for(tile_count_, grain, [&](std::size_t begin, std::size_t end) {
            auto const after = std::upper_bound(state_.batches.begin(), state_.batches.end(), begin,
                                                [](std::size_t t, LayerBatch const& b) { return t < b.first_tile; });
            auto l = static_cast<std::size_t>(after - state_.batches.begin()) - (begin < end ? 1U : 0U);
            for (std::size_t t = begin; t < end; ++t) {
                while (t >= state_.batches[l].first_tile + state_.batches[l].tiles) ++l;
                written[t] = draw_tile(plan_.layers[l], state_.batches[l], t - state_.batches[l].first_tile);
            }
        });
        for (std::size_t l = 0; l < plan_.layers.size(); ++l) {
            LayerBatch const& batch = state_.batches[l];
            for (std::size_t t = 0; t < batch.tiles; ++t)
                plan_.stats[l].samples_written += written[batch.first_tile + t];
        }
    }

    [[nodiscard]] std::uint64_t draw_tile(LayerPlan const& layer, LayerBatch const& batch, std::size_t tile) const {
        alignas(64) float depth[detail::tile_size * detail::tile_pitch];
        alignas(64) std::uint32_t id[detail::tile_size * detail::tile_pitch];
        alignas(64) float farthest[detail::farthest_size];
        std::int32_t const tile_x = batch.tile_x + static_cast<std::int32_t>(tile % batch.tiles_across);
        std::int32_t const tile_y = batch.tile_y + static_cast<std::int32_t>(tile / batch.tiles_across);
        PassConfig const& config = layer.layer->config;
        detail::TileJob job{.x0 = std::max(layer.x0, (tile_x << detail::tile_shift) - layer.grid.shift_x),
                            .y0 = std::max(layer.y0, tile_y << detail::tile_shift),
                            .x1 = std::min(layer.x1, ((tile_x + 1) << detail::tile_shift) - layer.grid.shift_x),
                            .y1 = std::min(layer.y1, (tile_y + 1) << detail::tile_shift),
                            .depth = depth,
                            .id = layer.layer->triangle.data != nullptr ? id : nullptr,
                            .farthest = farthest,
                            .blocked = layer.kernel->to_rows != nullptr,
                            .reversed = config.depth == math::Depth::reversed,
                            .quantize = layer.layer->target.is_unorm16(),
                            .clamp = config.range == DepthRange::clamp,
                            .masked_context = plan_.masked.data(),
                            .masked = layer.kernel->masked};
        bool loaded = batch.load == Load::clear;
        if (loaded) detail::load_tile(layer, job, batch.load);
        std::uint64_t written = 0;
        std::optional<detail::FragmentBatch> fragments;
        if (shading_ != nullptr) fragments.emplace(*shading_);
        for (std::size_t c = 0; c < batch.chunks; ++c) {
            Chunk const& chunk = state_.chunks[batch.first_chunk + c];
            detail::for_each_run(layer.grid, state_.bins.data() + chunk.first_bin, chunk.entries.data(), tile_x, tile_y,
                                 [&](std::uint32_t const* entries, std::size_t count) {
                                     if (!loaded) detail::load_tile(layer, job, batch.load);
                                     loaded = true;
                                     written += fragments ? detail::shade_records(job, *fragments, chunk.records.data(),
                                                                                  {entries, count})
                                                          : layer.kernel->tile(job, chunk.records.data(), entries, count);
                                 });
        }
        if (fragments) fragments->flush();
        if (loaded) detail::store_tile(layer, job);
        if (loaded && layer.summarizes) detail::summarize_tile(layer, job, batch.load == Load::clear && written == 0);
        return written;
    }

    void finish_pyramid(LayerPlan const& layer) const {
        DepthPyramid* const pyramid = layer.layer->config.pyramid;
        if (pyramid == nullptr) return;
        if (layer.summarizes)
            build_upper_levels(*pyramid);
        else
            build_pyramid(layer.layer->target, layer.layer->config.depth, *pyramid, executor_);
    }

    Workspace::State& state_;
    detail::Plan& plan_;
    detail::Shading const* shading_;  // Or null.
    core::ExecutorRef executor_;
    std::size_t chunk_count_ = 0;
    std::size_t tile_count_ = 0;
    std::size_t transformed_ = 0;  // Items whose corners are made, up to the batch's last.
    unsigned buffer_ = 0;          // Of corners: the one last written.
};

std::span<PassStats const> run_pass(std::span<Draw const> draws, std::span<Layer const> layers, bool draws_own_view,
                                    Workspace& workspace, core::ExecutorRef executor) {
    Workspace::State& state = workspace.state();
    make_plan(state.plan, draws, layers, draws_own_view, executor);
    detail::prefer_blocks(state.plan);
    Pass(state, nullptr, executor).run();
    return state.plan.stats;
}

}  // namespace

PassStats depth_pass(std::span<Draw const> draws, DepthTarget const& target, PassConfig const& config,
                     Workspace& workspace, core::ExecutorRef executor) {
    Layer const layer{.target = target, .config = config};
    return run_pass(draws, {&layer, 1}, true, workspace, executor)[0];
}

PassStats camera_pass(std::span<Draw const> draws, VisibilityTarget const& target, PassConfig const& config,
                      Workspace& workspace, core::ExecutorRef executor) {
    GNOMON_EXPECT(target.depth.width == target.triangle.width && target.depth.height == target.triangle.height);
    Layer const layer{.target = target.depth, .triangle = target.triangle, .config = config};
    return run_pass(draws, {&layer, 1}, true, workspace, executor)[0];
}

std::span<PassStats const> layered_pass(std::span<Draw const> draws, std::span<Layer const> layers,
                                        Workspace& workspace, core::ExecutorRef executor) {
    return run_pass(draws, layers, false, workspace, executor);
}

PassStats shading_pass(std::span<Draw const> draws, Layer const& layer, detail::Shading const& shading, Workspace& workspace,
                       core::ExecutorRef executor) {
    GNOMON_EXPECT(layer.triangle.data == nullptr && layer.config.pyramid == nullptr);
    Workspace::State& state = workspace.state();
    make_plan(state.plan, draws, {&layer, 1}, false, executor);
    Pass(state, &shading, executor).run();
    return state.plan.stats[0];
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
