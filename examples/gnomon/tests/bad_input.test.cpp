// Bad input to the real binary: one sentence that names the value, the right exit code, nothing left behind.

#include "fixtures.hpp"
#include "process.hpp"

#include <gnomon/check/check.hpp>

#include <algorithm>

using namespace gnomon::command;

namespace {

struct BadCase {
    int exit_code;
    char const* names;  ///< Part of the sentence.
    std::vector<std::string> arguments;
};

/// Runs it and checks everything that holds for any bad input.
void check_refused(TestFolder const& folder, BadCase const& bad) {
    std::string line;
    for (std::string const& argument : bad.arguments) line += argument + ' ';
    auto const before = folder.entries();
    Ended const ended = gnomon_in(folder.path(), bad.arguments);
    CAPTURE(line, ended.err);
    CHECK(ended.exit_code == bad.exit_code);
    CHECK(ended.err.starts_with("gnomon: "));
    CHECK(std::count(ended.err.begin(), ended.err.end(), '\n') == 1);
    CHECK(ended.err.find(bad.names) != std::string::npos);
    CHECK(ended.out.empty());
    CHECK(folder.entries() == before);
}

}  // namespace

TEST_CASE("bad flags and values are usage errors", "[command][bad-input]") {
    TestFolder const folder;
    write_table(folder);
    std::vector<BadCase> const cases = {
        {2, "verb", {}},
        {2, "did you mean 'compare'", {"comprae", "table.glb"}},
        {2, "--siez", {"render", "table.glb", "--siez", "8x8"}},
        {2, "did you mean 'city'", {"render", "citty"}},
        {2, "0x0", {"render", "table.glb", "--size", "0x0"}},
        {2, "100000x100000", {"render", "table.glb", "--size", "100000x100000"}},
        {2, "1024", {"render", "table.glb", "--size", "1024"}},
        {2, "--threads 0", {"render", "table.glb", "--threads", "0"}},
        {2, "--threads -1", {"render", "table.glb", "--threads", "-1"}},
        {2, "--threads 99999", {"render", "table.glb", "--threads", "99999"}},
        {2, "12abc", {"render", "table.glb", "--repeats", "12abc"}},
        {2, "'nan'", {"render", "table.glb", "--eye", "nan,0,0", "--look", "0,0,0"}},
        {2, "'inf'", {"render", "table.glb", "--eye", "0,0,0", "--look", "inf,0,0"}},
        {2, "near must be less", {"render", "table.glb", "--near", "5", "--far", "5"}},
        {2, "0,0,0", {"compare", "table.glb", "--sun", "0,0,0"}},
        {2, "one light", {"compare", "table.glb", "--sun", "0,-1,0", "--point", "0,1,0"}},
        {2, "none of this name", {"render", "table.glb", "--camera", "back"}},
        {2, "none of this name", {"render", "table.glb", "--light", "sun"}},
        {2, "shadow-mapp", {"render", "table.glb", "--techniques", "shadow-mapp"}},
        {2, "resolutoin", {"render", "table.glb", "--param", "shadow-map.resolutoin=8"}},
        {2, "many", {"render", "table.glb", "--param", "shadow-map.resolution=many"}},
        {2, "-8", {"render", "table.glb", "--param", "shadow-map.resolution=-8"}},
        {2, "ray", {"render", "table.glb", "--techniques", "shadow-map", "--param", "ray.resolution=8"}},
        {2, "twice", {"render", "table.glb", "--techniques", "ray,ray"}},
        {2, "twice", {"render", "table.glb", "--param", "shadow-map.resolution=64,64"}},
        {2, "given twice", {"render", "table.glb", "--param", "shadow-map.pcf=1", "--param", "shadow-map.pcf=2"}},
        {2, "metal", {"render", "table.glb", "--backend", "cpu,metal"}},
        {2, "given twice", {"render", "table.glb", "--backend", "cpu,cpu"}},
        {2, "--backend vulkan", {"render", "table.glb", "--device", "llvmpipe"}},
        {2, "--triangles", {"render", "table.glb", "--triangles", "100"}},
        {2, "2 blocks", {"render", "cubes", "--blocks", "2"}},
        {2, ".glb or .gltf", {"scenes", "cubes", "--write", "cubes.obj"}},
    };
    for (BadCase const& bad : cases) check_refused(folder, bad);
}

