// Cascades from frame to frame: what is kept gives the very maps that are drawn anew.

#include "cascade_runs.hpp"

#include <gnomon/raster/cpu_backend.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace gnomon;
using test::CascadeRunner;
using test::Town;
using test::count_of;

struct Shares {
    std::array<double, 4> of_map{};
    std::uint64_t frames = 0;
    std::uint64_t redraws = 0;  ///< Whole ones, after the first frame.

    [[nodiscard]] double mean() const { return (of_map[0] + of_map[1] + of_map[2] + of_map[3]) / (4.0 * static_cast<double>(frames)); }
};

/// Flies along `path` and checks that both ways to keep maps give those that are drawn anew.
Shares fly(std::string const& path, double moving, std::size_t first, std::size_t end) {
    Town town(path, moving);
    core::SerialExecutor executor;
    raster::CpuBackend cpu(executor);
    CascadeRunner csm(cpu, "csm"), cached(cpu, "csm-cached"), scroll(cpu, "csm-scroll");
    Shares shares;
    for (std::size_t i = first; i < end; ++i) {
        pipeline::Frame const frame = town.frame(i);
        auto const anew = csm(frame), kept = cached(frame), scrolled = scroll(frame);
        CHECK(cached.device.codes == csm.device.codes);
        CHECK(scroll.device.codes == csm.device.codes);
        CHECK(scrolled.visibility == anew.visibility);
        CHECK(kept.visibility == anew.visibility);
        if (i == first) continue;
        ++shares.frames;
        for (std::size_t k = 0; k < 4; ++k) {
            std::string const name = "triangles_map_" + std::to_string(k);
            shares.of_map[k] += static_cast<double>(count_of(scrolled, name)) / static_cast<double>(count_of(anew, name));
        }
        for (pipeline::Count const& reason : scrolled.redraw_reasons)
            shares.redraws += reason.name != "volume_moved" && reason.name != "member_joined" ? 1U : 0U;
    }
    std::printf("town %s, %g %% moving, %zu frames: triangles of csm-scroll over csm's %.3f (maps %.3f %.3f %.3f %.3f), %llu whole redraws\n",
                path.c_str(), moving, static_cast<std::size_t>(shares.frames), shares.mean(), shares.of_map[0] / static_cast<double>(shares.frames),
                shares.of_map[1] / static_cast<double>(shares.frames), shares.of_map[2] / static_cast<double>(shares.frames),
                shares.of_map[3] / static_cast<double>(shares.frames), static_cast<unsigned long long>(shares.redraws));
    return shares;
}

/// Of the sheet's cell in `row` of map `k`: pixels of a strong red, and those that are not white.
struct Cell {
    std::uint64_t red = 0;
    std::uint64_t drawn = 0;

    Cell(pipeline::Image const& sheet, int row, int k) {
        for (int y = 0; y < 512; ++y)
            for (int x = 0; x < 512; ++x) {
                std::size_t const pixel = static_cast<std::size_t>(8 + row * 520 + y) * static_cast<std::size_t>(sheet.size_px.x) +
                                          static_cast<std::size_t>(8 + k * 520 + x);
                std::uint8_t const* const rgb = sheet.rgb.data() + pixel * 3;
                red += rgb[0] > 2 * rgb[1] && rgb[0] > 2 * rgb[2] ? 1U : 0U;
                drawn += rgb[0] != 255 || rgb[1] != 255 || rgb[2] != 255 ? 1U : 0U;
            }
    }
};

/// Whatever was kept, each frame's samples are as wrong as with maps drawn anew.
struct Wrongness {
    std::array<pipeline::Workspace, 3> workspaces;
    std::uint64_t samples = 0;
    std::uint64_t wrong = 0;

