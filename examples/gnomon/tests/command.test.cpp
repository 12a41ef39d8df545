// The real binary, on small scenes.

#include "fixtures.hpp"
#include "written.hpp"

#include <gnomon/check/check.hpp>

#include <algorithm>

using namespace gnomon::command;
using nlohmann::json;

namespace {

std::vector<std::string> words(std::string const& text) {
    std::istringstream in(text);
    return {std::istream_iterator<std::string>(in), {}};
}
}  // namespace

TEST_CASE("compare writes a folder that is whole: page, pictures, results", "[command]") {
    TestFolder const folder;
    std::string const scene = write_table(folder);
    auto const [ended, results] = written_by(folder, {"compare", scene, "--techniques", "shadow-map,ray", "--param", "shadow-map.resolution=32,512",
                                                      "--size", "96x64", "--repeats", "1"});
    REQUIRE(results["runs"].size() == 3);
    json const& runs = results["runs"];
    CHECK(runs[0]["params"]["resolution"] == 32);
    CHECK(runs[2]["technique"] == "ray");
    CHECK(runs[2]["error"]["wrong"] == 0);
    CHECK(runs[0]["error"]["wrong"] > 0);
    CHECK(runs[1]["error"]["wrong_fraction"] < runs[0]["error"]["wrong_fraction"]);
    std::vector<std::string> listed = results["gnomon"]["files"];
    std::sort(listed.begin(), listed.end());
    std::vector<std::string> found;
    for (auto const& entry : fs::directory_iterator(folder / "out")) found.push_back(entry.path().filename().string());
    std::sort(found.begin(), found.end());
    CHECK(found == listed);
    CHECK(folder.entries() == std::vector<std::string>{"out", "table.glb"});
    for (std::string const& name : found)
        if (name.ends_with(".png")) CHECK(has(read_text(folder / "out" / name).substr(0, 8), "PNG"));
    CHECK_FALSE(has(ended.out + ended.err, "\x1b"));
    CHECK(has(ended.out, "shadow-map resolution=512"));
    CHECK(ended.err.empty());
}

TEST_CASE("many lights are compared by image and by work; with shadows they do not mix", "[command]") {
    TestFolder const folder;
    std::vector<std::string> const scene{"atrium", "--lights", "300", "--size", "96x54", "--repeats", "1"};
    std::vector<std::string> words{"compare"};
    words.insert(words.end(), scene.begin(), scene.end());
    words.insert(words.end(), {"--techniques", "deferred-stencil,tiled-deferred,tiled-forward-prez", "--param",
                               "tiled-deferred.tile=16,32"});
    auto const [ended, results] = written_by(folder, words);
    json const& runs = results["runs"];
    REQUIRE(runs.size() == 4);
    auto const computations = [&](std::size_t run) { return runs[run]["counts"]["lighting_computations"].get<std::uint64_t>(); };
    CHECK(computations(0) > 0);
    CHECK(computations(0) < computations(1));
    CHECK(computations(1) < computations(2));
    for (json const& run : runs) {
        CHECK(run["error"]["wrong"] == 0);
        CHECK(run["error"]["radiance_error"] == 0.0);
        CHECK_FALSE(run["error"].contains("false_lit"));
        CHECK(run["light"] == "all 300 lights of the scene");
    }
    std::string const page = read_text(folder / "out/index.html");
    CHECK(has(page, "All images are the same to the last bit"));
    CHECK(fs::exists(folder / "out/tiled-deferred-tile-16.lights.png"));

    Ended const mixed = gnomon_in(folder.path(), {"compare", "atrium", "--techniques", "ray,tiled-deferred"});
    CHECK(mixed.exit_code == 2);
    CHECK(has(mixed.err, "--techniques ray,tiled-deferred: the first draws the shadows of one light"));
    Ended const unknown = gnomon_in(folder.path(), {"compare", "atrium", "--techniques", "clustered"});
    CHECK(unknown.exit_code == 2);
    CHECK(has(unknown.err, "for many lights, deferred, "));
}

TEST_CASE("bench lights puts our figures beside the papers'", "[command]") {
    TestFolder const folder;
    auto const [ended, results] = written_by(folder, {"bench", "lights", "--size", "64x36", "--frames", "2", "--most-lights", "300"});
    std::size_t exact = 0, coarse = 0;
    for (json const& run : results["runs"]) {
        if (run["error"].is_null()) continue;
        bool const halves = run["params"]["gbuffer"] == "f16";
        (halves ? coarse : exact) += 1;
        if (!halves) CHECK(run["error"]["wrong"] == 0);
        if (halves) CHECK(run["error"]["radiance_error"] < 0.01);
    }
    CHECK(exact > 20);
    CHECK(coarse >= 6);
    CHECK(has(ended.out, "[Paper I, table 2]"));
    CHECK(has(ended.out, "[Paper II, table 2]"));
    CHECK(has(read_text(folder / "out/index.html"), "Where tiled and clustered cross"));
    Ended const unknown = gnomon_in(folder.path(), {"bench", "shadows"});
    CHECK(unknown.exit_code == 2);
    CHECK(has(unknown.err, "gnomon bench shadows: there is no such benchmark; there are lights and cascades"));
}

