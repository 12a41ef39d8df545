// Explicit bounds and normal cones: what lights a sample stays, what can light none goes.

#include "any_light.hpp"

#include <gnomon/check/allocations.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/cluster.hpp>
#include <gnomon/lights.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace gnomon;

namespace {

/// Samples in clusters of a grid, with what a frame would make of them.
struct SampledClusters {
    std::vector<cluster::ClusterCoordinates> clusters;
    std::vector<std::uint32_t> cluster_of;
    std::vector<math::vec3> position, normal;
    std::vector<math::Aabb> boxes;
    std::vector<cluster::NormalCone> cones;

    SampledClusters(test::Draw& draw, test::HardGrid const& hard, unsigned count) {
        cluster::GridView const view = hard.view();
        for (unsigned c = 0; c < count; ++c) {
            cluster::ClusterCoordinates at;
            at.column = draw.below(view.columns());
            at.row = draw.below(view.rows());
            at.slice = draw.below(view.slices());
            test::V3 const facing = test::direction(draw);
            double const spread = draw.below(4) == 0 ? 2.0 : draw.in(0.0, 0.5);
            for (unsigned n = draw.below(8); n > 0; --n) add_sample(draw, view, at, facing, spread);
            clusters.push_back(at);
        }
        boxes.resize(clusters.size());
        cones.resize(clusters.size());
        cluster::ReduceWorkspace work;
        (void)cluster::explicit_bounds(cluster_of, position, boxes, work);
        (void)cluster::explicit_cones(cluster_of, normal, cones, work);
    }

private:
    void add_sample(test::Draw& draw, cluster::GridView const& view, cluster::ClusterCoordinates const& at, test::V3 const& facing,
                    double spread) {
        auto const part = [&draw](float low, float high) {
            double const t = draw.unit();
            double const a = std::isinf(low) ? -10.0 : static_cast<double>(low), b = std::isinf(high) ? a + 10.0 : static_cast<double>(high);
            return a + (b - a) * t;
        };
        double const depth = part(view.depth_m[at.slice], view.depth_m[at.slice + 1]), scale = view.perspective ? depth : 1.0;
        double const x = part(view.x[at.column], view.x[at.column + 1]) * scale;
        double const y = part(view.y[at.row], view.y[at.row + 1]) * scale;
        math::vec3 const p = math::to_float(math::dvec3(x, y, depth));
        if (!cluster::contains(view, at, p)) return;
        test::V3 const off = test::direction(draw);
        math::dvec3 n(facing.x + spread * off.x, facing.y + spread * off.y, facing.z + spread * off.z);
        if (!(glm::dot(n, n) > 1e-6)) return;
        position.push_back(p);
        normal.push_back(math::to_float(n / std::sqrt(glm::dot(n, n))));
        cluster_of.push_back(static_cast<std::uint32_t>(clusters.size()));
    }
};

/// Whether a light reaches a point, in double, without a hair's breadth of doubt.
bool reaches(lights::Light const& l, math::vec3 const& p) {
    if (l.kind == lights::Kind::directional) return true;
    math::dvec3 const v = math::to_double(p) - math::to_double(l.center);
    double const distance = std::sqrt(glm::dot(v, v)), range = static_cast<double>(lights::bounding_radius_m(l));
    if (distance > range) return false;
    if (l.kind == lights::Kind::point) return true;
    if (l.kind == lights::Kind::spot) {
        math::dvec3 const axis = math::to_double(l.axis);
        double const half = std::atan2(static_cast<double>(l.sin_half), static_cast<double>(l.cos_half));
        double const cosine = glm::dot(v, axis) / (distance * std::sqrt(glm::dot(axis, axis)));
        return cosine > 1.0 || std::acos(cosine) < half - 1e-6;
    }
    math::dvec3 const u = math::to_double(l.axis), s = math::to_double(l.side), w = math::to_double(l.other);
    double const volume = glm::dot(u, glm::cross(s, w));
    if (!(std::abs(volume) > 1e-9)) return false;
    double const most = 1.0 - 1e-9;
    return std::abs(glm::dot(v, glm::cross(s, w)) / volume) < most && std::abs(glm::dot(v, glm::cross(w, u)) / volume) < most &&
           std::abs(glm::dot(v, glm::cross(u, s)) / volume) < most;
}

/// Whether the front of a surface looks at a light.
bool faces(lights::Light const& l, math::vec3 const& p, math::vec3 const& n) {
    if (l.kind == lights::Kind::directional || l.kind == lights::Kind::box) return true;
    return glm::dot(math::to_double(n), math::to_double(l.center) - math::to_double(p)) >= 0.0;
}

struct Kept {
    std::vector<lights::Cell> cells;
    std::vector<std::uint32_t> indices;