TEST_CASE("missing, broken and empty files are failures", "[command][bad-input]") {
    TestFolder const folder;
    std::string const whole = read_text(write_table(folder));
    write_text(folder / "short.glb", whole.substr(0, whole.size() / 2));
    write_text(folder / "noise.glb", std::string(4096, '\xa5'));
    write_text(folder / "nothing.glb", "");
    write_text(folder / "text.gltf", "{\"asset\": ");
    write_text(folder / "empty.gltf", empty_gltf);
    write_text(folder / "draco.gltf", demanding_gltf);
    fs::create_directory(folder / "folder.glb");
    std::vector<BadCase> const cases = {
        {1, "missing.glb", {"render", "missing.glb"}},  {1, "no/such/place.gltf", {"compare", "no/such/place.gltf"}},
        {1, "short.glb", {"render", "short.glb"}},      {1, "noise.glb", {"render", "noise.glb"}},
        {1, "nothing.glb", {"compare", "nothing.glb"}}, {1, "text.gltf", {"render", "text.gltf"}},
        {1, "empty.gltf", {"compare", "empty.gltf"}},   {1, "KHR_draco_mesh_compression", {"render", "draco.gltf"}},
        {1, "folder.glb", {"render", "folder.glb"}},    {1, "missing.glb", {"scenes", "missing.glb"}},
    };
    for (BadCase const& bad : cases) check_refused(folder, bad);
}

TEST_CASE("a file's camera with near beyond far is refused by name", "[command][bad-input]") {
    TestFolder const folder;
    write_text(folder / "short_sighted.gltf", short_sighted_gltf);
    Ended const ended = gnomon_in(folder.path(), {"render", "short_sighted.gltf", "--camera", "eye", "--size", "8x8"});
    CAPTURE(ended.err);
    CHECK(ended.exit_code == 1);
    CHECK(ended.err.find("eye") != std::string::npos);
    CHECK(folder.entries() == std::vector<std::string>{"short_sighted.gltf"});
}

TEST_CASE("outputs that cannot be written are failures before any work", "[command][bad-input]") {
    TestFolder const folder;
    write_table(folder);
    write_text(folder / "file", "mine");
    fs::create_directory(folder / "home");
    write_text(folder / "home" / "diary.txt", "mine");
    std::vector<BadCase> const cases = {
        {1, "does not exist", {"render", "table.glb", "--out", "no/such/folder"}},
        {1, "file", {"render", "table.glb", "--out", "file"}},
        {1, "file", {"render", "table.glb", "--out", "file/inside"}},
        {1, "diary.txt", {"compare", "table.glb", "--out", "home"}},
        {1, "stand in", {"compare", "table.glb", "--out", "."}},
        {1, "home", {"render", "table.glb", "--json", "home"}},
        {1, "no/such.json", {"render", "table.glb", "--json", "no/such.json"}},
        {1, "/proc/gnomon", {"render", "table.glb", "--out", "/proc/gnomon"}},
        {1, "no/such.glb", {"scenes", "cubes", "--write", "no/such.glb"}},
    };
    for (BadCase const& bad : cases) check_refused(folder, bad);
    CHECK(read_text(folder / "home" / "diary.txt") == "mine");
    CHECK(read_text(folder / "file") == "mine");
}

TEST_CASE("a folder that gnomon wrote is replaced, and only that", "[command][bad-input]") {
    TestFolder const folder;
    write_table(folder);
    auto const compare = [&](std::string const& resolution) {
        return gnomon_in(folder.path(), {"compare", "table.glb", "--size", "16x16", "--repeats", "1", "--param",
                                         "shadow-map.resolution=" + resolution, "--out", "out"});
    };
    fs::create_directory(folder / "out");
    CHECK(compare("32").exit_code == 0);
    CHECK(fs::exists(folder / "out" / "shadow-map-resolution-32.lit.png"));
    CHECK(compare("64").exit_code == 0);
    CHECK_FALSE(fs::exists(folder / "out" / "shadow-map-resolution-32.lit.png"));
    CHECK(fs::exists(folder / "out" / "shadow-map-resolution-64.lit.png"));
    write_text(folder / "out" / "notes.txt", "mine");
    CHECK(compare("128").exit_code == 1);
    CHECK(read_text(folder / "out" / "notes.txt") == "mine");
    CHECK(fs::exists(folder / "out" / "shadow-map-resolution-64.lit.png"));
    CHECK(folder.entries() == std::vector<std::string>{"out", "table.glb"});
}

TEST_CASE("a full disk is a failure, not silence", "[command][bad-input]") {
    if (!fs::exists("/dev/full")) SKIP("no /dev/full here");
    TestFolder const folder;
    write_table(folder);
    Ended const ended = gnomon_in(folder.path(), {"render", "table.glb", "--size", "8x8", "--json", "/dev/full"});
    CHECK(ended.exit_code == 1);
    CHECK(ended.err.find("/dev/full") != std::string::npos);
}