TEST_CASE("bench cascades shows how little maps that scroll have to draw", "[command]") {
    TestFolder const folder;
    auto const [ended, results] = written_by(folder, {"bench", "cascades", "--size", "64x36", "--frames", "3", "--motions", "street-10,sun"});
    REQUIRE(results["runs"].size() == 2 * 3);
    std::uint64_t scrolls = 0;
    for (std::size_t i = 0; i < 2 * 3; i += 3) {
        CHECK(results["runs"][i + 2]["counts"]["triangles_drawn"] <= results["runs"][i]["counts"]["triangles_drawn"]);
        scrolls += results["runs"][i + 2]["redraw_reasons"].value("volume_moved", 0U);
    }
    CHECK(scrolls >= 6);
    CHECK(results["runs"][5]["redraw_reasons"].value("light_posed", 0U) == 8);  // a sun that moves leaves nothing to keep
    CHECK(has(read_text(folder / "out/index.html"), "10 % of the props move"));
    Ended const other = gnomon_in(folder.path(), {"bench", "cascades", "--motions", "walk"});
    CHECK(other.exit_code == 2);
    CHECK(has(other.err, "--motions walk: there is no such motion; there are still, "));
    Ended const lit = gnomon_in(folder.path(), {"bench", "cascades", "--most-lights", "5"});
    CHECK(lit.exit_code == 2);
    CHECK(has(lit.err, "--most-lights"));
}

TEST_CASE("the page loads nothing from elsewhere", "[command]") {
    TestFolder const folder;
    Ended const ended =
        gnomon_in(folder.path(), {"compare", write_table(folder), "--size", "48x32", "--repeats", "1", "--out", "out"});
    REQUIRE(ended.exit_code == 0);
    std::string const page = read_text(folder / "out" / "index.html");
    for (char const* outside : {"http:", "https:", "url(", "@import", "<link", "src='/", "src=\""}) {
        CAPTURE(outside);
        CHECK_FALSE(has(page, outside));
    }
    CHECK(has(page, "data:image/png;base64,iVBOR"));
    CHECK(has(page, "<svg"));
    CHECK(has(page, "prefers-color-scheme: dark"));
}

TEST_CASE("the view and the light in results.json give the same samples and errors again", "[command]") {
    TestFolder const folder;
    std::string const scene = write_table(folder);
    for (char const* extra : {"", "--camera front", "--sun 0.3,-1,0.2", "--eye 3,4,5 --look 0,0.1,0 --fov 40"}) {
        CAPTURE(extra);
        std::vector<std::string> first = {"compare", scene, "--repeats", "1", "--size", "64x48", "--out", "a"};
        for (std::string const& word : words(extra)) first.push_back(word);
        REQUIRE(gnomon_in(folder.path(), first).exit_code == 0);
        json const a = results_in(folder / "a")["runs"][0];
        std::vector<std::string> second = {"compare", scene, "--repeats", "1", "--out", "b"};
        for (char const* key : {"view", "light"})
            for (std::string const& word : words(a[key])) second.push_back(word);
        REQUIRE(gnomon_in(folder.path(), second).exit_code == 0);
        json const b = results_in(folder / "b")["runs"][0];
        CHECK(a["error"] == b["error"]);
        CHECK(a["view"] == b["view"]);
        CHECK(a["light"] == b["light"]);
    }
}

TEST_CASE("pictures and errors are the same for any number of threads", "[command]") {
    TestFolder const folder;
    std::string const scene = write_table(folder);
    for (char const* threads : {"1", "3"})
        REQUIRE(gnomon_in(folder.path(), {"compare", scene, "--threads", threads, "--size", "80x60", "--repeats", "1",
                                          "--out", std::string("t") + threads})
                    .exit_code == 0);
    json const one = results_in(folder / "t1");
    json const three = results_in(folder / "t3");
    CHECK(three["runs"][0]["threads"] == 3);
    for (std::size_t i = 0; i < one["runs"].size(); ++i) CHECK(one["runs"][i]["error"] == three["runs"][i]["error"]);
    for (std::string const name : one["gnomon"]["files"])
        if (name.ends_with(".png")) CHECK(read_text(folder / "t1" / name) == read_text(folder / "t3" / name));
}

