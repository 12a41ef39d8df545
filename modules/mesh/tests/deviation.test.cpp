#include <gnomon/check/check.hpp>
#include <gnomon/mesh/deviation.hpp>

#include "meshes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace gnomon;
using meshes::Mesh;

namespace {

/// Squared distance to a triangle by trying a fine grid of its points: never too small.
double distance_by_grid(math::dvec3 const& p, mesh::detail::Corners const& t, int steps) {
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j) {
            double const u = static_cast<double>(i) / steps;
            double const v = static_cast<double>(j) / steps;
            math::dvec3 const q = t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v - p;
            best = std::min(best, std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z));
        }
    return best;
}

/// The farthest of a grid of points on `from`, each over all triangles of `to`: never more than the true deviation.
double deviation_by_grid(Mesh const& from, Mesh const& to, int steps) {
    double worst = 0.0;
    mesh::detail::Corners a{};
    mesh::detail::Corners b{};
    for (std::size_t t = 0; t < from.indices.size() / 3; ++t) {
        static_cast<void>(mesh::detail::corners_of(from.list(), t, a));
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; i + j <= steps; ++j) {
                math::dvec3 const p = a[0] + (a[1] - a[0]) * (static_cast<double>(i) / steps) + (a[2] - a[0]) * (static_cast<double>(j) / steps);
                double nearest = std::numeric_limits<double>::infinity();
                for (std::size_t other = 0; other < to.indices.size() / 3; ++other) {
                    static_cast<void>(mesh::detail::corners_of(to.list(), other, b));
                    nearest = std::min(nearest, mesh::detail::triangle_distance_sq(p, b));
                }
                worst = std::max(worst, std::sqrt(nearest));
            }
    }
    return worst;
}

Mesh scaled(Mesh mesh, float by) {
    for (math::vec3& p : mesh.positions) p *= by;
    return mesh;
}

}  // namespace

TEST_CASE("triangle_distance_sq is the distance to the nearest point of a fine grid", "[mesh][property]") {
    auto const number = check::floats(-2.0F, 2.0F);
    auto const point = [number](check::Choices& choices) {
        double const x = static_cast<double>(number(choices));
        double const y = static_cast<double>(number(choices));
        return math::dvec3(x, y, static_cast<double>(number(choices)));
    };
    auto const corners = [point](check::Choices& choices) {
        mesh::detail::Corners t{point(choices), point(choices), point(choices)};
        if (choices.draw(7) == 7) t[2] = (t[0] + t[1]) * 0.5;  // collinear
        if (choices.draw(15) == 15) t[1] = t[2] = t[0];
        return t;
    };
    check::for_all(check::cases(300), corners, point, [](mesh::detail::Corners const& t, math::dvec3 const& p) {
        double const exact = std::sqrt(mesh::detail::triangle_distance_sq(p, t));
        double const grid = distance_by_grid(p, t, 64);
        CHECK(exact <= grid + 1e-9);
        CHECK(grid - exact < 6.0 * std::sqrt(3.0) / 64.0);
    });
}

TEST_CASE("a mesh does not deviate from itself, cut finer or coarser", "[mesh]") {
    Mesh const sphere = meshes::sphere(6);
    CHECK(mesh::deviation(sphere.list(), sphere.list()).at_most_m <= 1e-6);
    Mesh flat = meshes::sheet(8);
    for (math::vec3& p : flat.positions) p.y = 0.25F;
    Mesh const two{{flat.positions[0], flat.positions[8], flat.positions[72], flat.positions[80]}, {0, 2, 1, 1, 2, 3}};
    CHECK(mesh::deviation(flat.list(), two.list()).at_most_m <= 1e-6);
    CHECK(mesh::deviation(two.list(), flat.list()).at_most_m <= 1e-6);
}

TEST_CASE("a sheet above a larger one deviates by its height, and the larger one by its border too", "[mesh]") {
    Mesh const low{{math::vec3(-4.0F, 0.0F, -4.0F), math::vec3(-4.0F, 0.0F, 4.0F), math::vec3(4.0F, 0.0F, -4.0F), math::vec3(4.0F, 0.0F, 4.0F)},
                   {0, 1, 2, 2, 1, 3}};
    Mesh high = scaled(low, 0.25F);
    for (math::vec3& p : high.positions) p.y = 2.0F;
    mesh::Deviation const down = mesh::deviation(high.list(), low.list());
    CHECK(down.at_least_m == Approx(2.0));
    CHECK(down.at_most_m == Approx(2.0));
    mesh::Deviation const up = mesh::deviation(low.list(), high.list());
    CHECK(up.at_least_m == Approx(std::sqrt(4.0 + 9.0 + 9.0)));
    CHECK(up.at_most_m <= up.at_least_m * 1.05 + 1e-9);
}

TEST_CASE("the bounds of deviation enclose what a grid of points finds", "[mesh]") {
    Mesh const fine = meshes::sphere(6);
    for (Mesh const& other : {meshes::sphere(2), scaled(meshes::sphere(3), 1.3F), meshes::cube(), meshes::sheet(4)})
        for (bool const turned : {false, true}) {
            Mesh const& from = turned ? other : fine;
            Mesh const& to = turned ? fine : other;
            mesh::Deviation const measured = mesh::deviation(from.list(), to.list(), {.relative = 0.01});
            double const grid = deviation_by_grid(from, to, 8);
            CHECK(grid <= measured.at_most_m + 1e-12);
            CHECK(measured.at_most_m <= measured.at_least_m * 1.01 + 1e-6);
            CHECK(measured.at_least_m <= grid * 1.35 + 1e-6);
        }
}

TEST_CASE("deviation without triangles is 0 or infinite, and NaN takes no part", "[mesh][degenerate]") {
    Mesh const none;
    Mesh const sphere = meshes::sphere(2);
    CHECK(mesh::deviation(none.list(), sphere.list()).at_most_m == 0.0);
    CHECK(mesh::deviation(none.list(), none.list()).at_most_m == 0.0);
    CHECK(mesh::deviation(sphere.list(), none.list()).at_least_m == std::numeric_limits<double>::infinity());
    Mesh broken = sphere;
    auto const n = static_cast<std::uint32_t>(broken.positions.size());
    broken.positions.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0.0F, 9.0F);
    broken.add({0, 1, n, 0, 1, n + 7});
    CHECK(mesh::deviation(broken.list(), sphere.list()).at_most_m <= 1e-6);
}

TEST_CASE("few queries leave bounds that are wide, but hold", "[mesh]") {
    Mesh const from = meshes::sphere(6);
    Mesh const to = scaled(meshes::cube(), 0.7F);
    mesh::Deviation const exact = mesh::deviation(from.list(), to.list(), {.relative = 1e-3});
    mesh::Deviation const rough = mesh::deviation(from.list(), to.list(), {.relative = 1e-6, .max_queries = 10});
    CHECK(rough.at_least_m <= exact.at_most_m);
    CHECK(exact.at_least_m <= rough.at_most_m);
}
