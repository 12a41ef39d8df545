// How closed other people's scenes are, against a list that was made by another program: GNOMON_SCENES_DIR names a folder
// with an INDEX.tsv (see real_scenes.test.cpp), whose 10th to 12th columns are the fractions of edges that are closed and
// manifold, open, and neither.
#include <gnomon/batch/validate.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/mesh/half_edges.hpp>
#include <gnomon/mesh/validate.hpp>
#include <gnomon/scene/batches.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/load.hpp>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

using namespace gnomon;

namespace {

struct ListedEdges {
    std::string name;
    std::string path;
    double manifold = 0.0;
    double open = 0.0;
    double neither = 0.0;
};

std::vector<ListedEdges> listed_edges() {
    char const* const folder = std::getenv("GNOMON_SCENES_DIR");
    std::vector<ListedEdges> all;
    if (folder == nullptr) return all;
    std::ifstream index(std::string(folder) + "/INDEX.tsv");
    std::string line;
    std::getline(index, line);
    while (std::getline(index, line)) {
        std::vector<std::string> cells;
        std::istringstream in(line);
        for (std::string cell; std::getline(in, cell, '\t');) cells.push_back(cell);
        if (cells.size() < 12) continue;
        all.push_back({cells[0], std::string(folder) + "/" + cells[0] + "/" + cells[1], std::stod(cells[9]),
                       std::stod(cells[10]), std::stod(cells[11])});
    }
    return all;
}

/// Sums over the stored meshes, each welded by itself; the list counts duplicates as they are.
mesh::MeshReport edges_of_stored_meshes(scene::Scene const& s) {
    mesh::MeshReport sum;
    mesh::Workspace workspace;
    mesh::HalfEdges built;
    for (scene::Mesh const& m : s.meshes)
        for (scene::Primitive const& primitive : m.primitives) {
            mesh::Triangles const list{primitive.positions, primitive.indices};
            build_half_edges(list, workspace, built, {.keep_duplicates = true});
            CHECK(validate(built, list) == mesh::MeshFault::none);
            sum.manifold_edges += built.report.manifold_edges;
            sum.open_edges += built.report.open_edges;
            sum.flipped_edges += built.report.flipped_edges;
            sum.non_manifold_edges += built.report.non_manifold_edges;
        }
    return sum;
}

}  // namespace

TEST_CASE("real scenes have the edges that their list says", "[scene][real]") {
    std::vector<ListedEdges> const scenes = listed_edges();
    if (scenes.empty()) SKIP("set GNOMON_SCENES_DIR to a folder of scenes with an INDEX.tsv");
    for (ListedEdges const& listed : scenes) {
        CAPTURE(listed.name);
        auto const s = scene::load_gltf(listed.path);
        REQUIRE(s.has_value());
        mesh::MeshReport const report = edges_of_stored_meshes(*s);
        auto const all = static_cast<double>(report.edges());
        double const manifold = static_cast<double>(report.manifold_edges) / all;
        double const open = static_cast<double>(report.open_edges) / all;
        double const rounded = 0.006;  // the list has two digits, and its own way with degenerate triangles
        CHECK(manifold == Approx(listed.manifold).margin(rounded));
        CHECK(open == Approx(listed.open).margin(rounded));
        CHECK(1.0 - manifold - open == Approx(listed.neither).margin(rounded));
        scene::Geometry const g = scene::flatten(*s);
        scene::GeometryBatches const b = scene::make_batches(g);
        CHECK(validate(b.batches, {g.positions, g.indices, b.group_of_triangle}, 128) == batch::BatchFault::none);
        CHECK(b.batches.hurried == 0);
    }
}
