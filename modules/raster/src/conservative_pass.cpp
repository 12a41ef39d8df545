// The conservative pass: set-up of triangles and polygons, and the loops over a tile's pixels.

#include "conservative_pass.hpp"

#include "conservative.hpp"
#include "tile_io.hpp"
#include "tile_workspace.hpp"
#include "triangle_source.hpp"

#include <algorithm>

namespace gnomon::raster::detail {

namespace {

struct PixelBounds {
    std::int32_t min_x, min_y, max_x, max_y;
    [[nodiscard]] bool is_empty() const { return min_x > max_x || min_y > max_y; }
};

/// Pixels whose squares meet the corners' bounds, or lie within them.
PixelBounds bounds_of(SnappedPolygon const& p, bool outer, std::int32_t slack) {
    std::int32_t x0 = p.corner[0].x, x1 = x0, y0 = p.corner[0].y, y1 = y0;
    for (std::size_t i = 1; i < static_cast<std::size_t>(p.count); ++i) {
        x0 = std::min(x0, p.corner[i].x);
        x1 = std::max(x1, p.corner[i].x);
        y0 = std::min(y0, p.corner[i].y);
        y1 = std::max(y1, p.corner[i].y);
    }
    if (outer) return {(x0 - slack - 1) >> 8, (y0 - slack - 1) >> 8, (x1 + slack) >> 8, (y1 + slack) >> 8};
    return {(x0 + slack + 255) >> 8, (y0 + slack + 255) >> 8, (x1 - slack - 256) >> 8, (y1 - slack - 256) >> 8};
}

SnappedPolygon snapped(ClipPolygon const& clip, ViewportTransform const& viewport) {
    SnappedPolygon p{};
    for (; p.count < clip.count; ++p.count)
        p.corner[static_cast<std::size_t>(p.count)] = snap(clip.corner[static_cast<std::size_t>(p.count)], viewport);
    for (; p.count != 0 && p.count < 3; ++p.count)  // A point or a segment that the clipper left is a triangle too.
        p.corner[static_cast<std::size_t>(p.count)] = p.corner[static_cast<std::size_t>(p.count - 1)];
    return p;
}

SnappedTriangle fan_triangle(SnappedPolygon const& p, int k) {
    auto const i = static_cast<std::size_t>(k);
    return {p.corner[0], p.corner[i + 1], p.corner[i + 2]};
}

/// The sum of the fan's doubled areas, which is the polygon's.
std::int64_t fan_area(SnappedPolygon const& p) {
    std::int64_t area = 0;
    for (int k = 0; k + 2 < p.count; ++k) area += doubled_area(fan_triangle(p, k));
    return area;
}

/// A line that a covered square lies to the inner side of.
struct Side {
    double x, y, dx, dy, spread;
    [[nodiscard]] bool covers(double px, double py) const { return dx * (py - y) - dy * (px - x) - spread >= 0.0; }
};

Side side_of(SnappedVertex const& a, SnappedVertex const& b, double reach) {
    double const dx = static_cast<double>(b.x) - a.x;
    double const dy = static_cast<double>(b.y) - a.y;
    return {static_cast<double>(a.x), static_cast<double>(a.y), dx, dy, (magnitude(dx) + magnitude(dy)) * reach};
}

/// The sides of a polygon whose area is positive, and the triangles of its fan.
struct PreparedPolygon {
    Side side[10];
    PixelTriangle fan[8];
    int count;

