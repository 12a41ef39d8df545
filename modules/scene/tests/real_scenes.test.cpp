// Scenes of other people, where the environment variable GNOMON_SCENES_DIR names a folder of them: a folder each, and an
// INDEX.tsv whose columns are name, file, triangles drawn, triangles stored, and more.
#include "gltf_fixture.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/load.hpp>
#include <gnomon/scene/suggest.hpp>
#include <gnomon/scene/write.hpp>

#include <algorithm>
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

TEST_CASE("real clips move without jumps, stay in place, and end where they began", "[scene][real]") {
    std::vector<Listed> const scenes = listed_scenes();
    if (scenes.empty()) SKIP("set GNOMON_SCENES_DIR to a folder of scenes with an INDEX.tsv");
    std::size_t clips = 0;
    for (Listed const& listed : scenes) {
        auto const s = scene::load_gltf(listed.path);
        REQUIRE(s.has_value());
        for (std::uint32_t clip = 0; clip < s->animations.size(); ++clip, ++clips) {
            CAPTURE(listed.path);
            CAPTURE(s->animations[clip].name);
            scene::Geometry const rest = scene::flatten(*s);
            scene::Geometry frame = rest;
            auto const size = static_cast<double>(glm::distance(rest.bounds.lo, rest.bounds.hi));
            double const end_s = scene::duration_s(s->animations[clip]);
            std::vector<math::vec3> last;
            std::vector<math::vec3> first;
            double largest_step = 0.0;
            double path = 0.0;
            constexpr int steps = 240;
            for (int i = 0; i <= steps; ++i) {
                scene::update(frame, *s, scene::pose_at(*s, {end_s * i / steps, clip, false}));
                double step = 0.0;
                for (std::size_t v = 0; v < last.size(); ++v)
                    step = std::max(step, static_cast<double>(glm::distance(last[v], frame.positions[v])));
                largest_step = std::max(largest_step, step);
                path += step;
                if (i == 0) first = frame.positions;
                last = frame.positions;
                auto const now = static_cast<double>(glm::distance(frame.bounds.lo, frame.bounds.hi));
                CHECK(now > size * 0.5);
                CHECK(now < size * 2.0);
                CHECK(static_cast<double>(glm::distance(frame.bounds.lo, rest.bounds.lo)) < size);
            }
            CHECK(largest_step < size * 0.05);
            CHECK(path > size * 0.01);  // something moves
            double gap = 0.0;
            for (std::size_t v = 0; v < last.size(); ++v)
                gap = std::max(gap, static_cast<double>(glm::distance(last[v], first[v])));
            CHECK(gap < size * 0.05);
        }
    }
    CHECK(clips != 0);
}
