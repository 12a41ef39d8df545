#include <gnomon/check/check.hpp>
#include <gnomon/cluster/bounds.hpp>
#include <gnomon/cluster/grid.hpp>
#include <gnomon/math/generators.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

using namespace gnomon;
using cluster::Grid;

struct GridCase {
    math::View view;
    math::ivec2 tile_px{32, 32};
    Grid grid;
};

std::string check_string(GridCase const& c) {
    return check_string(c.view) + ", tiles of " + std::to_string(c.tile_px.x) + "x" + std::to_string(c.tile_px.y);
}

cluster::DepthSlices slices_of(math::View const& view, std::uint32_t count) {
    if (view.lens == math::Lens::orthographic)
        return cluster::make_slices(cluster::UniformSlices{view.near_m, view.far_m, count, false}).value();
    bool const infinite = !math::is_finite(view.far_m);
    double const far_m = infinite ? view.near_m * 1000.0 : view.far_m;
    return cluster::make_slices(cluster::FirstThenExponentialSlices{view.near_m, view.near_m * 1.25, far_m, count + 1, infinite}).value();
}

auto grid_cases() {
    return [](check::Choices& choices) {
        math::View view = math::views()(choices);
        double const jitter_x = check::floats(-0.5, 0.5)(choices);
        double const jitter_y = check::floats(-0.5, 0.5)(choices);
        view = math::jittered(view, math::dvec2(jitter_x, jitter_y));
        int const tile_x = check::element_of({1, 8, 16, 32, 72, 128, 999})(choices);
        int const tile_y = check::element_of({1, 8, 16, 32, 72, 128, 999})(choices);
        auto const count = static_cast<std::uint32_t>(check::integers(1, 64)(choices));
        math::ivec2 const tile_px(tile_x, tile_y);
        return GridCase{view, tile_px, cluster::make_grid(view, tile_px, slices_of(view, count)).value()};
    };
}

/// A depth in the grid: within a slice, on a plane, or one float off it.
float depth_in(Grid const& grid, check::Choices& choices) {
    auto const planes = grid.slices().planes_m();
    auto const k = static_cast<std::size_t>(choices.draw(grid.slices().count() - 1));
    float const hi = std::isinf(planes[k + 1]) ? planes[k] * 8.0F : planes[k + 1];
    switch (choices.draw(3)) {
        case 0: return planes[k];
        case 1: return math::next_up(planes[k]);
        case 2: return math::next_down(hi);
        default: return std::clamp(planes[k] + (hi - planes[k]) * check::floats(0.0F, 1.0F)(choices), planes[k], hi);
    }
}

struct ImagePoint {
    math::uvec2 pixel;
    math::vec2 px;
    float depth_m;
};

/// A pixel near a tile's border or anywhere, and a point in it; `edge` asks for its closed border.
ImagePoint point_in(GridCase const& c, check::Choices& choices, bool edge) {
    auto const coordinate = [&](int size, int tile) {
        int const tiles = (size - 1) / tile;
        int const border = static_cast<int>(choices.draw(static_cast<std::uint64_t>(tiles))) * tile - static_cast<int>(choices.draw(1));
        int const any = static_cast<int>(choices.draw(static_cast<std::uint64_t>(size) - 1));
        return choices.draw(1) != 0 ? any : std::clamp(border, 0, size - 1);
    };
    auto const within = [&](int pixel) {
        float const part = edge ? (choices.draw(1) != 0 ? 1.0F : 0.0F) : check::element_of({0.5F, 0.0625F, 0.9375F, 0.125F})(choices);
        return static_cast<float>(pixel) + part;
    };
    int const x = coordinate(c.view.size_px.x, c.tile_px.x);
    int const y = coordinate(c.view.size_px.y, c.tile_px.y);
    float const u = within(x);
    float const v = within(y);
    float const depth = depth_in(c.grid, choices);
    return {math::uvec2(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)), math::vec2(u, v), depth};
}

