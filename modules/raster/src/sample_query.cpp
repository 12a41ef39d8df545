#include <gnomon/raster/sample_query.hpp>

#include <gnomon/math/scalar.hpp>

#include "pieces.hpp"
#include "plan.hpp"
#include "tile_io.hpp"

#include <algorithm>
#include <vector>

namespace gnomon::raster {

namespace {

using detail::Buffer;
using detail::Corner;
using detail::Item;
using detail::LayerPlan;
using detail::Record;
using detail::TileJob;

constexpr std::size_t max_parts = 16;

/// What one thread works in.
struct Scratch {
    detail::Plan plan;
    Layer layer{.target = ImageView<float>{}};
    Buffer<Corner> corners;
    Buffer<Record> records;
    Buffer<std::uint32_t> entries;
    Buffer<std::uint32_t> bins;
    math::vec3 box_corners[8];

    [[nodiscard]] std::size_t size_bytes() const noexcept {
        return sizeof(Scratch) + plan.size_bytes() + corners.size_bytes() + records.size_bytes() +
               entries.size_bytes() + bins.size_bytes();
    }
};

/// Pixels that records touch; end exclusive.
struct Extent {
    std::int32_t x0 = max_size_px, y0 = max_size_px, x1 = 0, y1 = 0;
};

/// One query: its records made, then its tiles drawn into copies that are thrown away.
class Query {
  public:
    Query(Scratch& scratch, bool any) : scratch_(scratch), any_(any) {}

    /// Lays the query out. The plan holds as long as the draws stay where they are.
    void plan(std::span<Draw const> draws, Layer const& layer) {
        scratch_.layer = layer;
        scratch_.layer.triangle = {};
        scratch_.layer.config.load = Load::keep;
        scratch_.layer.config.pyramid = nullptr;
        core::SerialExecutor serial;
        detail::make_plan(scratch_.plan, draws, {&scratch_.layer, 1}, false, serial);
    }

    [[nodiscard]] std::uint64_t run() {
        if (scratch_.plan.layers[0].is_empty()) return 0;
        set_up();
        return count_ <= few_records ? draw_few() : draw_binned();
    }

  private:
    static constexpr std::size_t few_records = 64;

    void set_up() {
        detail::RecordSink sink{scratch_.records.data(), 0, scratch_.records.capacity(), &scratch_.records,
                                [](detail::RecordSink& s, std::size_t more) {
                                    auto& records = *static_cast<Buffer<Record>*>(s.owner);
                                    s.data = records.fit(s.size + more, s.size);
                                    s.capacity = records.capacity();
                                }};
        detail::SetupCounts counts;
        for (std::size_t i = 0; i < scratch_.plan.item_count; ++i) {
            Item& item = scratch_.plan.items.data()[i];
            std::size_t const first = item.setup.first_corner;
            Corner* const corners = scratch_.corners.fit(item.setup.corner_count);
            item.kernel->transform(item.vertex, first, first + item.setup.corner_count, corners);
            item.setup.corners = corners;
            item.kernel->setup(item.setup, 0, item.triangles, sink, counts);
        }
        count_ = sink.size;
        for (std::size_t i = 0; i < count_; ++i) {
            Record const& r = sink.data[i];
            extent_.x0 = std::min<std::int32_t>(extent_.x0, r.min_x);
            extent_.y0 = std::min<std::int32_t>(extent_.y0, r.min_y);
            extent_.x1 = std::max<std::int32_t>(extent_.x1, r.max_x + 1);
            extent_.y1 = std::max<std::int32_t>(extent_.y1, r.max_y + 1);
        }
    }

    /// All records in each of the windows that their extent needs.
    [[nodiscard]] std::uint64_t draw_few() {
        std::uint32_t entries[few_records];
        for (std::uint32_t i = 0; i < few_records; ++i) entries[i] = i;
        std::uint64_t sum = 0;
        for (std::int32_t y = extent_.y0; y < extent_.y1; y += detail::tile_size)
            for (std::int32_t x = extent_.x0; x < extent_.x1; x += detail::tile_size) {
                Extent const window{x, y, std::min(x + detail::tile_size, extent_.x1),
                                    std::min(y + detail::tile_size, extent_.y1)};
                sum += draw_window(window, [&](TileJob const& job, auto const& draw) { draw(job, entries, count_); });
                if (any_ && sum != 0) return sum;
            }
        return sum;
    }

