#include <gnomon/check/check.hpp>
#include <gnomon/mesh/half_edges.hpp>
#include <gnomon/mesh/validate.hpp>

#include "meshes.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <tuple>

using namespace gnomon;
using meshes::Mesh;
using mesh::EdgeKind;
using mesh::MeshFault;
using mesh::MeshReport;

namespace {

using Place = std::tuple<float, float, float>;  // compares -0 and +0 equal

/// The policy done over maps of places, with no indices at all. Positions must not be NaN unless the triangle is left out.
MeshReport report_by_maps(Mesh const& m, bool keep_duplicates = false) {
    MeshReport report;
    std::set<Place> places;
    for (math::vec3 const& p : m.positions) {
        bool const nan = p.x != p.x || p.y != p.y || p.z != p.z;
        report.welded_vertices += !nan && !places.insert({p.x, p.y, p.z}).second ? 1U : 0U;
    }
    std::set<std::array<Place, 3>> seen;
    std::map<std::pair<Place, Place>, std::pair<int, int>> edges;  // ascending place: there, back
    for (std::size_t t = 0; t + 2 < m.indices.size(); t += 3) {
        std::array<Place, 3> v;
        bool exists = true;
        bool finite = true;
        for (std::size_t k = 0; k < 3; ++k) exists = exists && m.indices[t + k] < m.positions.size();
        for (std::size_t k = 0; k < 3 && exists; ++k) {
            math::vec3 const& p = m.positions[m.indices[t + k]];
            finite = finite && std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
            v[k] = {p.x, p.y, p.z};
        }
        bool const degenerate = exists && finite && (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]);
        report.bad_index += exists ? 0U : 1U;
        report.not_finite += exists && !finite ? 1U : 0U;
        report.degenerate_triangles += degenerate ? 1U : 0U;
        if (!exists || !finite || degenerate) continue;
        if (seen.contains({v[0], v[1], v[2]}) || seen.contains({v[1], v[2], v[0]}) || seen.contains({v[2], v[0], v[1]})) {
            ++report.duplicate_triangles;
            if (!keep_duplicates) continue;
        }
        seen.insert({v[0], v[1], v[2]});
        for (std::size_t k = 0; k < 3; ++k) {
            Place const& a = v[k];
            Place const& b = v[(k + 1) % 3];
            if (a < b) ++edges[{a, b}].first;
            else ++edges[{b, a}].second;
        }
    }
    for (auto const& [ends, uses] : edges) {
        int const all = uses.first + uses.second;
        report.manifold_edges += uses == std::pair(1, 1) ? 1U : 0U;
        report.open_edges += all == 1 ? 1U : 0U;
        report.flipped_edges += all == 2 && uses.first != 1 ? 1U : 0U;
        report.non_manifold_edges += all > 2 ? 1U : 0U;
        report.unbalanced_edges += uses.first != uses.second ? 1U : 0U;
    }
    return report;
}

/// Up to 30 triangles over few places, with negative zeros, NaN, infinities and bad indices among them.
auto bad_meshes() {
    return [](check::Choices& choices) {
        Mesh m;
        auto const number = [&]() -> float {
            static constexpr float values[] = {0.0F, 1.0F, -0.0F, 0.5F, 1e-45F, 3e38F};
            std::uint64_t const kind = choices.draw(99);
            if (kind == 99) return std::numeric_limits<float>::quiet_NaN();
            if (kind == 98) return std::numeric_limits<float>::infinity();
            return values[kind % (choices.draw(1) != 0 ? 6 : 3)];
        };
        std::uint64_t const positions = 1 + choices.draw(15);
        for (std::uint64_t i = 0; i < positions; ++i) {
            float const x = number();
            float const y = number();
            m.positions.emplace_back(x, y, number());
        }
        std::uint64_t const triangles = choices.draw(30);
        for (std::uint64_t i = 0; i < 3 * triangles; ++i)
            m.indices.push_back(choices.draw(49) == 49 ? 1000U : static_cast<std::uint32_t>(choices.draw(positions - 1)));
        return m;
    };
}