    Kept(lights::SparseInput const& in, bool lanes) : cells(in.clusters.size()) {
        lights::SparseWorkspace work;
        core::SerialExecutor const serial;
        auto const report = lights::count_sparse_lists(in, {.lanes = lanes}, work, cells, serial);
        indices.resize(report.written);
        lights::fill_sparse_lists<std::uint32_t>(work, cells, indices, serial);
    }
    [[nodiscard]] std::span<std::uint32_t const> of(std::size_t c) const { return std::span(indices).subspan(cells[c].offset, cells[c].count); }
    [[nodiscard]] bool has(std::size_t c, std::uint32_t light) const { return std::ranges::binary_search(of(c), light); }
};

struct Totals {
    std::size_t implicit = 0, boxes = 0, cones = 0, both = 0, needed = 0;
};

/// Distance from a box, in double.
double distance_to(math::Aabb const& box, math::vec3 const& p) {
    double sum = 0.0;
    for (math::axis_t k = 0; k < 3; ++k) {
        double const x = static_cast<double>(p[k]);
        double const d = std::max({static_cast<double>(box.lo[k]) - x, x - static_cast<double>(box.hi[k]), 0.0});
        sum += d * d;
    }
    return std::sqrt(sum);
}

void compare_bounds(test::Draw& draw, Totals& totals) {
    test::HardGrid const hard = test::make_hard_grid(draw);
    cull::RowGrid const grid = cull::make_row_grid(hard.view());
    std::vector<lights::Light> list;
    for (unsigned n = draw.below(150); n > 0; --n) {
        list.push_back(test::make_any_light(draw, hard, grid));
        if (!lights::is_sound(list.back())) list.pop_back();
    }
    lights::LightTree const tree = lights::build_light_tree(list, ~0U);
    SampledClusters const s(draw, hard, 40);
    Kept const implicit({grid, list, tree, s.clusters}, true), by_boxes({grid, list, tree, s.clusters, s.boxes}, true);
    Kept const by_cones({grid, list, tree, s.clusters, {}, s.cones}, true), by_both({grid, list, tree, s.clusters, s.boxes, s.cones}, true);
    Kept const one_by_one({grid, list, tree, s.clusters, s.boxes, s.cones}, false);
    CHECK(one_by_one.indices == by_both.indices);
    bool subset = true;
    for (std::size_t c = 0; c < s.clusters.size(); ++c) {
        subset = subset && std::ranges::includes(implicit.of(c), by_boxes.of(c)) && std::ranges::includes(implicit.of(c), by_cones.of(c)) &&
                 std::ranges::includes(by_boxes.of(c), by_both.of(c));
        for (std::uint32_t const light : implicit.of(c)) {
            if (list[light].kind != lights::Kind::point) continue;
            double const apart = distance_to(s.boxes[c], list[light].center), range = static_cast<double>(list[light].range_m);
            if (apart > range * 1.00001 + 1e-6) subset = subset && !by_boxes.has(c, light);
        }
    }
    CHECK(subset);
    std::size_t missed = 0;
    for (std::size_t i = 0; i < s.position.size(); ++i)
        for (std::uint32_t n = 0; n < list.size(); ++n) {
            if (!reaches(list[n], s.position[i])) continue;
            std::uint32_t const c = s.cluster_of[i];
            missed += by_boxes.has(c, n) ? 0U : 1U;
            if (!faces(list[n], s.position[i], s.normal[i])) continue;
            missed += (by_cones.has(c, n) ? 0U : 1U) + (by_both.has(c, n) ? 0U : 1U);
            ++totals.needed;
        }
    CHECK(missed == 0);
    totals.implicit += implicit.indices.size();
    totals.boxes += by_boxes.indices.size();
    totals.cones += by_cones.indices.size();
    totals.both += by_both.indices.size();
}

}  // namespace

TEST_CASE("explicit boxes and normal cones miss no light that shines on a sample's front, and drop many that cannot", "[lights][sparse][property]") {
    test::Draw draw{31};
    Totals totals;
    for (int i = 0; i < 16; ++i) compare_bounds(draw, totals);
    CHECK(totals.needed > 250);
    CHECK(totals.boxes * 10 < totals.implicit * 9);
    CHECK(totals.cones * 10 < totals.implicit * 9);
    CHECK(totals.both < totals.boxes);
    CHECK(totals.both < totals.cones);
}

TEST_CASE("explicit boxes and normal cones, 3,000 scenes", "[lights][sparse][.full]") {
    test::Draw draw{32};
    Totals totals;
    for (int i = 0; i < 3000; ++i) compare_bounds(draw, totals);
    CHECK(totals.needed > 50000);
}