    void measure(pipeline::Frame const& frame) {
        std::vector<pipeline::RunRequest> requests;
        for (std::size_t i = 0; i < 3; ++i) {
            auto const* const technique = pipeline::find_technique(std::array{"csm", "csm-cached", "csm-scroll"}[i]).value();
            requests.push_back({technique, pipeline::make_params(*technique).value(), &workspaces[i]});
        }
        core::SerialExecutor executor;
        pipeline::CompareConfig config;
        config.images = false;
        auto const compared = pipeline::compare(frame, requests, config, executor).value();
        pipeline::Measures const& anew = compared.runs[0].error;
        samples += anew.samples;
        wrong += anew.wrong;
        for (std::size_t i = 1; i < 3; ++i) {
            pipeline::Measures const& kept = compared.runs[i].error;
            CHECK(kept.wrong_fraction == anew.wrong_fraction);
            CHECK((kept.false_lit == anew.false_lit && kept.false_shadow == anew.false_shadow && kept.acne == anew.acne));
            CHECK(kept.edge_px.mean == anew.edge_px.mean);
        }
    }
};

}  // namespace

TEST_CASE("maps that scroll are wrong where maps drawn anew are, and nowhere else, in every frame of a path", "[pipeline][cascade]") {
    scene::Scene const city = scene::make_procedural({"city", 52'000}).value();
    scene::Geometry const geometry = scene::flatten(city);
    core::SerialExecutor executor;
    Wrongness wrongness;
    std::optional<pipeline::Frame> before;
    for (int i = 0; i < 8; ++i) {
        scene::Camera const& street = *std::find_if(city.cameras.begin(), city.cameras.end(), [](scene::Camera const& c) { return c.name == "street"; });
        math::View view = scene::make_view(street, math::ivec2(128, 72)).value();
        view.eye_m += -view.back * (0.5 * i);
        view = math::looking_along(view, math::dvec3(std::sin(0.12 * i), 0.0, 0.0) - view.back, {0.0, 1.0, 0.0});
        before = pipeline::make_frame(city, geometry, {.view = view, .light = pipeline::sun(math::dvec3(-0.45, -0.8, -0.4)), .before = before ? &*before : nullptr}, executor).value();
        wrongness.measure(*before);
    }
    std::printf("city, 8 frames: %llu of %llu samples wrong, by csm-scroll, csm-cached and csm alike\n", static_cast<unsigned long long>(wrongness.wrong),
                static_cast<unsigned long long>(wrongness.samples));
    CHECK(wrongness.samples > 30'000);
    CHECK(wrongness.wrong > 100);
}

TEST_CASE("maps that scroll are as wrong as those drawn anew along all of town's street with cars about", "[pipeline][cascade][.full]") {
    Town town("street", 10);
    town.truth = true;
    Wrongness wrongness;
    for (std::size_t i = 0; i < 150; ++i) wrongness.measure(town.frame(i));
    std::printf("town street, 10 %% moving, 150 frames: %llu of %llu samples wrong, alike\n", static_cast<unsigned long long>(wrongness.wrong),
                static_cast<unsigned long long>(wrongness.samples));
}

TEST_CASE("a caster whose alpha lies below its cutoff is neither drawn nor counted", "[pipeline][cascade]") {
    scene::Scene lawn;
    lawn.materials.resize(2);
    lawn.materials[1].alpha_mode = scene::AlphaMode::mask;
    lawn.materials[1].base_color.w = 0.2F;
    scene::Mesh squares;
    for (std::uint32_t const material : {0U, 1U}) {
        float const height = material == 0 ? 0.0F : 2.0F;
        scene::Primitive square;
        for (auto const& [x, z] : {std::pair{-5.0F, -5.0F}, {-5.0F, 5.0F}, {5.0F, 5.0F}, {5.0F, -5.0F}}) square.positions.emplace_back(x, height, z);
        square.normals.assign(4, math::vec3(0.0F, 1.0F, 0.0F));
        square.indices = {0, 1, 2, 0, 2, 3};
        square.material = material;
        squares.primitives.push_back(square);
    }
    lawn.meshes.push_back(squares);
    lawn.instances.push_back({"lawn", 0, math::dmat4(1.0)});
    scene::Geometry const geometry = scene::flatten(lawn);
    math::View const view = math::make_perspective({.eye_m = {0, 4, 8}, .target_m = {0, 0, 0}, .size_px = {32, 24}}).value();
    core::SerialExecutor executor;
    raster::CpuBackend cpu(executor);
    pipeline::Frame const frame = pipeline::make_frame(lawn, geometry, {.view = view, .light = pipeline::sun({0.0, -1.0, 0.0}), .truth = false}, executor).value();
    for (char const* name : {"csm", "csm-cached", "csm-scroll"}) {
        CascadeRunner runner(cpu, name, {{"cascades", "1"}});
        runner.device.layers = 1;
        auto const output = runner(frame);
        CHECK(count_of(output, "triangles_drawn") == 2);
        CHECK(count_of(output, "batches_drawn") == 1);
        CHECK(*std::min_element(output.visibility.begin(), output.visibility.end()) == 1.0F);
    }
}

TEST_CASE("the picture of maps that scroll shows in red what was drawn, and asking for it changes no result", "[pipeline][cascade]") {
    Town town("spin", 0);
    core::SerialExecutor executor;
    raster::CpuBackend cpu(executor);
    CascadeRunner plain(cpu, "csm-scroll"), told(cpu, "csm-scroll");
    told.debug = true;
    for (std::size_t i = 0; i < 2; ++i) {
        pipeline::Frame const frame = town.frame(i);
        auto const without = plain(frame), with = told(frame);
        CHECK(without.pictures.empty());
        CHECK(with.visibility == without.visibility);
        CHECK(with.stages.size() == without.stages.size());
        CHECK(with.tint.size() == frame.samples.size());
        REQUIRE(with.pictures.size() == 1);
        pipeline::Image const& sheet = with.pictures.front().image;
        REQUIRE(sheet.size_px == math::ivec2(8 + 4 * 520, 8 + 3 * 520));
        for (int k = 0; k < 4; ++k) {
            Cell const finished(sheet, 0, k), kept(sheet, 1, k), drawn(sheet, 2, k);
            auto const first = told.device.codes.begin() + k * 512 * 512;
            auto const covered = static_cast<std::uint64_t>(std::count_if(first, first + 512 * 512, [](std::uint16_t code) { return code != 65535; }));
            CHECK(finished.drawn == covered);
            CHECK(finished.red == 0);  // nothing moves
            CHECK(kept.drawn + drawn.red == covered);
            CHECK((kept.drawn == 0) == (i == 0));
            if (i != 0) CHECK((drawn.red > 5000 && drawn.red < 30000));
        }
    }
}

TEST_CASE("maps that scroll are those drawn anew, along town's street with cars about", "[pipeline][cascade]") {
    CHECK(fly("street", 10, 40, 46).redraws == 0);
    CHECK(fly("spin", 0, 0, 5).redraws == 0);
}

TEST_CASE("a sun that turns by less than its threshold leaves the maps as they are, in all techniques alike", "[pipeline][cascade]") {
    Town town("street", 0);
    core::SerialExecutor executor;
    raster::CpuBackend cpu(executor);
    std::vector<pipeline::Setting> const slow{{"turn", "1"}, {"resolution", "64"}};
    CascadeRunner csm(cpu, "csm", slow), scroll(cpu, "csm-scroll", slow);
    csm.device.size_px = scroll.device.size_px = 64;
    math::dvec3 const rest = town.scene.lights.front().direction;
    std::uint64_t turns = 0;
    for (int i = 0; i < 5; ++i) {  // 0.4 degrees a frame
        town.scene.lights.front().direction = rest + math::dvec3(0.007 * i, 0.0, 0.0);
        pipeline::Frame const frame = town.frame(50);
        auto const anew = csm(frame), kept = scroll(frame);
        CHECK(csm.device.codes == scroll.device.codes);
        for (pipeline::Count const& reason : kept.redraw_reasons) turns += reason.name == "light_posed" ? reason.value : 0;
        CHECK(count_of(anew, "triangles_drawn") > 0);
        CHECK((count_of(kept, "triangles_drawn") > 0) == (i == 0 || i == 3));
    }
    CHECK(turns == 4);
}

TEST_CASE("at the paper's speeds maps that scroll draw few of the triangles", "[pipeline][cascade][.full]") {
    CHECK(fly("street", 0, 0, 150).mean() <= 0.12);
    CHECK(fly("spin", 0, 0, 150).mean() <= 0.18);
    CHECK(fly("street", 10, 0, 150).mean() < 0.5);
    CHECK(fly("both", 20, 0, 150).mean() < 0.6);
}
