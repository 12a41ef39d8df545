// Paths, with the real binary on a small scene that slides.

#include "fixtures.hpp"
#include "report.hpp"
#include "written.hpp"

#include <gnomon/check/check.hpp>

#include <algorithm>

using namespace gnomon::command;
using nlohmann::json;

namespace {

/// The table, whose instance slides by 1 m along x within 2 s.
std::string write_sliding_table(TestFolder const& folder) {
    gnomon::scene::Scene scene = table_with_lid();
    gnomon::scene::Node node;
    node.name = "slide";
    scene.nodes.push_back(node);
    scene.instances[0].node = 0;
    gnomon::scene::AnimationChannel channel;
    channel.node = 0;
    channel.times_s = {0.0F, 2.0F};
    channel.values = {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F};
    scene.animations.push_back({"slide", {channel}});
    gnomon::scene::settle(scene);
    std::string const path = (folder / "sliding.glb").string();
    return gnomon::scene::write_gltf(scene, path) ? path : "could not write " + path;
}

}  // namespace

TEST_CASE("a flight leaves a film, pictures, a page and a table of every frame", "[command][flight]") {
    TestFolder const folder;
    Ended const ended =
        gnomon_in(folder.path(), {"flythrough", write_sliding_table(folder), "--path", "orbit", "--frames", "4",
                                  "--techniques", "shadow-map,ray", "--size", "64x48", "--out", "out"});
    CAPTURE(ended.err, ended.out);
    REQUIRE(ended.exit_code == 0);
    json const results = results_in(folder / "out");
    CHECK(first_error(results) == "");
    REQUIRE(results["runs"].size() == 2);
    for (json const& run : results["runs"]) {
        REQUIRE(run["frames"].size() == 4);
        std::uint64_t wrong = 0;
        std::uint64_t samples = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            CHECK(run["frames"][i]["frame"] == i);
            CHECK(std::abs(run["frames"][i]["time_s"].get<double>() - static_cast<double>(i) / 30.0) < 1e-9);
            wrong += run["frames"][i]["error"]["wrong"].get<std::uint64_t>();
            samples += run["frames"][i]["error"]["samples"].get<std::uint64_t>();
        }
        CHECK(run["error"]["wrong"] == wrong);
        CHECK(run["error"]["samples"] == samples);
    }
    CHECK(results["runs"][1]["error"]["wrong"] == 0);
    for (char const* name : {"shadow-map.webp", "shadow-map.wrong.webp", "ray.webp", "reference.webp"}) {
        std::string const film = read_text(folder / "out" / name);
        CAPTURE(name);
        REQUIRE(film.size() > 12);
        CHECK(film.substr(0, 4) == "RIFF");
        CHECK(film.substr(8, 4) == "WEBP");
    }
    for (char const* name : {"shadow-map.0000.png", "ray.0003.png"}) CHECK(fs::exists(folder / "out" / name));
    std::string const csv = read_text(folder / "out" / "frames.csv");
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 1 + 2 * 4);
    std::string const page = read_text(folder / "out" / "index.html");
    CHECK(has(page, "data:image/webp;base64,"));
    for (char const* outside : {"http:", "https:", "url(", "<link"}) CHECK_FALSE(has(page, outside));
    std::vector<std::string> listed = results["gnomon"]["files"];
    std::sort(listed.begin(), listed.end());
    std::vector<std::string> found;
    for (auto const& entry : fs::directory_iterator(folder / "out")) found.push_back(entry.path().filename().string());
    std::sort(found.begin(), found.end());
    CHECK(found == listed);
    CHECK(folder.entries() == std::vector<std::string>{"out", "sliding.glb"});
}

TEST_CASE("a frame of a flight has the errors of the same view at the same time", "[command][flight]") {
    TestFolder const folder;
    std::string const scene = write_sliding_table(folder);
    std::vector<std::string> const eye = {"--eye", "3,4,5", "--look", "0,0.1,0", "--size", "64x48"};
    std::vector<std::string> film = {"flythrough", scene, "--frames", "31", "--out", "film"};
    std::vector<std::string> still = {"compare", scene, "--techniques", "shadow-map", "--time", "1", "--out", "still"};
    film.insert(film.end(), eye.begin(), eye.end());
    still.insert(still.end(), eye.begin(), eye.end());
    REQUIRE(gnomon_in(folder.path(), film).exit_code == 0);
    REQUIRE(gnomon_in(folder.path(), still).exit_code == 0);
    json const frames = results_in(folder / "film")["runs"][0]["frames"];
    json const one = results_in(folder / "still")["runs"][0];
    REQUIRE(frames.size() == 31);
    CHECK(frames[30]["error"] == one["error"]);
    CHECK(frames[0]["error"] != frames[30]["error"]);
    CHECK(has(one["view"], "--time 1"));
    // What does not move is the same at any time.
    CHECK(gnomon_in(folder.path(), {"render", write_table(folder), "--time", "1", "--size", "8x8"}).exit_code == 0);
}

