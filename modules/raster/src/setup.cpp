// One triangle's way to its record, through the reference path: rejects, the clipper, the record.

#include "pieces.hpp"

#include <array>

namespace gnomon::raster::detail {

namespace {

enum class Fate : std::uint8_t { degenerate, culled, no_sample, outside, drawn };

/// Bounds in pixels, cut to the scissor rectangle.
Fate set_bounds(Oriented const& t, SetupJob const& job, Record& record) {
    auto const least = [](std::int32_t const(&v)[3]) {
        std::int32_t const m = v[0] < v[1] ? v[0] : v[1];
        return m < v[2] ? m : v[2];
    };
    auto const greatest = [](std::int32_t const(&v)[3]) {
        std::int32_t const m = v[0] > v[1] ? v[0] : v[1];
        return m > v[2] ? m : v[2];
    };
    std::int32_t min_x = first_pixel(least(t.x));
    std::int32_t min_y = first_pixel(least(t.y));
    std::int32_t max_x = last_pixel(greatest(t.x));
    std::int32_t max_y = last_pixel(greatest(t.y));
    if (min_x > max_x || min_y > max_y) return Fate::no_sample;
    min_x = min_x > job.x0 ? min_x : job.x0;
    min_y = min_y > job.y0 ? min_y : job.y0;
    max_x = max_x < job.x1 - 1 ? max_x : job.x1 - 1;
    max_y = max_y < job.y1 - 1 ? max_y : job.y1 - 1;
    if (min_x > max_x || min_y > max_y) return Fate::outside;
    record.min_x = static_cast<std::uint16_t>(min_x);
    record.min_y = static_cast<std::uint16_t>(min_y);
    record.max_x = static_cast<std::uint16_t>(max_x);
    record.max_y = static_cast<std::uint16_t>(max_y);
    return Fate::drawn;
}

void set_large(Oriented const& t, Record& record) {
    for (int i = 0; i < 3; ++i) {
        record.edge[i] = t.x[i];
        record.step_x[i] = t.y[i];
        record.step_y[i] = 0;
    }
    record.z0 = t.z[0];
    record.g1 = t.z[1];
    record.g2 = t.z[2];
}

/// Whether bounds of at most 2 x 2 samples hold none that is covered. Larger ones are left to the tiles.
bool covers_none(Record const& r) {
    int const columns = r.max_x - r.min_x;
    int const rows = r.max_y - r.min_y;
    if (columns > 1 || rows > 1) return false;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x) {
            std::int32_t signs = 0;
            for (int i = 0; i < 3; ++i) signs |= r.edge[i] + r.step_x[i] * x + r.step_y[i] * y;
            if (signs >= 0) return false;
        }
    return true;
}

Fate set_regular(Oriented const& t, Record& record) {
    std::int32_t fraction[3];
    for (int i = 0; i < 3; ++i) {
        ShiftedEdge const e = shifted_edge(t, i, record.min_x, record.min_y);
        record.edge[i] = static_cast<std::int32_t>(e.value);
        record.step_x[i] = e.step_x;
        record.step_y[i] = e.step_y;
        fraction[i] = e.fraction;
    }
    if (covers_none(record)) return Fate::no_sample;
    DepthGradient const g = depth_gradient(t, fraction[2], fraction[0]);
    record.z0 = static_cast<float>(g.z0);
    record.g1 = static_cast<float>(g.g1);
    record.g2 = static_cast<float>(g.g2);
    return Fate::drawn;
}

Fate make_record(SetupJob const& job, Corner const& a, Corner const& b, Corner const& c, Facing facing,
                 Record& record) {
    std::int64_t const area = area_of(a, b, c);
    if (area == 0) return Fate::degenerate;
    if ((facing == Facing::positive_only && area < 0) || (facing == Facing::negative_only && area > 0))
        return Fate::culled;
    Oriented const t = orient(a, b, c, area);
    Fate const fate = set_bounds(t, job, record);
    if (fate != Fate::drawn) return fate;
    bool const large = is_large(t);
    record.tag = job.tag | (large ? 1U : 0U);
    if (!large) return set_regular(t, record);
    set_large(t, record);
    return fate;
}

void count(Fate fate, SetupCounts& counts) {
    switch (fate) {
        case Fate::degenerate: ++counts.degenerate; break;
        case Fate::culled: ++counts.culled; break;
        case Fate::no_sample: ++counts.no_sample; break;
        case Fate::outside: ++counts.outside; break;
        case Fate::drawn: ++counts.drawn; break;
    }
}

struct Polygon {
    std::array<Corner, 10> corner;
    int count = 0;
    [[nodiscard]] Corner const& at(int i) const { return corner[static_cast<std::size_t>(i % count)]; }
};

/// Doubled area of the fan's triangle k from corner `apex`.
std::int64_t fan_area(Polygon const& p, int apex, int k) {
    return area_of(p.at(apex), p.at(apex + k + 1), p.at(apex + k + 2));
}

/// A corner from which no triangle of the fan is turned over: snapping may have dented the polygon. Else corner 0.
int choose_apex(Polygon const& p, bool positive) {
    for (int apex = 0; apex < p.count; ++apex) {
        bool even = true;
        for (int k = 0; k + 2 < p.count; ++k) {
            std::int64_t const area = fan_area(p, apex, k);
            even = even && (area == 0 || (area > 0) == positive);
        }
        if (even) return apex;
    }
    return 0;
}

Polygon clipped_polygon(SetupJob const& job, std::array<std::uint32_t, 3> const& index) {
    VertexJob const& vertex = *job.vertex;
    ViewportTransform const viewport{vertex.half_width, vertex.half_height, vertex.offset_x,  vertex.offset_y,
                                     vertex.guard_x,    vertex.guard_y,     vertex.clip_depth};
    std::array<math::vec4, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
        float position[3];
        __builtin_memcpy(position, vertex.positions + index[i] * vertex.stride, sizeof position);
        Clip4 const c = to_clip(vertex, position);
        corners[i] = math::vec4(c.x, c.y, c.z, c.w);
    }
    ClipPolygon const clip = clip_triangle(corners, viewport);
    Polygon polygon;
    for (int i = 0; i < clip.count; ++i) {
        math::vec4 const& c = clip.corner[static_cast<std::size_t>(i)];
        polygon.corner[static_cast<std::size_t>(polygon.count++)] =
            snap_of(Clip4{c.x, c.y, c.z, c.w}, viewport, viewport.half_width_px, viewport.half_height_px);
    }
    return polygon;
}