    PreparedPolygon(SnappedPolygon const& p, std::int32_t slack, double sign) : count(p.count) {
        bool const turned = fan_area(p) < 0;
        for (int i = 0; i < count; ++i) {
            SnappedVertex const& a = p.corner[static_cast<std::size_t>(i)];
            SnappedVertex const& b = p.corner[static_cast<std::size_t>(i + 1 == count ? 0 : i + 1)];
            side[i] = turned ? side_of(b, a, 128.0 + slack) : side_of(a, b, 128.0 + slack);
        }
        for (int k = 0; k + 2 < count; ++k) fan[k] = make_pixel_triangle(fan_triangle(p, k), slack, sign);
    }
    [[nodiscard]] bool covers(double x, double y) const {
        bool inside = true;
        for (int i = 0; i < count; ++i) inside = inside && side[i].covers(x, y);
        return inside;
    }
    /// The least depth over the fan's part in the square; returns false where it has none.
    [[nodiscard]] bool bound(double x, double y, double& least) const {
        bool any = false;
        for (int k = 0; k + 2 < count; ++k) {
            PixelTriangle const& t = fan[k];
            EdgeValues const at = edges_at(t, x, y);
            auto const apart = [&](double const(&v)[3], double centre) {
                return lesser(lesser(v[0], v[1]), v[2]) > centre + t.reach ||
                       greater(greater(v[0], v[1]), v[2]) < centre - t.reach;
            };
            if (apart(t.x, x) || apart(t.y, y) || !edges_touch(t, at)) continue;
            double const here = lower_bound(t, at, x, y);
            least = any ? lesser(least, here) : here;
            any = true;
        }
        return any;
    }
};

float& held_at(TileJob const& job, std::int32_t x, std::int32_t y) {
    return job.depth[std::ptrdiff_t{y - job.y0} * tile_pitch + (x - job.x0)];
}

PixelBounds within(ConservativeRecord const& r, TileJob const& job) {
    return {std::max<std::int32_t>(r.min_x, job.x0), std::max<std::int32_t>(r.min_y, job.y0),
            std::min<std::int32_t>(r.max_x, job.x1 - 1), std::min<std::int32_t>(r.max_y, job.y1 - 1)};
}

/// Pixels from the first on, in one row, whose edge function, with an integer `spread`, is at least 0.
///
/// The quotient of two integers below 2^53 is off by less than its last place, so its floor is off by one at most.
void cut_row(double at, double step, std::int32_t& first, std::int32_t& last) {
    if (step == 0.0) {
        if (at < 0.0) last = first - 1;
        return;
    }
    double const zero = -at / step;
    double const limited = zero < -1.0 ? -1.0 : zero > 32768.0 ? 32768.0 : zero;
    auto k = static_cast<std::int32_t>(limited);
    if (step > 0.0) {
        while (at + step * k < 0.0 && k < 32768) ++k;
        while (k > 0 && at + step * (k - 1) >= 0.0) --k;
        first = std::max(first, k);
    } else {
        while (at + step * k < 0.0 && k >= 0) --k;
        while (k < 32768 && at + step * (k + 1) >= 0.0) ++k;
        last = std::min(last, k);
    }
}

constexpr std::int32_t narrow = 6;  // Steps up to which trying each pixel costs less than divisions.

/// The run of steps for which `test` holds at the edge functions there.
template <class Test>
PixelSpan stepped_span(PixelTriangle const& t, EdgeValues at, std::int32_t last, Test const& test) {
    PixelSpan s{0, -1};
    bool any = false;
    for (std::int32_t k = 0; k <= last; ++k) {
        bool const hit = test(at);
        s.first = hit && !any ? k : s.first;
        s.last = hit ? k : s.last;
        any = any || hit;
        for (int i = 0; i < 3; ++i) at.e[i] -= t.dy[i] * 256.0;
    }
    return s;
}

PixelSpan touched_span(PixelTriangle const& t, EdgeValues const& at, std::int32_t last) {
    if (last <= narrow) return stepped_span(t, at, last, [&t](EdgeValues const& e) { return edges_touch(t, e); });
    PixelSpan s{0, last};
    for (int i = 0; i < 3; ++i) {
        cut_row(at.e[i] + t.spread[i], -256.0 * t.dy[i], s.first, s.last);
        if (t.area == 0.0) cut_row(t.spread[i] - at.e[i], 256.0 * t.dy[i], s.first, s.last);
    }
    return s;
}

/// {0, -1} where there is none.
PixelSpan covered_span(PixelTriangle const& t, EdgeValues const& at, std::int32_t last) {
    if (last <= narrow) return stepped_span(t, at, last, [&t](EdgeValues const& e) { return edges_cover(t, e); });
    PixelSpan s{0, t.area > 0.0 ? last : -1};
    for (int i = 0; i < 3; ++i) cut_row(at.e[i] - t.spread[i], -256.0 * t.dy[i], s.first, s.last);
    return s.first <= s.last ? s : PixelSpan{0, -1};
}

}  // namespace

ConservativeRules::ConservativeRules(ConservativeConfig const& config, Plan const& plan)
    : config_(config),
      plan_(plan),
      quantize_(plan.layers[0].layer->target.is_unorm16()),
      sign_((config.bound == Bound::nearest) == (config.depth == math::Depth::forward) ? 1.0 : -1.0),
      keeps_least_((config.keep == Bound::nearest) == (config.depth == math::Depth::forward)) {
    stats_.triangles = plan.stats[0].triangles;
    stats_.outside = plan.stats[0].outside;
}

void ConservativeRules::add(ConservativeStats const& counts) {
    stats_.bad_index += counts.bad_index;
    stats_.not_finite += counts.not_finite;
    stats_.outside += counts.outside;
    stats_.culled += counts.culled;
    stats_.no_pixel += counts.no_pixel;
    stats_.drawn += counts.drawn;
    stats_.clipped += counts.clipped;
}

void ConservativeRules::set_up(std::size_t begin, std::size_t end, Chunk& chunk) const {
    Item const* const items = plan_.items.data();
    Item const* const after = std::upper_bound(items, items + plan_.item_count, begin,
                                               [](std::size_t i, Item const& d) { return i < d.first_triangle; });
    for (Item const* item = after - 1; begin < end; ++item)
        for (; begin < std::min(end, item->first_triangle + item->triangles); ++begin)
            set_up_triangle(*item, begin - item->first_triangle, chunk);
}

void ConservativeRules::set_up_triangle(Item const& item, std::size_t triangle, Chunk& chunk) const {
    std::uint32_t index[3];
    if (!triangle_indices(item.setup, triangle, index)) {
        ++chunk.counts.bad_index;
        return;
    }
    ViewportTransform const& viewport = plan_.layers[0].viewport;
    std::array<math::vec4, 3> clip;
    std::uint32_t any = 0;
    std::uint32_t all = ~0U;
    for (std::size_t i = 0; i < 3; ++i) {
        float position[3];
        read_position(item.vertex, index[i], position);
        Clip4 const c = to_clip(item.vertex, position);
        clip[i] = math::vec4(c.x, c.y, c.z, c.w);
        std::uint32_t const code = outcode(clip[i], viewport);
        any |= code;
        all &= code;
    }
    if ((any & code_not_finite) != 0) {
        ++chunk.counts.not_finite;
    } else if (all != 0) {
        ++chunk.counts.outside;
    } else if (any != 0) {
        ++chunk.counts.clipped;
        add_polygon(snapped(clip_triangle(clip, viewport), viewport), item, chunk);
    } else {
        SnappedPolygon corners{};
        for (; corners.count < 3; ++corners.count)
            corners.corner[static_cast<std::size_t>(corners.count)] =
                snap(clip[static_cast<std::size_t>(corners.count)], viewport);
        add_polygon(corners, item, chunk);
    }
}

/// With slack s the doubled area of n corners is unsure by s (sum of |dx| + |dy| over the edges) + 8 s^2 (n - 2).
bool ConservativeRules::is_culled(SnappedPolygon const& p, Facing facing) const {
    if (facing == Facing::any) return false;
    std::int64_t const slack = config_.slack;
    std::int64_t around = 0;
    for (int i = 0; slack != 0 && i < p.count; ++i) {
        SnappedVertex const& a = p.corner[static_cast<std::size_t>(i)];
        SnappedVertex const& b = p.corner[static_cast<std::size_t>(i + 1 == p.count ? 0 : i + 1)];
        around += std::abs(std::int64_t{b.x} - a.x) + std::abs(std::int64_t{b.y} - a.y);
    }
    std::int64_t const unsure = slack * around + 8 * slack * slack * (p.count - 2);
    std::int64_t const area = fan_area(p);
    return facing == Facing::positive_only ? area < -unsure : area > unsure;
}

void ConservativeRules::add_polygon(SnappedPolygon const& p, Item const& item, Chunk& chunk) const {
    bool const outer = config_.coverage == Coverage::outer;
    if (p.count == 0) {
        ++chunk.counts.outside;
        return;
    }
    if (is_culled(p, item.setup.facing)) {
        ++chunk.counts.culled;
        return;
    }
    PixelBounds b = bounds_of(p, outer, config_.slack);
    if (!outer && (b.is_empty() || fan_area(p) == 0 || item.setup.tag != 0)) {
        ++chunk.counts.no_pixel;
        return;
    }
    SetupJob const& job = item.setup;
    b = {std::max(b.min_x, job.x0), std::max(b.min_y, job.y0), std::min(b.max_x, job.x1 - 1),
         std::min(b.max_y, job.y1 - 1)};
    if (b.is_empty()) {
        ++chunk.counts.outside;
        return;
    }
    ++chunk.counts.drawn;
    ConservativeRecord& r = chunk.add_record();
    r = {{p.corner[0], p.corner[1], p.corner[2]}, static_cast<std::uint16_t>(b.min_x),
         static_cast<std::uint16_t>(b.min_y),     static_cast<std::uint16_t>(b.max_x),
         static_cast<std::uint16_t>(b.max_y),     0};
    if (p.count == 3) return;
    chunk.add_extra() = p;
    r.polygon = static_cast<std::uint32_t>(chunk.extra_size);
}

float ConservativeRules::stored_code(double depth) const {
    double const scaled = depth * 65535.0;  // Exact: 24 bits by 16.
    auto const code = static_cast<std::int32_t>(scaled);
    return static_cast<float>(sign_ > 0.0 || static_cast<double>(code) == scaled ? code : code + 1);
}

/// What no pixel of the triangle gets anything better than.
float ConservativeRules::best_of(SnappedTriangle const& t) const {
    float const least = std::min({t[0].z, t[1].z, t[2].z});
    float const most = std::max({t[0].z, t[1].z, t[2].z});
    return stored(sign_ * static_cast<double>(keeps_least_ ? least : most));
}

/// Whether `best` improves any of the row: most hidden triangles end here.
bool ConservativeRules::improves_any(float best, float const* held, std::int32_t count) const {
    int any = 0;
    if (keeps_least_)
        for (std::int32_t k = 0; k < count; ++k) any |= best < held[k] ? 1 : 0;
    else
        for (std::int32_t k = 0; k < count; ++k) any |= best > held[k] ? 1 : 0;
    return any != 0;
}

std::uint64_t ConservativeRules::draw_triangle(TileJob const& job, Record const& record) const {
    PixelBounds b = within(record, job);
    std::int32_t const last = b.max_x - b.min_x;
    float const best = best_of(record.corner);
    while (b.min_y <= b.max_y && !improves_any(best, &held_at(job, b.min_x, b.min_y), last + 1)) ++b.min_y;
    if (b.min_y > b.max_y) return 0;
    PixelTriangle const t = make_pixel_triangle(record.corner, config_.slack, sign_);
    Row row{&t, nullptr, b.min_x, 0.0, best, {}};
    std::uint64_t written = 0;
    for (std::int32_t y = b.min_y; y <= b.max_y; ++y) {
        row.held = &held_at(job, b.min_x, y);
        if (!improves_any(best, row.held, last + 1)) continue;
        row.y = square_centre(y);
        row.at = edges_at(t, square_centre(b.min_x), row.y);
        PixelSpan const covered = covered_span(t, row.at, last);
        if (config_.coverage == Coverage::outer) {
            PixelSpan const touched = touched_span(t, row.at, last);
            bool const split = covered.first <= covered.last;
            written += draw_touched(row, {touched.first, split ? covered.first - 1 : touched.last});
            if (split) written += draw_touched(row, {covered.last + 1, touched.last});
        }
        written += draw_covered(row, covered);
    }
    return written;
}

std::uint64_t ConservativeRules::draw_touched(Row const& row, PixelSpan const& span) const {
    std::uint64_t written = 0;
    for (std::int32_t k = span.first; k <= span.last; ++k) {
        float& held = row.held[k];
        if (!improves(row.best, held)) continue;
        EdgeValues at = row.at;
        for (int i = 0; i < 3; ++i) at.e[i] -= row.t->dy[i] * (256.0 * k);
        float const depth = stored(lower_bound(*row.t, at, square_centre(row.x + k), row.y));
        if (!improves(depth, held)) continue;
        held = depth;
        ++written;
    }
    return written;
}

/// The same where the whole square is inside: its least depth is at the plane's least corner.
std::uint64_t ConservativeRules::draw_covered(Row const& row, PixelSpan const& span) const {
    PixelTriangle const& t = *row.t;
    EdgeValues const start = moved(row.at, t.to_least);
    double const size = greater(magnitude(t.least), magnitude(t.most));
    std::uint64_t written = 0;
    for (std::int32_t k = span.first; k <= span.last; ++k) {
        EdgeValues const at{{start.e[0] - t.dy[0] * (256.0 * k), 0.0, start.e[2] - t.dy[2] * (256.0 * k)}};
        float const depth = stored(greater(rounded_down(plane_at(t, at), size), t.least));
        bool const better = improves(depth, row.held[k]);
        row.held[k] = better ? depth : row.held[k];
        written += better ? 1 : 0;
    }
    return written;
}

std::uint64_t ConservativeRules::draw_polygon(TileJob const& job, Record const& record,
                                              SnappedPolygon const& polygon) const {
    PreparedPolygon const p(polygon, config_.slack, sign_);
    PixelBounds const b = within(record, job);
    std::uint64_t written = 0;
    for (std::int32_t y = b.min_y; y <= b.max_y; ++y)
        for (std::int32_t x = b.min_x; x <= b.max_x; ++x) {
            double const cx = square_centre(x);
            double const cy = square_centre(y);
            if (config_.coverage == Coverage::inner && !p.covers(cx, cy)) continue;
            double bound = 0.0;
            if (!p.bound(cx, cy, bound)) continue;
            float& held = held_at(job, x, y);
            float const depth = stored(bound);
            if (!improves(depth, held)) continue;
            held = depth;
            ++written;
        }
    return written;
}

template <class ForEach>
std::uint64_t ConservativeRules::draw(TileRect const& tile, bool first_batch, ForEach const& for_each) const {
    alignas(64) float depth[tile_size * tile_pitch];
    alignas(64) float farthest[blocks_per_tile];
    // Cleared to what is never kept: the far end of depths, or the near end.
    TileJob const job{.x0 = tile.x0,
                      .y0 = tile.y0,
                      .x1 = tile.x1,
                      .y1 = tile.y1,
                      .depth = depth,
                      .id = nullptr,
                      .farthest = farthest,
                      .blocked = false,
                      .reversed = !keeps_least_,
                      .quantize = quantize_,
                      .clamp = true,
                      .masked_context = nullptr,
                      .masked = nullptr};
    load_tile(plan_.layers[0], job, first_batch ? config_.load : Load::keep);
    std::uint64_t written = 0;
    for_each([&](Record const& record, Chunk const& chunk) {
        written += record.polygon == 0 ? draw_triangle(job, record)
                                       : draw_polygon(job, record, chunk.extras.data()[record.polygon - 1]);
    });
    store_tile(plan_.layers[0], job);
    return written;
}

}  // namespace gnomon::raster::detail

namespace gnomon::raster {

ConservativeStats conservative_pass(std::span<Draw const> draws, DepthTarget const& target,
                                    ConservativeConfig const& config, TileWorkspace& workspace,
                                    core::ExecutorRef executor) {
    GNOMON_EXPECT(config.slack >= 0 && config.slack <= max_slack);
    TileWorkspace::State& state = workspace.state();
    Layer const layer{.target = target,
                      .config = {.depth = config.depth,
                                 .range = config.range,
                                 .load = config.load,
                                 .viewport = config.viewport,
                                 .scissor = config.scissor}};
    detail::make_plan(state.plan, draws, {&layer, 1}, true, executor);
    detail::LayerPlan const& plan = state.plan.layers[0];
    detail::ConservativeRules rules(config, state.plan);
    if (plan.is_empty()) return rules.stats();
    detail::TiledArea const area{plan.x0, plan.y0, plan.x1, plan.y1, plan.grid};
    std::uint64_t const written =
        detail::TiledPass(rules, state.conservative, area, executor).run(state.plan.triangles);
    ConservativeStats stats = rules.stats();
    stats.pixels_written = written;
    return stats;
}

}  // namespace gnomon::raster