/// How far a point is outside of its cluster along x or y: exact products, one rounded difference.
double outside_by(cluster::GridView const& g, cluster::ClusterCoordinates const& at, math::vec3 const& p) {
    double const s = g.perspective ? static_cast<double>(p.z) : 1.0;
    auto const past = [&](std::span<float const> b, std::uint32_t i, float q) {
        double const x = static_cast<double>(q);
        return std::max(static_cast<double>(b[i]) * s - x, x - static_cast<double>(b[i + 1]) * s);
    };
    return std::max(past(g.x, at.column, p.x), past(g.y, at.row, p.y));
}

math::View wide_view() {
    math::PerspectiveConfig config;
    config.size_px = {1920, 1080};
    config.far_m = 100.0;
    return math::make_perspective(config).value();
}

}  // namespace

TEST_CASE("a sample of any pixel lies in the hexahedron of its own key, with nothing added", "[cluster][property]") {
    auto const samples = check::bind(grid_cases(), [](GridCase const& c) {
        return [c](check::Choices& choices) { return std::pair{c, point_in(c, choices, false)}; };
    });
    check::for_all(check::cases(20000), samples, [](auto const& sample) {
        auto const& [c, at] = sample;
        auto const key = coordinates_at(c.grid, at.pixel, at.depth_m);
        math::vec3 const p = position_at(c.grid, at.px, at.depth_m);
        CHECK(p.z == at.depth_m);
        CHECK(contains(c.grid.view(), key, p));
        CHECK(coordinates_of(c.grid.view(), cluster_at(c.grid, at.pixel, at.depth_m)) == key);
        using Uint = formula::Uint<float>;
        CHECK(gn_cluster_at(c.grid.table(), formula::Words{c.grid.slices().words().data()}, Uint(at.pixel.x), Uint(at.pixel.y),
                            formula::Float<float>(at.depth_m)).v == cluster_at(c.grid, at.pixel, at.depth_m));
        CHECK(c.grid.view().index(key.column, key.row, key.slice) == cluster_at(c.grid, at.pixel, at.depth_m));
    });
}

TEST_CASE("keys and bounds agree for every depth within 64 floats of every plane", "[cluster]") {
    math::PerspectiveConfig config;
    config.size_px = {400, 300};
    for (double const near_m : {0.1, 0.05, 1.0, 1e-3}) {
        config.near_m = near_m;
        auto const view = math::make_perspective(config).value();
        auto const grid = cluster::make_grid(view, math::ivec2(32, 32), cluster::make_cubical_slices(view, 32, 5000.0 * near_m).value()).value();
        auto const g = grid.view();
        std::uint32_t wrong = 0;
        for (float const plane : g.depth_m.first(g.slices())) {
            float depth = plane;
            for (int i = 0; i < 64; ++i) depth = math::next_down(depth);
            for (int i = -64; i <= 64; ++i, depth = math::next_up(depth)) {
                if (depth < g.depth_m[0]) continue;
                math::uvec2 const pixel(static_cast<std::uint32_t>(200 + i), static_cast<std::uint32_t>(150 - i));
                math::vec2 const centre(static_cast<float>(pixel.x) + 0.5F, static_cast<float>(pixel.y) + 0.5F);
                auto const c = coordinates_at(grid, pixel, depth);
                math::vec3 const p = position_at(grid, centre, depth);
                wrong += contains(g, c, p) && contains(implicit_bounds(g, c), p) ? 0U : 1U;
            }
        }
        CHECK(wrong == 0);
        CHECK(g.slices() > 60);
    }
}

TEST_CASE("a point on the border of a pixel is outside of its hexahedron by no more than the stated slack", "[cluster][property]") {
    auto const samples = check::bind(grid_cases(), [](GridCase const& c) {
        return [c](check::Choices& choices) { return std::pair{c, point_in(c, choices, true)}; };
    });
    int outside = 0;
    check::for_all(check::cases(20000), samples, [&](auto const& sample) {
        auto const& [c, at] = sample;
        double const past = outside_by(c.grid.view(), coordinates_at(c.grid, at.pixel, at.depth_m), position_at(c.grid, at.px, at.depth_m));
        outside += past > 0.0 ? 1 : 0;
        CHECK(past <= c.grid.border_slack_m(at.depth_m));
        CHECK(c.grid.border_px() <= 0.0625);
    });
    CHECK(outside > 50);  // so the slack is needed there, and the test above is not about nothing
}

