// Models of other people: every .gltf and .glb below the folder that GNOMON_MODELS_DIR names, or below that of Debian's
// assimp-testmodels where it is installed. Each loads and can be posed, or is refused with a sentence.
#include <gnomon/check/check.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/load.hpp>
#include <gnomon/scene/pose.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

using namespace gnomon;

namespace {

std::vector<std::string> model_files() {
    char const* const asked = std::getenv("GNOMON_MODELS_DIR");
    std::filesystem::path const folder = asked != nullptr ? asked : "/usr/share/assimp/models";
    std::vector<std::string> files;
    std::error_code error;
    for (std::filesystem::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        if (it->path().extension() == ".gltf" || it->path().extension() == ".glb") files.push_back(it->path().string());
    std::sort(files.begin(), files.end());
    return files;
}

void check_posed(scene::Scene const& s, std::string const& file) {
    CAPTURE(file);
    CHECK(scene::validate(s).has_value());
    scene::Geometry moved = scene::flatten(s);
    for (std::uint32_t clip = 0; clip < std::max<std::size_t>(s.animations.size(), 1); ++clip)
        for (double const part : {0.0, 0.3, 0.77, 1.0}) {
            double const end = clip < s.animations.size() ? scene::duration_s(s.animations[clip]) : 1.0;
            scene::Pose const pose = scene::pose_at(s, {part * end, clip, false});
            scene::update(moved, s, pose);
            for (std::uint32_t const index : moved.indices) REQUIRE(math::contains(moved.bounds, moved.positions[index]));
        }
}

}  // namespace

TEST_CASE("other people's models load and can be posed, or are refused with a sentence", "[scene][real]") {
    std::vector<std::string> const files = model_files();
    if (files.empty()) SKIP("set GNOMON_MODELS_DIR to a folder of glTF files, or install assimp-testmodels");
    bool const list = std::getenv("GNOMON_MODELS_LIST") != nullptr;
    for (std::string const& file : files) {
        CAPTURE(file);
        auto const s = scene::load_gltf(file);
        if (list) std::printf("%s %s\n", s ? "loaded " : "refused", s ? file.c_str() : s.failure().message.c_str());
        if (s) {
            check_posed(*s, file);
            continue;
        }
        CAPTURE(s.failure().message);
        CHECK(s.failure().message.find(';') != std::string::npos);
        CHECK(s.failure().message.size() > 20);
    }
}