    /// The records sorted by tile, as a pass does.
    [[nodiscard]] std::uint64_t draw_binned() {
        LayerPlan const& layer = scratch_.plan.layers[0];
        DepthTarget const& image = layer.layer->target;
        detail::BinGrid const grid = detail::make_bin_grid(image.width(), image.height(), 0);
        std::uint32_t* const bins = scratch_.bins.fit(grid.total + 2);
        detail::sort_into_bins(grid, scratch_.records.data(), count_, bins,
                               [&](std::size_t n) { return scratch_.entries.fit(n); });
        std::uint64_t sum = 0;
        for (std::int32_t ty = extent_.y0 >> detail::tile_shift; ty <= (extent_.y1 - 1) >> detail::tile_shift; ++ty)
            for (std::int32_t tx = extent_.x0 >> detail::tile_shift; tx <= (extent_.x1 - 1) >> detail::tile_shift;
                 ++tx) {
                std::int32_t const x = tx << detail::tile_shift;
                std::int32_t const y = ty << detail::tile_shift;
                Extent const window{std::max(x, extent_.x0), std::max(y, extent_.y0),
                                    std::min(x + detail::tile_size, extent_.x1),
                                    std::min(y + detail::tile_size, extent_.y1)};
                sum += draw_window(window, [&](TileJob const& job, auto const& draw) {
                    detail::for_each_run(
                        grid, bins, scratch_.entries.data(), tx, ty,
                        [&](std::uint32_t const* entries, std::size_t count) { draw(job, entries, count); });
                });
                if (any_ && sum != 0) return sum;
            }
        return sum;
    }

    /// Draws one window's records into a copy of the image; `runs` hands them out.
    ///
    /// returns: samples that became nearer; with `any_`, whether one did.
    template <class Runs>
    [[nodiscard]] std::uint64_t draw_window(Extent const& window, Runs runs) {
        alignas(64) float depth[detail::tile_size * detail::tile_pitch];
        alignas(64) float farthest[detail::blocks_per_tile];
        LayerPlan const& layer = scratch_.plan.layers[0];
        PassConfig const& config = layer.layer->config;
        TileJob const job{.x0 = window.x0,
                          .y0 = window.y0,
                          .x1 = window.x1,
                          .y1 = window.y1,
                          .depth = depth,
                          .id = nullptr,
                          .farthest = farthest,
                          .blocked = false,
                          .reversed = config.depth == math::Depth::reversed,
                          .quantize = layer.layer->target.is_unorm16(),
                          .clamp = config.range == DepthRange::clamp,
                          .masked_context = scratch_.plan.masked.data(),
                          .masked = &detail::draw_masked};
        detail::load_tile(layer, job, Load::keep);
        std::uint64_t written = 0;
        runs(job, [&](TileJob const& j, std::uint32_t const* entries, std::size_t count) {
            if (!any_ || written == 0) written += layer.kernel->tile(j, scratch_.records.data(), entries, count);
        });
        if (any_ || written == 0) return written != 0 ? 1 : 0;
        return layer.layer->target.is_unorm16() ? changed(job, layer.layer->target.unorm16())
                                                : changed(job, layer.layer->target.f32());
    }

    template <class T>
    [[nodiscard]] static std::uint64_t changed(TileJob const& job, ImageView<T> const& image) {
        std::uint32_t count = 0;
        for (std::int32_t y = job.y0; y < job.y1; ++y) {
            T const* const held = image.row(y) + job.x0;
            float const* const now = job.depth + std::ptrdiff_t{y - job.y0} * detail::tile_pitch;
            for (std::int32_t x = 0; x < job.x1 - job.x0; ++x) {
                auto const before = static_cast<float>(held[x]);
                count += (job.reversed ? now[x] > before : now[x] < before) ? 1U : 0U;  // false where it held NaN
            }
        }
        return count;
    }

