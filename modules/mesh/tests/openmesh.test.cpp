// The one test that includes OpenMesh.
#include <gnomon/check/check.hpp>

#if defined(GNOMON_HAS_OPENMESH)

#include <gnomon/mesh/openmesh.hpp>

#include "meshes.hpp"

#include <array>
#include <limits>
#include <set>
#include <tuple>

using namespace gnomon;

namespace {

using Triple = std::array<std::tuple<float, float, float>, 3>;

/// The triangles as places, each turned to its lowest corner: equal if two meshes are the same surface.
std::multiset<Triple> openmesh_triangles(mesh::Triangles const& m, mesh::HalfEdges const* kept = nullptr) {
    std::multiset<Triple> all;
    for (std::size_t t = 0; t < m.size(); ++t) {
        if (kept != nullptr && kept->fate[t] != mesh::Fate::kept) continue;
        Triple triple;
        for (std::size_t k = 0; k < 3; ++k) {
            math::vec3 const& p = m.positions[m.indices[3 * t + k]];
            triple[k] = {p.x, p.y, p.z};
        }
        std::rotate(triple.begin(), std::min_element(triple.begin(), triple.end()), triple.end());
        all.insert(triple);
    }
    return all;
}

auto openmesh_soups() {
    return [](check::Choices& choices) {
        meshes::Mesh m;
        std::uint64_t const positions = 3 + choices.draw(9);
        for (std::uint64_t i = 0; i < positions; ++i)
            m.positions.emplace_back(static_cast<float>(i % 3), static_cast<float>(i / 3 % 2), static_cast<float>(i / 6));
        std::uint64_t const triangles = choices.draw(24);
        for (std::uint64_t i = 0; i < 3 * triangles; ++i)
            m.indices.push_back(choices.draw(59) == 59 ? 99U : static_cast<std::uint32_t>(choices.draw(positions - 1)));
        return m;
    };
}

double volume_of(mesh::Triangles const& m) {
    double sum = 0.0;
    for (std::size_t t = 0; t < m.size(); ++t) {
        auto const at = [&](std::size_t k) { return math::to_double(m.positions[m.indices[3 * t + k]]); };
        sum += glm::dot(at(0), glm::cross(at(1), at(2))) / 6.0;
    }
    return sum;
}

}  // namespace

TEST_CASE("every kept triangle of any soup goes to OpenMesh and comes back", "[mesh][openmesh][property]") {
    check::for_all(check::cases(1500), openmesh_soups(), [](meshes::Mesh const& m) {
        mesh::HalfEdges const half_edges = mesh::build_half_edges(m.list());
        mesh::OpenMeshSurface surface;
        mesh::Conversion const done = to_openmesh(m.list(), half_edges, surface);
        CHECK(done.refused_faces == 0);
        mesh::IndexedMesh const back = mesh::from_openmesh(surface);
        CHECK((openmesh_triangles(back.triangles()) == openmesh_triangles(m.list(), &half_edges)));
        CHECK(back.positions.size() == done.vertices);
    });
}

TEST_CASE("a manifold goes to OpenMesh with one vertex a place, and its twins", "[mesh][openmesh]") {
    meshes::Mesh const m = meshes::sphere(5).exploded();
    mesh::HalfEdges const half_edges = mesh::build_half_edges(m.list());
    mesh::OpenMeshSurface surface;
    mesh::Conversion const done = to_openmesh(m.list(), half_edges, surface);
    CHECK(done.cut_vertices == 0);
    CHECK(done.vertices == m.positions.size() - half_edges.report.welded_vertices);
    CHECK(surface.n_edges() == half_edges.report.manifold_edges);
    std::size_t wrong = 0;
    for (std::uint32_t h = 0; h < half_edges.from.size(); ++h) {
        auto const face = surface.face_handle(static_cast<unsigned>(mesh::triangle_of(h)));
        auto const across = surface.face_handle(static_cast<unsigned>(mesh::triangle_of(half_edges.twin[h])));
        bool found = false;
        for (auto const neighbour : surface.ff_range(face)) found = found || neighbour == across;
        wrong += found ? 0U : 1U;
    }
    CHECK(wrong == 0);
}