TEST_CASE("compare and render fly too; without the truth there are no errors", "[command][flight]") {
    TestFolder const folder;
    std::string const scene = write_table(folder);
    REQUIRE(gnomon_in(folder.path(),
                      {"compare", scene, "--path", "orbit", "--frames", "2", "--size", "32x24", "--out", "c"})
                .exit_code == 0);
    CHECK(first_error(results_in(folder / "c")) == "");
    CHECK(fs::exists(folder / "c" / "index.html"));
    CHECK_FALSE(fs::exists(folder / "c" / "shadow-map.webp"));
    Ended const drawn = gnomon_in(folder.path(), {"render", scene, "--path", "orbit", "--frames", "2", "--no-truth",
                                                  "--size", "32x24", "--out", "r"});
    CAPTURE(drawn.err, drawn.out);
    REQUIRE(drawn.exit_code == 0);
    json const results = results_in(folder / "r");
    CHECK(first_error(results) == "");
    CHECK(results["runs"][0]["error"].is_null());
    CHECK(results["runs"][0]["frames"][1]["error"].is_null());
    CHECK_FALSE(has(drawn.out, "wrong"));
    CHECK(fs::exists(folder / "r" / "shadow-map.0001.png"));
    Ended const still = gnomon_in(folder.path(), {"render", scene, "--no-truth", "--size", "16x16", "--out", "s"});
    CHECK(still.exit_code == 0);
    CHECK(first_error(results_in(folder / "s")) == "");
}

TEST_CASE("a path that cannot be flown is refused with its names", "[command][flight]") {
    TestFolder const folder;
    std::string const scene = write_table(folder);
    auto const refused = [&](std::vector<std::string> arguments, char const* part) {
        auto const before = folder.entries();
        Ended const ended = gnomon_in(folder.path(), std::move(arguments));
        CAPTURE(ended.err);
        CHECK(ended.exit_code == 2);
        CHECK(has(ended.err, part));
        CHECK(folder.entries() == before);
    };
    refused({"flythrough", scene, "--path", "orbitt"}, "did you mean 'orbit'");
    refused({"flythrough", scene, "--frames", "0"}, "--frames 0");
    refused({"render", scene, "--frames", "3"}, "--path");
    refused({"flythrough", scene, "--path", "orbit", "--camera", "front"}, "leave one of them out");
    refused({"render", scene, "--time", "nan"}, "nan");
    refused({"render", scene, "--clip", "walk"}, "--clip walk");
    refused({"compare", scene, "--no-truth"}, "--no-truth");
    refused({"flythrough", "city", "--path", "street", "--frames", "301"}, "--frames 301");
}

TEST_CASE("a path's report sums errors and counts and takes the median time", "[flight]") {
    std::vector<FrameRecord> frames(3);
    for (std::uint32_t i = 0; i < 3; ++i) {
        FrameRecord& frame = frames[i];
        frame.ms = 10.0 * (3 - i);
        frame.error.samples = 100;
        frame.error.wrong = i;
        frame.error.false_lit = i;
        frame.error.edge_px = {i * 2.0, i * 3.0, i * 4.0};
        frame.error.visibility_error_mean = 0.1 * i;
        frame.counts = {{"draw_calls", i + 1}};
    }
    gnomon::pipeline::RunReport const total = total_of(frames, {});
    CHECK(total.ms.median == 20.0);
    CHECK(total.ms.min == 10.0);
    CHECK(total.ms.max == 30.0);
    CHECK(total.error.samples == 300);
    CHECK(total.error.wrong == 3);
    CHECK(total.error.wrong_fraction == 0.01);
    CHECK(std::abs(total.error.edge_px.mean - (1 * 2.0 + 2 * 4.0) / 3.0) < 1e-12);
    CHECK(total.error.edge_px.max == 8.0);
    CHECK(std::abs(total.error.visibility_error_mean - 0.1) < 1e-12);
    REQUIRE(total.counts.size() == 1);
    CHECK(total.counts[0].value == 6);
}

TEST_CASE("with --debug, techniques that keep maps show them: files, a film, the page", "[command][flight]") {
    TestFolder const folder;
    std::string const scene = write_sliding_table(folder);
    std::vector<std::string> const run = {scene, "--sun", "0.3,-1,0.2", "--techniques", "shadow-map,csm-scroll,shadow-map-cached", "--param", "csm-scroll.resolution=64",
                                          "--size", "32x24", "--debug"};
    auto const with = [&](std::vector<std::string> words, std::vector<std::string> const& more) {
        words.insert(words.end(), run.begin(), run.end());
        words.insert(words.end(), more.begin(), more.end());
        Ended const ended = gnomon_in(folder.path(), words);
        CAPTURE(ended.err);
        CHECK(ended.exit_code == 0);
    };
    with({"flythrough"}, {"--frames", "2", "--no-truth", "--out", "film"});
    for (char const* name : {"csm-scroll-resolution-64.maps.0001.png", "csm-scroll-resolution-64.tint.0000.png", "csm-scroll-resolution-64.maps.webp", "shadow-map-cached.maps.0001.png"}) {
        CAPTURE(name);
        CHECK(fs::exists(folder / "film" / name));
    }
    CHECK(has(read_text(folder / "film" / "index.html"), "How they got there"));
    CHECK(has(read_text(folder / "film" / "results.json"), "csm-scroll-resolution-64.tint.webp"));
    CHECK(first_error(results_in(folder / "film")) == "");
    json const runs = results_in(folder / "film")["runs"];
    CHECK_FALSE(runs[0].contains("map_texel_m"));
    REQUIRE(runs[1]["map_texel_m"].size() == 4);
    CHECK(runs[1]["map_texel_m"][0] < runs[1]["map_texel_m"][3]);
    with({"compare"}, {"--repeats", "1", "--out", "page"});
    CHECK(fs::exists(folder / "page" / "csm-scroll-resolution-64.maps.png"));
    CHECK_FALSE(fs::exists(folder / "page" / "shadow-map.maps.png"));
    CHECK(has(read_text(folder / "page" / "index.html"), "csm-scroll resolution=64, maps"));
}