TEST_CASE("a light behind all samples of a cluster is left to the others by its cone", "[lights][sparse]") {
    std::array<float, 2> const x{-1.0F, 1.0F}, y{-1.0F, 1.0F};
    std::array<float, 2> const depth_m{1.0F, 10.0F};
    cull::RowGrid const grid = cull::make_row_grid({x, y, depth_m});
    std::vector<lights::Light> const list{lights::make_point({0, 0, 2}, 5), lights::make_point({0, 0, 8}, 5), lights::make_directional(),
                                          lights::make_box({0, 0, 8}, {1, 0, 0}, {0, 1, 0}, {0, 0, 4})};
    lights::LightTree const tree = lights::build_light_tree(list, ~0U);
    std::vector<cluster::ClusterCoordinates> const at{{0, 0, 0}, {0, 0, 0}};
    std::vector<math::Aabb> const boxes{{{-1, -1, 5}, {1, 1, 5}}, {}};
    std::vector<cluster::NormalCone> const cones{{{0, 0, -1}, 0.99F}, {{0, 0, -1}, 0.99F}};
    Kept const kept({grid, list, tree, at, boxes, cones}, true);
    CHECK(kept.indices == std::vector<std::uint32_t>{0, 2, 3});  // an empty box has no lights at all
    CHECK(kept.cells[1].count == 0);
}

TEST_CASE("a capacity too small for the lists of some clusters leaves out what it leaves out of a whole grid", "[lights][sparse]") {
    test::Draw draw{33};
    test::HardGrid const hard = test::make_hard_grid(draw);
    cull::RowGrid const grid = cull::make_row_grid(hard.view());
    std::vector<lights::Light> list;
    for (unsigned n = 0; n < 90; ++n) {
        list.push_back(test::make_any_light(draw, hard, grid));
        list.back().importance = n % 11 == 0 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(n % 7);
    }
    std::vector<cluster::ClusterCoordinates> all;
    for (std::size_t c = 0; c < grid.clusters(); ++c) all.push_back(cluster::coordinates_of(hard.view(), c));
    lights::LightTree const tree = lights::build_light_tree(list, ~0U);
    lights::SparseInput const in{grid, list, tree, all};
    core::SerialExecutor const serial;
    lights::Workspace dense;
    lights::SparseWorkspace sparse;
    std::vector<lights::Cell> dense_cells(all.size()), sparse_cells(all.size());
    std::uint64_t const needed = lights::count_lists(grid, list, {}, dense, dense_cells).needed;
    for (std::uint64_t const capacity : {needed, needed - 1, needed / 2, needed / 10, std::uint64_t{0}}) {
        auto const a = lights::count_lists(grid, list, {.capacity = capacity}, dense, dense_cells);
        auto const b = lights::count_sparse_lists(in, {.capacity = capacity}, sparse, sparse_cells, serial);
        CHECK(b.needed == needed);
        CHECK(b.written == a.written);
        REQUIRE(b.left_out == a.left_out);
        CHECK(dense_cells == sparse_cells);
        for (std::uint32_t i = 0; i < a.left_out; ++i) CHECK(dense.pairs[i].light == sparse.pairs[i].light);
        std::vector<std::uint32_t> dense_indices(a.written), sparse_indices(b.written);
        lights::fill_lists<std::uint32_t>(dense, dense_indices);
        lights::fill_sparse_lists<std::uint32_t>(sparse, sparse_cells, sparse_indices, serial);
        CHECK(dense_indices == sparse_indices);
    }
}

TEST_CASE("trees and lists of few clusters allocate nothing after the first frame", "[lights][sparse]") {
    test::Draw draw{34};
    test::HardGrid const hard = test::make_hard_grid(draw);
    cull::RowGrid const grid = cull::make_row_grid(hard.view());
    std::vector<lights::Light> list;
    for (unsigned n = 0; n < 300; ++n) list.push_back(test::make_any_light(draw, hard, grid));
    SampledClusters const s(draw, hard, 200);
    lights::LightTreeWorkspace tree_work;
    lights::LightTree tree;
    lights::SparseWorkspace work;
    std::vector<lights::Cell> cells(s.clusters.size());
    std::vector<std::uint32_t> indices;
    core::SerialExecutor const serial;
    auto const frame = [&] {
        lights::build_light_tree(list, ~0U, tree_work, tree, serial);
        lights::SparseInput const in{grid, list, tree, s.clusters, s.boxes, s.cones};
        auto const report = lights::count_sparse_lists(in, {}, work, cells, serial);
        if (indices.size() < report.written) indices.resize(report.written);
        lights::fill_sparse_lists<std::uint32_t>(work, cells, indices, serial);
        return report.written;
    };
    CHECK(frame() > 100);
    std::uint64_t const before = check::allocations_made();
    (void)frame();
    CHECK(check::allocations_made() == before);
}