/// Cuts the triangle and draws what is left as a fan.
Fate clip_and_draw(SetupJob const& job, std::array<std::uint32_t, 3> const& index, std::uint32_t id, RecordSink& sink) {
    Polygon const polygon = clipped_polygon(job, index);
    if (polygon.count < 3) return Fate::outside;
    std::int64_t area = 0;
    for (int k = 0; k + 2 < polygon.count; ++k) area += fan_area(polygon, 0, k);
    if (area == 0) return Fate::degenerate;
    if ((job.facing == Facing::positive_only && area < 0) || (job.facing == Facing::negative_only && area > 0))
        return Fate::culled;
    int const apex = choose_apex(polygon, area > 0);
    Fate best = Fate::no_sample;
    for (int k = 0; k + 2 < polygon.count; ++k) {
        Record& record = *sink.room(1);
        Fate const fate =
            make_record(job, polygon.at(apex), polygon.at(apex + k + 1), polygon.at(apex + k + 2), Facing::any, record);
        if (fate == Fate::drawn) {
            record.id = id;
            ++sink.size;
            best = fate;
        } else if (fate == Fate::outside && best == Fate::no_sample) {
            best = fate;
        }
    }
    return best;
}

}  // namespace

void setup_one(SetupJob const& job, std::size_t triangle, RecordSink& sink, SetupCounts& counts) {
    std::array<std::uint32_t, 3> index{};
    for (std::size_t i = 0; i < 3; ++i) {
        std::size_t const at = triangle * 3 + i;
        index[i] = job.index32 != nullptr   ? job.index32[at]
                   : job.index16 != nullptr ? job.index16[at]
                                            : static_cast<std::uint32_t>(at);
        if (index[i] - job.first_corner >= job.corner_count) {
            ++counts.bad_index;
            return;
        }
    }
    Corner const& a = job.corners[index[0] - job.first_corner];
    Corner const& b = job.corners[index[1] - job.first_corner];
    Corner const& c = job.corners[index[2] - job.first_corner];
    std::uint32_t const any = (a.code | b.code | c.code) & outcode_bits;
    std::uint32_t const id = job.id_base + static_cast<std::uint32_t>(triangle);
    if ((any & code_not_finite) != 0) {
        ++counts.not_finite;
    } else if ((a.code & b.code & c.code & outcode_bits) != 0) {
        ++counts.outside;
    } else if (any != 0) {
        ++counts.clipped;
        count(clip_and_draw(job, index, id, sink), counts);
    } else {
        Record& record = *sink.room(1);
        Fate const fate = make_record(job, a, b, c, job.facing, record);
        if (fate == Fate::drawn) {
            record.id = id;
            ++sink.size;
        }
        count(fate, counts);
    }
}

}  // namespace gnomon::raster::detail