TEST_CASE("planes lie where the view's own rays go, the last column's at its tile's full border", "[cluster][property]") {
    check::for_all(check::cases(2000), grid_cases(), [](GridCase const& c) {
        auto const g = c.grid.view();
        CHECK(std::is_sorted(g.x.begin(), g.x.end()));
        CHECK(std::adjacent_find(g.x.begin(), g.x.end()) == g.x.end());
        CHECK(std::adjacent_find(g.y.begin(), g.y.end()) == g.y.end());
        for (std::uint32_t i = 0; i <= g.columns(); i += std::max(1U, g.columns())) {
            math::PixelRay const ray = math::pixel_ray(c.view, math::dvec2(static_cast<double>(i) * c.tile_px.x, 0.0));
            double const x = glm::dot(c.view.right, ray.start_m + ray.step);
            CHECK(std::abs(static_cast<double>(g.x[i]) - x) <= c.grid.border_slack_m(1.0F) + 1e-12 * std::abs(x));
        }
        for (std::uint32_t j = 0; j <= g.rows(); j += std::max(1U, g.rows())) {
            math::PixelRay const ray = math::pixel_ray(c.view, math::dvec2(0.0, static_cast<double>(j) * c.tile_px.y));
            double const y = -glm::dot(c.view.up, ray.start_m + ray.step);
            CHECK(std::abs(static_cast<double>(g.y[j]) - y) <= c.grid.border_slack_m(1.0F) + 1e-12 * std::abs(y));
        }
        // Tiles cover the image, and one fewer would not.
        CHECK(static_cast<int>(g.columns()) * c.tile_px.x >= c.view.size_px.x);
        CHECK(static_cast<int>(g.columns() - 1) * c.tile_px.x < c.view.size_px.x);
    });
}

TEST_CASE("1920x1080 in tiles of 72 and 16 slices is the grid that others measure", "[cluster]") {
    auto slices = cluster::make_slices(cluster::FirstThenExponentialSlices{0.1, 5.0, 100.0, 16, false}).value();
    auto const grid = cluster::make_grid(wide_view(), math::ivec2(72, 72), std::move(slices)).value();
    auto const g = grid.view();
    CHECK(g.columns() == 27);
    CHECK(g.rows() == 15);
    CHECK(g.clusters() == 6480);
    double const half = std::tan(3.14159265358979323846 / 6.0) * 16.0 / 9.0;
    CHECK(std::abs(static_cast<double>(g.x[27]) - half * (1944.0 / 960.0 - 1.0)) < 1e-6);
    CHECK(grid.border_px() < 0.002);
    CHECK(grid.clusters() == 6480);
    CHECK(cluster_at(grid, math::uvec2(1919, 1079), 99.0F) == 6479);
    CHECK(cluster_at(grid, math::uvec2(1919, 1079), std::numeric_limits<float>::quiet_NaN()) == 404);
}

