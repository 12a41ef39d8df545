// Scenes of other people, where the environment variable GNOMON_SCENES_DIR names a folder of them: a folder each, and an
// INDEX.tsv whose columns are name, file, triangles drawn, triangles stored, and more.
#include "gltf_fixture.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/load.hpp>
#include <gnomon/scene/suggest.hpp>
#include <gnomon/scene/write.hpp>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

using namespace gnomon;

namespace {

struct Listed {
    std::string path;
    std::uint64_t drawn = 0;
    std::uint64_t stored = 0;
};

std::vector<Listed> listed_scenes() {
    char const* const folder = std::getenv("GNOMON_SCENES_DIR");
    std::vector<Listed> scenes;
    if (folder == nullptr) return scenes;
    std::ifstream index(std::string(folder) + "/INDEX.tsv");
    std::string line;
    std::getline(index, line);
    while (std::getline(index, line)) {
        std::istringstream columns(line);
        std::string name;
        std::string file;
        Listed listed;
        columns >> name >> file >> listed.drawn >> listed.stored;
        listed.path = std::string(folder) + "/" + name + "/" + file;
        scenes.push_back(listed);
    }
    return scenes;
}

}  // namespace

TEST_CASE("real scenes have the triangles that their list says, and come back equal when written", "[scene][real]") {
    std::vector<Listed> const scenes = listed_scenes();
    if (scenes.empty()) SKIP("set GNOMON_SCENES_DIR to a folder of scenes with an INDEX.tsv");
    fixture::TemporaryFolder const folder;
    for (Listed const& listed : scenes) {
        CAPTURE(listed.path);
        auto const s = scene::load_gltf(listed.path);
        CAPTURE(s ? std::string() : s.failure().message);
        REQUIRE(s.has_value());
        CHECK(scene::count_triangles(*s) == listed.drawn);
        CHECK(scene::count_unique_triangles(*s) == listed.stored);
        CHECK(scene::validate(*s).has_value());
        CHECK(s->notes.failed_images == 0);
        scene::Geometry const g = scene::flatten(*s);
        CHECK(g.indices.size() == listed.drawn * 3);
        CHECK(g.non_finite_triangles == 0);
        REQUIRE(scene::write_gltf(*s, folder / "copy.glb").has_value());
        auto const again = scene::load_gltf(folder / "copy.glb");
        REQUIRE(again.has_value());
        CHECK(*again == *s);
        CHECK(scene::flatten(*again).positions == g.positions);
    }
}