    Scratch& scratch_;
    bool any_;
    std::size_t count_ = 0;
    Extent extent_;
};

/// Calls f(scratch, begin, end) for parts of [0, n), each with a scratch of its own.
template <class F>
void in_parts(std::vector<Scratch>& scratch, std::size_t n, core::ExecutorRef executor, F f) {
    std::size_t const parts = std::min(max_parts, n);
    if (scratch.size() < parts) scratch.resize(parts);
    executor.parallel_for(parts, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) f(scratch[p], n * p / parts, n * (p + 1) / parts);
    });
}

void query_boxes(std::span<math::Aabb const> boxes, Layer const& layer, Scratch& scratch, bool any,
                 std::uint64_t* out) {
    Draw const draw{.positions = std::span<math::vec3 const>(scratch.box_corners),
                    .indices = std::span<std::uint32_t const>(box_indices),
                    .groups = layer.groups};
    Query(scratch, any).plan({&draw, 1}, layer);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        out[i] = 0;
        if (math::is_empty(boxes[i])) continue;
        for (unsigned c = 0; c < 8; ++c) scratch.box_corners[c] = math::corner(boxes[i], c);
        out[i] = Query(scratch, any).run();
    }
}

template <class Visit>
void for_each_row(RectQuery const& query, Layer const& layer, Visit visit) {
    DepthTarget const& image = layer.target;
    Rect const whole{0, 0, image.width(), image.height()};
    Rect const scissor = layer.config.scissor.value_or(whole);
    auto const end = [](std::int32_t at, std::int32_t size) { return std::int64_t{at} + std::max(size, 0); };
    std::int32_t const x0 = std::max({query.rect.x, scissor.x, 0});
    std::int32_t const y0 = std::max({query.rect.y, scissor.y, 0});
    std::int64_t const x1 = std::min({end(query.rect.x, query.rect.width), end(scissor.x, scissor.width),
                                      std::int64_t{whole.width}});
    std::int64_t const y1 = std::min({end(query.rect.y, query.rect.height), end(scissor.y, scissor.height),
                                      std::int64_t{whole.height}});
    for (std::int32_t y = y0; y < y1 && x0 < x1; ++y)
        if (!visit(y, x0, static_cast<std::int32_t>(x1))) return;
}

/// Samples of row y, columns [x0, x1).
template <class T>
std::uint64_t count_row(RectQuery const& query, ImageView<T> const& image, float depth, bool reversed, Rect const& run) {
    T const* const held = image.row(run.y) + run.x;
    std::uint32_t count = 0;
    if (query.mask.words == nullptr) {
        for (std::int32_t i = 0; i < run.width; ++i) {
            auto const z = static_cast<float>(held[i]);
            count += (reversed ? depth > z : depth < z) ? 1U : 0U;
        }
        return count;
    }
    std::uint32_t const* const words = query.mask.words + (run.y - query.rect.y) * query.mask.words_per_row;
    for (std::int32_t i = 0; i < run.width; ++i) {
        auto const z = static_cast<float>(held[i]);
        auto const bit = static_cast<std::uint32_t>(run.x - query.rect.x + i);
        count += (reversed ? depth > z : depth < z) ? words[bit >> 5U] >> (bit & 31U) & 1U : 0U;
    }
    return count;
}

std::uint64_t query_rect(RectQuery const& query, Layer const& layer, bool any) {
    bool const reversed = layer.config.depth == math::Depth::reversed;
    DepthTarget const& image = layer.target;
    if (math::is_nan(query.depth)) return 0;
    float depth = detail::at_most(detail::at_least(query.depth, 0.0F), 1.0F);
    if (image.is_unorm16()) depth = detail::to_code(depth);
    std::uint64_t sum = 0;
    for_each_row(query, layer, [&](std::int32_t y, std::int32_t x0, std::int32_t x1) {
        Rect const run{x0, y, x1 - x0, 1};
        sum += image.is_unorm16() ? count_row(query, image.unorm16(), depth, reversed, run)
                                  : count_row(query, image.f32(), depth, reversed, run);
        return !any || sum == 0;
    });
    return sum;
}

}  // namespace