TEST_CASE("LODs of a closed mesh are closed, smaller, and as far away as they say", "[mesh][openmesh]") {
    meshes::Mesh const m = meshes::sphere(14);  // 2352 triangles
    std::array const ratios{0.5, 0.2, 0.05};
    auto const lods = mesh::make_lods(m.list(), {.ratios = ratios});
    REQUIRE(lods.size() == 3);
    double error_before = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        mesh::Triangles const lod = lods[i].mesh.triangles();
        mesh::MeshReport const report = mesh::build_half_edges(lod).report;
        CHECK(is_closed_manifold(report));
        CHECK(report.degenerate_triangles + report.duplicate_triangles == 0);
        CHECK(static_cast<double>(lod.size()) <= 2352.0 * ratios[i] + 2.0);
        CHECK(lods[i].error_m() > error_before);
        CHECK(lods[i].from_whole.at_least_m <= lods[i].from_whole.at_most_m);
        // Of a sphere's inscribed polyhedron: the volume lost is at most the error times the area.
        CHECK(volume_of(m.list()) - volume_of(lod) <= lods[i].error_m() * 4.0 * 3.15);
        CHECK(volume_of(lod) > 0.5 * volume_of(m.list()));
        error_before = lods[i].error_m();
    }
    CHECK(lods[0].error_m() < 0.03);
}

TEST_CASE("make_lods stops at the coarsest mesh that keeps the error", "[mesh][openmesh]") {
    meshes::Mesh const m = meshes::sphere(9);
    std::array const ratios{0.5, 0.2, 0.05, 0.02};
    auto const all = mesh::make_lods(m.list(), {.ratios = ratios});
    REQUIRE(all.size() == 4);
    double const limit = (all[1].error_m() + all[2].error_m()) / 2.0;
    auto const lods = mesh::make_lods(m.list(), {.ratios = ratios, .max_error_m = limit});
    REQUIRE(lods.size() == 3);
    CHECK(lods[2].error_m() <= limit);
    CHECK(lods[2].mesh.indices.size() < lods[1].mesh.indices.size());
    CHECK(lods[2].mesh.indices.size() > all[2].mesh.indices.size());
    CHECK(mesh::make_lods(m.list(), {.ratios = ratios, .max_error_m = 0.0}).empty());
}

TEST_CASE("borders and edges of four triangles stay where they are", "[mesh][openmesh]") {
    std::array const ratios{0.3};
    meshes::Mesh const sheet = meshes::sheet(12);
    auto const lods = mesh::make_lods(sheet.list(), {.ratios = ratios});
    REQUIRE(lods.size() == 1);
    CHECK(mesh::build_half_edges(lods[0].mesh.triangles()).report.open_edges == 48);
    CHECK(lods[0].mesh.indices.size() < sheet.indices.size() / 2);

    std::array const out_of_reach{0.5, 0.2};
    CHECK(mesh::make_lods(meshes::sheet(1).list(), {.ratios = out_of_reach}).size() == 1);

    meshes::Mesh two = meshes::sphere(8);
    two.append(meshes::sphere(8));
    for (std::size_t i = two.positions.size() / 2; i < two.positions.size(); ++i) {
        two.positions[i].x = 2.0F - two.positions[i].x;  // touches the first one in one point
    }
    for (std::size_t i = two.indices.size() / 2; i < two.indices.size(); i += 3) std::swap(two.indices[i], two.indices[i + 1]);
    REQUIRE(is_closed(mesh::build_half_edges(two.list()).report));
    REQUIRE(find_fans(mesh::build_half_edges(two.list())).split_vertices == 1);
    auto const pair = mesh::make_lods(two.list(), {.ratios = ratios});
    REQUIRE(pair.size() == 1);
    mesh::HalfEdges const reduced = mesh::build_half_edges(pair[0].mesh.triangles());
    CHECK(is_closed(reduced.report));
    CHECK(find_fans(reduced).split_vertices == 1);
}

TEST_CASE("meshes without a triangle have no LODs", "[mesh][openmesh][degenerate]") {
    std::array const ratios{0.5};
    meshes::Mesh const none;
    CHECK(mesh::make_lods(none.list(), {.ratios = ratios}).empty());
    float const nan = std::numeric_limits<float>::quiet_NaN();
    meshes::Mesh const broken{{math::vec3(nan, 0.0F, 0.0F), math::vec3(0.0F, 0.0F, 0.0F)}, {0, 1, 1, 0, 1, 7}};
    CHECK(mesh::make_lods(broken.list(), {.ratios = ratios}).empty());
}

#endif