TEST_CASE("the formula's tiles are integer quotients, for every pixel, in lanes too", "[cluster]") {
    using Group = math::Lanes<float, 8>;
    for (std::uint32_t const tile : {1U, 2U, 3U, 7U, 16U, 31U, 72U, 100U, 127U, 4095U, 4097U, 65535U, 65536U}) {
        cluster::GridTable table{tile, tile, 1.0F / static_cast<float>(tile), 1.0F / static_cast<float>(tile), 65536, 65536, 1, 0, 0, 0, 0, {}};
        std::uint32_t wrong = 0;
        for (std::uint32_t x = 0; x < 65536; x += 8) {
            auto const q = gn_column_of(table, formula::Uint<Group>(math::Lanes<std::uint32_t, 8>::ramp(x, 1)));
            for (std::uint32_t lane = 0; lane < 8; ++lane) {
                wrong += q.v[lane] != (x + lane) / tile ? 1U : 0U;
                wrong += gn_row_of(table, formula::Uint<float>(x + lane)).v != (x + lane) / tile ? 1U : 0U;
            }
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("a position 1e7 m from the origin falls into the cluster of its pixel", "[cluster][property]") {
    math::PerspectiveConfig config;
    config.eye_m = {1e7, -1e7, 3e6};
    config.target_m = {1e7 + 3.0, -1e7 + 1.0, 3e6 - 5.0};
    config.size_px = {640, 360};
    auto const view = math::make_perspective(config).value();
    auto const grid = cluster::make_grid(view, math::ivec2(32, 32), cluster::make_cubical_slices(view, 32, 200.0).value()).value();
    CHECK(std::isinf(grid.view().depth_m.back()));
    check::for_all(check::integers(0, 639), check::integers(0, 359), check::floats(0.11, 190.0), [&](int x, int y, double depth) {
        math::PixelRay const ray = math::pixel_ray(view, math::dvec2(x + 0.5, y + 0.5));
        math::vec3 const p = cluster::culling_position(view, view.eye_m + ray.start_m + ray.step * depth);
        math::uvec2 const pixel(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
        CHECK(std::abs(static_cast<double>(p.z) - depth) < 1e-5);
        CHECK(contains(grid.view(), coordinates_at(grid, pixel, p.z), p));
    });
}

TEST_CASE("cubical slices are as deep as tiles are high, with perspective and without", "[cluster]") {
    auto const view = wide_view();
    auto const s = cluster::make_cubical_slices(view, 32, 50.0).value();
    float const tile = static_cast<float>(view.window.top - view.window.bottom) / 34.0F;
    CHECK(std::abs((s.planes_m()[11] - s.planes_m()[10]) / s.planes_m()[10] - tile) < 1e-5F);
    CHECK(std::isinf(s.planes_m().back()));
    math::OrthographicConfig box;
    box.window_m = {-16.0, 16.0, -9.0, 9.0};
    box.near_m = -5.0;
    box.far_m = 20.0;
    box.size_px = {640, 360};
    auto const flat = math::make_orthographic(box).value();
    auto const uniform = cluster::make_cubical_slices(flat, 20, 1e9).value();
    CHECK(uniform.count() == 25);
    CHECK(uniform.planes_m()[5] == 0.0F);
    auto const grid = cluster::make_grid(flat, math::ivec2(20, 20), uniform).value();
    CHECK_FALSE(grid.view().perspective);
    CHECK(grid.view().x[0] == -16.0F);
    CHECK(cluster_at(grid, math::uvec2(0, 0), -0.5F) == 4 * 32 * 18);
}

TEST_CASE("a grid that cannot be is refused with a sentence that names the value", "[cluster]") {
    using enum cluster::GridError;
    auto const slices = [](double near_m, double far_m, std::uint32_t count = 4) {
        return cluster::make_slices(cluster::UniformSlices{near_m, far_m, count, false}).value();
    };
    auto const code = [](math::View const& view, math::ivec2 tile, cluster::DepthSlices s) {
        auto const made = cluster::make_grid(view, tile, std::move(s));
        REQUIRE_FALSE(made.has_value());
        CHECK(made.failure().message.size() > 20);
        return made.failure().code;
    };
    math::View view = wide_view();
    math::ivec2 const tile(32, 32);
    CHECK(code(view, math::ivec2(0, 32), slices(0.1, 100.0)) == bad_tile);
    CHECK(code(view, math::ivec2(32, 65537), slices(0.1, 100.0)) == bad_tile);
    CHECK(code(view, tile, slices(0.2, 100.0)) == uncovered);
    CHECK(code(view, tile, slices(0.1, 99.0)) == uncovered);
    CHECK(code(view, tile, slices(0.0, 100.0)) == bad_depth);
    view.far_m = std::numeric_limits<double>::infinity();
    CHECK(code(view, tile, slices(0.1, 1000.0)) == uncovered);
    view.far_m = 100.0;
    CHECK(code(view, math::ivec2(1, 1), slices(0.1, 100.0, 4096)) == too_many);
    view.window = {1000.0, 1000.01, -1.0, 1.0};
    CHECK(code(view, tile, slices(0.1, 100.0)) == unresolved);
    view.window = {1.0, -1.0, -1.0, 1.0};
    CHECK(code(view, tile, slices(0.1, 100.0)) == bad_view);
    view.window = {std::numeric_limits<double>::quiet_NaN(), 1.0, -1.0, 1.0};
    CHECK(code(view, tile, slices(0.1, 100.0)) == bad_view);
    view = wide_view();
    view.size_px.y = 0;
    CHECK(code(view, tile, slices(0.1, 100.0)) == bad_view);
}
