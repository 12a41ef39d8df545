// Shows: an engine's own depth buffer under 4,096 lights: which of them each pixel has to evaluate, by cluster, and that none is missed.

#include <gnomon/cluster.hpp>
#include <gnomon/cull.hpp>
#include <gnomon/lights.hpp>
#include <gnomon/math.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

using namespace gnomon;

/// Depths in metres of a floor 1.7 m below the eye, a wall 60 m away, and pillars.
static std::vector<float> draw_hall(math::View const& view) {
    std::vector<float> depth_m;
    for (int y = 0; y < view.size_px.y; ++y)
        for (int x = 0; x < view.size_px.x; ++x) {
            math::dvec3 const step = math::pixel_ray(view, {x + 0.5, y + 0.5}).step;
            double depth = step.y < 0.0 ? std::min(60.0, -1.7 / step.y) : 60.0;
            for (int i = 0; i < 12; ++i) {
                double const pillar_m = 4.0 + 4.5 * i, left_m = (i % 2 == 0 ? -3.0 : 2.0);
                if (step.x * pillar_m > left_m && step.x * pillar_m < left_m + 1.0) depth = std::min(depth, pillar_m);
            }
            depth_m.push_back(static_cast<float>(depth));
        }
    return depth_m;
}

/// Lamps of 2 m, anywhere in the hall, by world position.
static std::vector<math::dvec3> hang_lamps(int count) {
    std::vector<math::dvec3> lamps;
    std::uint32_t state = 1;
    auto const unit = [&state] { return (state = state * 1664525U + 1013904223U) / 4294967296.0; };
    for (int i = 0; i < count; ++i) lamps.push_back({unit() * 40.0 - 20.0, unit() * 8.0 - 1.7, unit() * -60.0});
    return lamps;
}

int main() {
    auto const view = math::make_perspective({.far_m = 100.0, .size_px = {640, 360}}).value();
    std::vector<float> const depth_m = draw_hall(view);
    std::vector<math::dvec3> const lamps = hang_lamps(4096);

    // Once a view: a grid of tiles times depth slices, about cubes, and what the assignment needs of it.
    auto slices = cluster::make_cubical_slices(view, 16, 61.0).value();
    auto const grid = cluster::make_grid(view, {16, 16}, std::move(slices)).value();
    cull::RowGrid const rows = cull::make_row_grid(grid.view());

    // Once a frame: the lights of every cluster, as (offset, count) and indices. Exact sizes before anything is written.
    std::vector<lights::Light> placed;
    for (math::dvec3 const& lamp : lamps) placed.push_back(lights::place({lamp, lights::make_point(math::vec3(0.0F), 2.0F)}, view));
    lights::Workspace work;
    std::vector<lights::Cell> cells(rows.clusters());
    lights::ListsReport const report = lights::count_lists(rows, placed, {}, work, cells);
    std::vector<std::uint16_t> indices(report.written);
    lights::fill_lists<std::uint16_t>(work, indices);

    // Once a pixel, as a shader would: its cluster, its list. Here every light is asked too, to see that none is missing.
    std::uint64_t listed = 0, reaching = 0, missed = 0, pixels = 0;
    for (int y = 0; y < view.size_px.y; y += 3)
        for (int x = 0; x < view.size_px.x; x += 3) {
            float const depth = depth_m[static_cast<std::size_t>(y * view.size_px.x + x)];
            math::uvec2 const pixel(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
            lights::Cell const cell = cells[cluster::cluster_at(grid, pixel, depth)];
            math::vec3 const p = cluster::position_at(grid, {static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F}, depth);
            for (std::size_t i = 0; i < placed.size(); ++i) {
                math::vec3 const way = placed[i].center - p;
                if (glm::dot(way, way) >= 4.0F) continue;
                ++reaching;
                auto const first = indices.begin() + cell.offset;
                missed += std::binary_search(first, first + cell.count, static_cast<std::uint16_t>(i)) ? 0U : 1U;
            }
            listed += cell.count;
            ++pixels;
        }
    auto const mean = [&](std::uint64_t n) { return static_cast<double>(n) / static_cast<double>(pixels); };
    std::printf("%zu lights in %zu clusters, %llu pairs\n", placed.size(), cells.size(), static_cast<unsigned long long>(report.written));
    std::printf("a pixel evaluates %.1f lights, of which %.1f reach it; %llu that do were missed\n", mean(listed), mean(reaching),
                static_cast<unsigned long long>(missed));
    return missed == 0 && listed < 4 * reaching ? 0 : 1;
}