MeshReport report_of(Mesh const& m) {
    mesh::HalfEdges const built = mesh::build_half_edges(m.list());
    CHECK(validate(built, m.list()) == MeshFault::none);
    return built.report;
}

}  // namespace

TEST_CASE("build_half_edges finds what maps of places find", "[mesh][property]") {
    check::for_all(check::cases(3000), bad_meshes(), [](Mesh const& m) {
        mesh::HalfEdges const built = mesh::build_half_edges(m.list());
        CHECK(built.report == report_by_maps(m));
        CHECK(validate(built, m.list()) == MeshFault::none);
        mesh::HalfEdges const all = mesh::build_half_edges(m.list(), {.keep_duplicates = true});
        CHECK(all.report == report_by_maps(m, true));
        CHECK(validate(all, m.list()) == MeshFault::none);
    });
}

TEST_CASE("closed solids are closed, whether their corners are shared or not", "[mesh]") {
    for (Mesh const& m : {meshes::tetrahedron(), meshes::cube(), meshes::sphere(16)})
        for (Mesh const& same : {m, m.exploded()}) {
            MeshReport const report = report_of(same);
            CHECK(is_closed_manifold(report));
            CHECK(is_closed(report));
            CHECK(report.manifold_edges == same.indices.size() / 2);
            std::size_t const vertices = same.positions.size() - report.welded_vertices;
            CHECK(vertices + same.indices.size() / 3 == report.edges() + 2);  // Euler
        }
}

TEST_CASE("a hole, a flipped triangle and a third triangle give their edges their names", "[mesh]") {
    Mesh hole = meshes::cube();
    hole.indices.resize(hole.indices.size() - 3);
    CHECK(report_of(hole).open_edges == 3);
    CHECK(report_of(hole).manifold_edges == 15);
    CHECK_FALSE(is_closed(report_of(hole)));

    Mesh flipped = meshes::cube();
    std::swap(flipped.indices[1], flipped.indices[2]);
    CHECK(report_of(flipped).flipped_edges == 3);
    CHECK_FALSE(is_closed(report_of(flipped)));

    Mesh fin = meshes::cube();
    fin.positions.emplace_back(5.0F, 5.0F, 5.0F);
    fin.add({0, 3, 8});
    CHECK(report_of(fin).non_manifold_edges == 1);
    CHECK(report_of(fin).open_edges == 2);
}

TEST_CASE("two solids that share an edge are closed, but no manifold, and its half-edges have no twins", "[mesh]") {
    Mesh m = meshes::tetrahedron();
    m.append({{math::vec3(0.0F, 0.0F, 0.0F), math::vec3(-1.0F, 0.0F, 0.0F), math::vec3(0.0F, -1.0F, 0.0F), math::vec3(0.0F, 0.0F, 1.0F)},
              {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}});
    mesh::HalfEdges const built = mesh::build_half_edges(m.list());
    CHECK(built.report.non_manifold_edges == 1);
    CHECK(is_closed(built.report));
    CHECK_FALSE(is_closed_manifold(built.report));
    for (mesh::Edge const& edge : built.edges) {
        if (edge.kind != EdgeKind::non_manifold) continue;
        CHECK(edge.count == 4);
        CHECK(edge.balance == 0);
        for (std::uint32_t const h : built.half_edges(edge)) CHECK(built.twin[h] == mesh::no_index);
    }
}

TEST_CASE("a sheet of two sides closes on itself, a triangle that comes twice counts once", "[mesh]") {
    Mesh m = meshes::tetrahedron();
    m.indices = {0, 1, 2, 0, 2, 1};
    CHECK(is_closed_manifold(report_of(m)));
    m.indices = {0, 1, 2, 1, 2, 0, 2, 0, 1};
    CHECK(report_of(m).duplicate_triangles == 2);
    CHECK(report_of(m).open_edges == 3);
}

