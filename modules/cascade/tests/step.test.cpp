#include <gnomon/cascade/cascades.hpp>
#include <gnomon/cascade/guard.hpp>
#include <gnomon/cascade/step.hpp>
#include <gnomon/cascade/view.hpp>
#include <gnomon/check/allocations.hpp>
#include <gnomon/check/check.hpp>

#include <array>
#include <cmath>
#include <cstdint>

GNOMON_COUNT_ALLOCATIONS;

namespace {

namespace stepping {

using namespace gnomon;
using namespace gnomon::check;
using cascade::Action;
using cascade::ExposedRects;
using cascade::Place;
using cascade::QuadVertex;
using cascade::Reason;
using cascade::Volume;

TEST_CASE("exposed strips are the texels that the old map did not show, each once", "[step]") {
    for_all(cases(2000), integers(1, 20), integers(-25, 25), integers(-25, 25), [](int size, int dx, int dy) {
        ExposedRects const exposed = cascade::exposed_by({dx, dy, 0}, size);
        int wrong = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                int covered = 0;
                for (int i = 0; i < exposed.count; ++i) {
                    auto const& r = exposed.rects[static_cast<std::size_t>(i)];
                    covered += x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height ? 1 : 0;
                }
                bool const seen = x + dx >= 0 && x + dx < size && y + dy >= 0 && y + dy < size;
                wrong += covered == (seen ? 0 : 1) ? 0 : 1;
            }
        CHECK(wrong == 0);
        for (int i = 0; i < exposed.count; ++i) {
            auto const& r = exposed.rects[static_cast<std::size_t>(i)];
            CHECK((r.x >= 0 && r.y >= 0 && r.x + r.width <= size && r.y + r.height <= size));
            CHECK((r.width > 0 || r.height == 0 || size == 1));
        }
    });
}

/// What a rasterizer does with the quad: two triangles (0 1 2, 2 1 3), its old texel at a pixel's centre.
struct Source {
    std::int64_t x, y;
};

Source source_by_quad(std::array<QuadVertex, 4> const& q, int size, int x, int y) {
    double const px = (x + 0.5) / size;
    double const py = (y + 0.5) / size;
    bool const upper = px + py <= 1.0;
    auto const at = [&](auto const& value) {
        return upper
                   ? value(q[0]) + px * (value(q[2]) - value(q[0])) + py * (value(q[1]) - value(q[0]))
                   : value(q[3]) + (1.0 - px) * (value(q[1]) - value(q[3])) + (1.0 - py) * (value(q[2]) - value(q[3]));
    };
    double const u = at([](QuadVertex const& v) { return static_cast<double>(v.u); });
    double const v = at([](QuadVertex const& w) { return static_cast<double>(w.v); });
    return {static_cast<std::int64_t>(std::floor(u * size)), static_cast<std::int64_t>(std::floor(v * size))};
}

int wrong_sources(std::array<QuadVertex, 4> const& quad, int size, Place const& shift) {
    int wrong = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            Source const s = source_by_quad(quad, size, x, y);
            wrong += s.x == x + shift.x && s.y == y + shift.y ? 0 : 1;
        }
    return wrong;
}

TEST_CASE("the listing's quad reads the shifted texel at every pixel; as printed, with u0 for u1, it does not",
          "[step][mutation]") {
    for (int const size : {64, 60}) {
        for (Place const& shift : {Place{3, -5, 7}, Place{-1, 0, -2}, Place{17, 59, 0}}) {
            Volume const v{{}, size, cascade::unorm16_codes, 1.0, 1.0};
            auto quad = cascade::quad_of(shift, v, false);
            CHECK(wrong_sources(quad, size, shift) == 0);
            CHECK(std::abs(static_cast<double>(quad[0].depth) * 65535.0 + static_cast<double>(shift.z)) < 1e-2);
            CHECK(cascade::quad_of(shift, v, true)[3].depth == -quad[3].depth);
            quad[2].u = quad[0].u;
            CHECK(wrong_sources(quad, size, shift) > size);
        }
    }
}

/// How far, in codes, a texel is from where a new drawing puts it, after the volume has moved by `units`.
double drift_after(Volume const& v, std::int64_t units, double unit_m) {
    double const range_m = static_cast<double>(v.codes) * v.depth_unit_m;
    double const moved_m = static_cast<double>(units) * unit_m;
    return std::abs(moved_m / range_m * static_cast<double>(v.codes) - static_cast<double>(units));
}

TEST_CASE("a depth unit is one code, however far the map moves; 2^-16 of the range drifts by half a code",
          "[step][mutation]") {
    cascade::CascadeConfig config;
    config.splits.far_m = 100.0;
    auto const camera = math::make_perspective({.size_px = {640, 480}}).value();
    auto const frame = cascade::plan(cascade::Cascades{}, config, camera).value();
    Volume const& v = frame.cascades[0].volume;
    math::View const view = cascade::view_of(frame, 0, math::Depth::forward);
    double const range_m = view.far_m - view.near_m;
    CHECK(std::abs(range_m - 1000.0) < 1e-9);
    CHECK(drift_after(v, 32768, v.depth_unit_m) < 1e-9);
    CHECK(drift_after(v, 32768, range_m * 0x1p-16) > 0.49);
}

TEST_CASE("a frame's plan allocates nothing", "[cascades]") {
    cascade::CascadeConfig config;
    config.splits.far_m = 100.0;
    auto camera = math::make_perspective({.size_px = {640, 480}}).value();
    cascade::Cascades state;
    auto const before = allocations_made();
    std::int64_t moved = 0;
    for (int i = 0; i < 100; ++i) {
        camera.eye_m.x = 0.3 * i;
        auto const frame = cascade::plan(state, config, camera);
        if (!frame) continue;
        moved += frame->cascades[0].update.shift.x;
        cascade::commit(state, *frame);
    }
    CHECK(allocations_made() == before);
    CHECK(moved != 0);
}

TEST_CASE("the guard band's figures are those of maps that move", "[guard]") {
    for (std::int32_t const guard : {0, 3, 15, 31}) {
        cascade::FitConfig config;
        config.guard_px = guard;
        auto const figures = cascade::guard_trade_off(config, 1.0);
        // At whole texels a frame, simulated; at the speed that the larger texel leaves, in proportion.
        std::int64_t held = 0;
        bool any = false;
        int scrolls = 0;
        std::int64_t filled = 0;
        int const frames = 32 * 33;
        for (int i = 0; i <= frames; ++i) {
            std::int64_t const at = cascade::guarded(any ? &held : nullptr, i, guard);
            scrolls += any && at != held ? 1 : 0;
            filled += any ? at - held : 0;
            any = true;
            held = at;
        }
        double const measured = static_cast<double>(scrolls) / frames;
        CHECK(std::abs(measured / figures.texel_growth - figures.scrolls_per_frame) < 0.002);
        CHECK(std::abs(static_cast<double>(filled) / frames / figures.texel_growth * 512.0 - figures.texels_filled) <
              512.0 * 0.04);
        CHECK(std::abs(figures.texel_growth - 506.0 / (506.0 - 2.0 * guard)) < 1e-12);
        CHECK(std::abs(figures.draws_per_texel - 1.0 / (guard + 1)) < 1e-12);
    }
    CHECK(cascade::guard_trade_off({}, 0.0).scrolls_per_frame == 0.0);
    CHECK(cascade::guard_trade_off({}, 1e9).scrolls_per_frame == 1.0);
}

}  // namespace stepping

}  // namespace