struct QueryWorkspace::State {
    std::vector<Scratch> scratch;
};

QueryWorkspace::QueryWorkspace() : state_(std::make_unique<State>()) {}
QueryWorkspace::~QueryWorkspace() = default;
QueryWorkspace::QueryWorkspace(QueryWorkspace&&) noexcept = default;
QueryWorkspace& QueryWorkspace::operator=(QueryWorkspace&&) noexcept = default;

std::size_t QueryWorkspace::size_bytes() const noexcept {
    std::size_t bytes = 0;
    for (Scratch const& s : state_->scratch) bytes += s.size_bytes();
    return bytes;
}

namespace {

std::uint64_t query_mesh(std::span<Draw const> draws, Layer const& layer, QueryWorkspace& workspace, bool any) {
    std::vector<Scratch>& scratch = workspace.state().scratch;
    if (scratch.empty()) scratch.resize(1);
    Query query(scratch[0], any);
    query.plan(draws, layer);
    return query.run();
}

template <class T>
void query_meshes(std::span<std::span<Draw const> const> meshes, Layer const& layer, std::span<T> out,
                  QueryWorkspace& workspace, core::ExecutorRef executor) {
    GNOMON_EXPECT(out.size() == meshes.size());
    in_parts(workspace.state().scratch, meshes.size(), executor,
             [&](Scratch& scratch, std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) {
                     Query query(scratch, std::is_same_v<T, std::uint8_t>);
                     query.plan(meshes[i], layer);
                     out[i] = static_cast<T>(query.run());
                 }
             });
}

template <class T>
void query_all_boxes(std::span<math::Aabb const> boxes, Layer const& layer, std::span<T> out,
                     QueryWorkspace& workspace, core::ExecutorRef executor) {
    GNOMON_EXPECT(out.size() == boxes.size());
    in_parts(workspace.state().scratch, boxes.size(), executor,
             [&](Scratch& scratch, std::size_t begin, std::size_t end) {
                 constexpr std::size_t run = 64;
                 std::uint64_t found[run];
                 for (; begin < end; begin += run) {
                     std::size_t const n = std::min(run, end - begin);
                     query_boxes(boxes.subspan(begin, n), layer, scratch, std::is_same_v<T, std::uint8_t>, found);
                     for (std::size_t i = 0; i < n; ++i) out[begin + i] = static_cast<T>(found[i]);
                 }
             });
}

}  // namespace

std::uint64_t count_samples_passing(std::span<Draw const> draws, Layer const& layer, QueryWorkspace& workspace) {
    return query_mesh(draws, layer, workspace, false);
}
bool any_sample_passing(std::span<Draw const> draws, Layer const& layer, QueryWorkspace& workspace) {
    return query_mesh(draws, layer, workspace, true) != 0;
}
void count_samples_passing(std::span<std::span<Draw const> const> meshes, Layer const& layer,
                           std::span<std::uint64_t> out, QueryWorkspace& workspace, core::ExecutorRef executor) {
    query_meshes(meshes, layer, out, workspace, executor);
}
void any_sample_passing(std::span<std::span<Draw const> const> meshes, Layer const& layer, std::span<std::uint8_t> out,
                        QueryWorkspace& workspace, core::ExecutorRef executor) {
    query_meshes(meshes, layer, out, workspace, executor);
}
void count_samples_passing(std::span<math::Aabb const> boxes, Layer const& layer, std::span<std::uint64_t> out,
                           QueryWorkspace& workspace, core::ExecutorRef executor) {
    query_all_boxes(boxes, layer, out, workspace, executor);
}
void any_sample_passing(std::span<math::Aabb const> boxes, Layer const& layer, std::span<std::uint8_t> out,
                        QueryWorkspace& workspace, core::ExecutorRef executor) {
    query_all_boxes(boxes, layer, out, workspace, executor);
}

std::uint64_t count_samples_passing(RectQuery const& query, Layer const& layer) noexcept {
    return query_rect(query, layer, false);
}
bool any_sample_passing(RectQuery const& query, Layer const& layer) noexcept {
    return query_rect(query, layer, true) != 0;
}

}  // namespace gnomon::raster