TEST_CASE("render draws one picture a run, and JSON on standard output stands alone", "[command]") {
    TestFolder const folder;
    Ended const ended = gnomon_in(folder.path(), {"render", write_table(folder), "--size", "48x32", "--json", "-"});
    CAPTURE(ended.err);
    REQUIRE(ended.exit_code == 0);
    json const results = json::parse(ended.out, nullptr, false);
    REQUIRE(results.is_object());
    CHECK(first_error(results) == "");
    CHECK(has(ended.err, "shadow-map"));
    CHECK(fs::exists(folder / "gnomon-render" / "shadow-map.png"));
    CHECK_FALSE(fs::exists(folder / "gnomon-render" / "index.html"));
    CHECK(gnomon_in(folder.path(), {"render", "table.glb", "--size", "8x8", "--json", "r.json"}).exit_code == 0);
    CHECK(json::parse(read_text(folder / "r.json"), nullptr, false).is_object());
}

TEST_CASE("a view of nothing is a picture of the sky, not an error", "[command]") {
    TestFolder const folder;
    Ended const ended = gnomon_in(folder.path(), {"compare", write_table(folder), "--eye", "0,50,0", "--look", "0,90,0",
                                                  "--size", "16x16", "--repeats", "1", "--out", "sky"});
    CAPTURE(ended.err);
    CHECK(ended.exit_code == 0);
    CHECK(results_in(folder / "sky")["runs"][0]["error"]["samples"] == 0);
}

TEST_CASE("scenes lists, describes and writes", "[command]") {
    TestFolder const folder;
    Ended const list = gnomon_in(folder.path(), {"scenes"});
    CHECK(list.exit_code == 0);
    for (char const* name : {"city", "cubes", "rayyard", "sheet"}) CHECK(has(list.out, name));
    REQUIRE(gnomon_in(folder.path(), {"scenes", "cubes", "--write", "c.glb"}).exit_code == 0);
    Ended const built_in = gnomon_in(folder.path(), {"scenes", "cubes"});
    Ended const file = gnomon_in(folder.path(), {"scenes", "c.glb"});
    CHECK(file.exit_code == 0);
    CHECK(built_in.out.substr(built_in.out.find('\n')) == file.out.substr(file.out.find('\n')));
}

TEST_CASE("both backends stand in one table, one page and one results.json, with the same errors", "[command]") {
    TestFolder const folder;
    (void)write_table(folder);
    Ended const ended = gnomon_in(folder.path(), {"compare", "table.glb", "--size", "96x64", "--backend", "cpu,vulkan",
                                                  "--param", "shadow-map.resolution=256", "--out", "both"});
    if (ended.exit_code == 1 && has(ended.err, "there is no Vulkan here")) SKIP(ended.err);
    REQUIRE(ended.exit_code == 0);
    json const results = results_in(folder / "both");
    CHECK(first_error(results) == "");
    json const& runs = results["runs"];
    REQUIRE(runs.size() == 4);
    for (std::size_t i = 0; i < 4; i += 2) {
        CHECK(runs[i]["backend"] == "cpu");
        CHECK(runs[i + 1]["backend"] == "vulkan");
        CHECK(runs[i]["technique"] == runs[i + 1]["technique"]);
        CHECK(runs[i]["device"] != runs[i + 1]["device"]);
        for (char const* what : {"samples", "wrong", "false_lit", "false_shadow"})
            CHECK(runs[i]["error"][what] == runs[i + 1]["error"][what]);
        CHECK(runs[i]["ms"]["stages"].size() == runs[i + 1]["ms"]["stages"].size());
    }
    CHECK(has(ended.out, "shadow-map resolution=256 on vulkan"));
    CHECK(has(read_text(folder / "both/index.html"), "ray on vulkan"));
}

TEST_CASE("info names techniques and their parameters", "[command]") {
    TestFolder const folder;
    Ended const info = gnomon_in(folder.path(), {"info"});
    CHECK(info.exit_code == 0);
    for (char const* part : {"shadow-map.resolution", "ray", "backends", "cpu", "fmt"}) CHECK(has(info.out, part));
    Ended const devices = gnomon_in(folder.path(), {"info", "--devices"});
    bool const listed = devices.exit_code == 0 && has(devices.out, "Vulkan 1.");
    CHECK((listed || (devices.exit_code == 1 && has(devices.err, "there is no Vulkan here"))));
    CHECK(gnomon_in(folder.path(), {"--version"}).out == "gnomon " GNOMON_VERSION "\n");
    CHECK(gnomon_in(folder.path(), {"compare", "--help"}).exit_code == 0);
}