TEST_CASE("twins run against each other and walk round a vertex", "[mesh]") {
    mesh::HalfEdges const built = mesh::build_half_edges(meshes::sphere(5).list());
    std::size_t wrong = 0;
    for (std::uint32_t h = 0; h < built.from.size(); ++h) {
        std::uint32_t const twin = built.twin[h];
        wrong += built.from[twin] == built.from[mesh::next(h)] && built.from[mesh::next(twin)] == built.from[h] ? 0U : 1U;
        wrong += mesh::next(mesh::previous(h)) == h && mesh::next(mesh::next(mesh::next(h))) == h ? 0U : 1U;
    }
    CHECK(wrong == 0);
}

TEST_CASE("the report does not depend on the order of triangles or corners", "[mesh][property]") {
    check::for_all(check::cases(500), bad_meshes(), check::integers(1, 1000), [](Mesh const& m, int seed) {
        Mesh other = m;
        std::size_t const n = m.indices.size() / 3;
        for (std::size_t t = 0; t < n; ++t) {
            std::size_t const to = (t * 7 + static_cast<std::size_t>(seed)) % (n % 7 == 0 ? 1 : n);
            for (std::size_t k = 0; k < 3 && n % 7 != 0; ++k)
                other.indices[3 * to + (k + static_cast<std::size_t>(seed)) % 3] = m.indices[3 * t + k];
        }
        CHECK(mesh::build_half_edges(other.list()).report == mesh::build_half_edges(m.list()).report);
    });
}

TEST_CASE("an empty mesh is legal, and a workspace can be used again", "[mesh][degenerate]") {
    mesh::Workspace workspace;
    mesh::HalfEdges built;
    Mesh const cube = meshes::cube();
    build_half_edges(cube.list(), workspace, built);
    Mesh const nothing;
    build_half_edges(nothing.list(), workspace, built);
    CHECK(built.report == MeshReport{});
    CHECK(validate(built, nothing.list()) == MeshFault::none);
    build_half_edges(cube.list(), workspace, built);
    CHECK(built.report == report_by_maps(cube));
}

TEST_CASE("validate names what is wrong with half-edges", "[mesh]") {
    Mesh const m = meshes::sphere(3);
    mesh::HalfEdges const good = mesh::build_half_edges(m.list());
    auto const fault_of = [&](auto const& spoil) {
        mesh::HalfEdges bad = good;
        spoil(bad);
        return validate(bad, m.list());
    };
    CHECK(fault_of([](auto&) {}) == MeshFault::none);
    CHECK(fault_of([](auto& h) { h.twin.pop_back(); }) == MeshFault::wrong_size);
    CHECK(fault_of([](auto& h) { h.vertex_of[1] = 0; }) == MeshFault::bad_vertex);
    CHECK(fault_of([](auto& h) { h.from[0] = h.from[1]; }) == MeshFault::bad_vertex);
    CHECK(fault_of([](auto& h) { h.fate[0] = mesh::Fate::degenerate; }) == MeshFault::bad_fate);
    CHECK(fault_of([](auto& h) { std::swap(h.edges[0], h.edges[1]); }) == MeshFault::bad_edge);
    CHECK(fault_of([](auto& h) { std::swap(h.of_edge[0], h.of_edge[2]); }) == MeshFault::bad_edge);
    CHECK(fault_of([](auto& h) { h.edges[0].kind = EdgeKind::non_manifold; }) != MeshFault::none);
    CHECK(fault_of([](auto& h) { h.edges[0].balance = 2; }) == MeshFault::bad_kind);
    CHECK(fault_of([](auto& h) { h.twin[0] = h.twin[1]; }) == MeshFault::bad_twin);
    CHECK(fault_of([](auto& h) { h.twin[0] = mesh::no_index; }) == MeshFault::bad_twin);
}
