// Maps that scroll, on the device: scrolled and filled at their borders against drawn anew, frame by frame along the
// motions of [CSM Scrolling]. By integer passes nothing may differ, by those whose codes the device finds none by more than
// one; by ordinary ones it is counted what does.

#include "pass_scenes.hpp"
#include "test_host.hpp"

#include <gnomon/cache/box.hpp>
#include <gnomon/cascade.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/scene.hpp>
#include <gnomon/vulkan/backend.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

using namespace gnomon;

namespace {

constexpr std::int32_t map_px = 512;
constexpr std::uint32_t map_count = 4;

/// How far codes that ought to be equal are apart.
struct CodesApart {
    std::uint64_t texels = 0;
    std::uint64_t written = 0;
    std::uint64_t by_one = 0;
    std::uint64_t by_more = 0;   ///< On what is still one surface: up to 64.
    std::uint64_t surfaces = 0;  ///< Beyond: an edge that covers another texel.

    void add(std::uint16_t scrolled, std::uint16_t drawn, std::uint16_t farthest) {
        int const apart = std::abs(int{scrolled} - int{drawn});
        ++texels;
        written += drawn != farthest ? 1U : 0U;
        by_one += apart == 1 ? 1U : 0U;
        by_more += apart > 1 && apart <= 64 ? 1U : 0U;
        surfaces += apart > 64 ? 1U : 0U;
    }
};

/// How maps are drawn.
enum Passes : std::size_t {
    integer,    ///< In whole units.
    near,       ///< In whole units, with `codes_by_device`.
    ordinary,   ///< With matrices.
    pass_kinds,
};
constexpr char const* pass_names[] = {"integer", "codes by the device", "ordinary"};

struct WalkReport {
    std::array<CodesApart, pass_kinds> apart{};
    std::array<double, pass_kinds> ms{};  ///< The device's.
    std::uint64_t frames = 0;
    std::uint64_t scrolls = 0;
    std::uint64_t depth_moves = 0;
};

using MapImages = std::array<std::vector<std::uint16_t>, map_count>;

/// A backend with a list and a target for the maps.
struct MapDrawer {
    std::unique_ptr<vulkan::Backend> device;
    backend::DrawListId list;
    backend::TargetId target;

    MapDrawer(vulkan::test::Device& on, vulkan::test::TestHost& host, std::span<backend::Draw const> draws, bool codes_by_device) {
        auto made = vulkan::Backend::make(on.gpu(), host.host(), {.codes_by_device = codes_by_device});
        REQUIRE(made);
        device = *std::move(made);
        auto const kept = device->keep(draws);
        auto const maps =
            device->make_target({.size_px = {map_px, map_px}, .layers = map_count, .depth = backend::DepthFormat::unorm16});
        REQUIRE((kept && maps && device->finish()));  // one frame is recorded at a time
        list = *kept;
        target = *maps;
    }
};

/// A scene's maps on a device, and the copies that are scrolled.
class ScrolledWalk {
  public:
    ScrolledWalk(vulkan::test::Device& device, std::string const& scene_name, math::Depth depth) : host_(device), depth_(depth) {
        auto made = scene::make_procedural({.name = scene_name});
        REQUIRE(made);
        geometry_ = scene::flatten(*made);
        for (scene::Range const& range : geometry_.ranges) {
            backend::Draw draw;
            draw.positions = std::span<math::vec3 const>(geometry_.positions);
            draw.indices = std::span<std::uint32_t const>(geometry_.indices)
                               .subspan(std::size_t{range.first_triangle} * 3, std::size_t{range.triangle_count} * 3);
            math::Aabb box;
            for (std::size_t i = 0; i < draw.indices.size(); ++i) box = math::extended(box, geometry_.positions[draw.indices[i]]);
            draws_.push_back(draw);
            boxes_.push_back(box);
        }
        for (bool const codes_by_device : {false, true})
            drawers_.push_back(std::make_unique<MapDrawer>(device, host_, draws_, codes_by_device));
        config_.direction = math::dvec3(-0.45, -0.8, -0.4);
        config_.anchor_m = geometry_.origin_m;
        config_.splits.far_m = 120.0;
    }

    void step(math::View const& camera, WalkReport& report) {
        auto const plan = cascade::plan(cascades_, config_, camera);
        REQUIRE(plan);
        REQUIRE(plan->count == map_count);
        for (std::size_t kind = 0; kind < pass_kinds; ++kind) {
            MapDrawer& drawer = *drawers_[kind == near ? 1U : 0U];
            drawer.device->stage("pass");
            if (kind == ordinary) draw_ordinary(drawer, *plan);
            else draw_integer(drawer, *plan);
            MapImages drawn;
            report.ms[kind] += read(drawer, drawn);
            compare(*plan, drawn, held_[kind], report.apart[kind]);
        }
        for (cascade::CascadePlan const& map : plan->cascades) {
            if (map.update.action != cascade::Action::scroll) continue;
            ++report.scrolls;
            report.depth_moves += map.update.shift.z != 0 ? 1U : 0U;
        }
        cascade::commit(cascades_, *plan);
        ++report.frames;
    }

  private:
    void draw_integer(MapDrawer& drawer, cascade::CascadeFrame const& plan) {
        std::array<backend::OrthoLayer, map_count> layers;
        std::array<std::vector<std::uint32_t>, map_count> casters;
        for (std::uint32_t k = 0; k < map_count; ++k) {
            cascade::Volume const& v = plan.cascades[k].volume;
            for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
                cache::LightUnits const units{plan.light.right, plan.light.down, plan.light.away, v.texel_m, v.depth_unit_m};
                auto const box = cache::enclose(units, math::to_double(boxes_[i].lo), math::to_double(boxes_[i].hi));
                if (box && cache::may_touch(*box, {v.at.x, v.at.y, v.at.z, v.size_px, v.size_px, v.codes})) casters[k].push_back(i);
            }
            layers[k].light = {plan.light.right, plan.light.down, plan.light.away, v.texel_m, v.depth_unit_m, v.at.x, v.at.y, v.at.z};
            layers[k].draws = casters[k];
            layers[k].layer = k;
            layers[k].depth = depth_;
        }
        REQUIRE(drawer.device->draw_ortho(drawer.list, drawer.target, layers));
    }

    /// Positions are taken relative to the anchor: it stays where it is, so that their differences do too.
    void draw_ordinary(MapDrawer& drawer, cascade::CascadeFrame const& plan) {
        std::array<backend::PassLayer, map_count> layers;
        for (std::uint32_t k = 0; k < map_count; ++k) {
            math::View view = cascade::view_of(plan.light, plan.cascades[k].volume, plan.anchor_m, plan.anchor_m, depth_);
            layers[k].clip_from_relative = math::clip_from_relative(view);
            layers[k].layer = k;
            layers[k].depth = depth_;
            layers[k].range = backend::DepthRange::clamp;
        }
        REQUIRE(drawer.device->draw(drawer.list, drawer.target, layers));
    }

    /// returns: how long the pass took, in ms.
    static double read(MapDrawer& drawer, MapImages& out) {
        drawer.device->stage("read");
        for (std::uint32_t k = 0; k < map_count; ++k) {
            out[k].resize(std::size_t{map_px} * map_px);
            REQUIRE(drawer.device->read({drawer.target, k, backend::Plane::depth, {0, 0, map_px, map_px}}, std::as_writable_bytes(std::span(out[k]))));
        }
        auto const times = drawer.device->finish();
        REQUIRE(times);
        return times->empty() ? 0.0 : times->front().ms;
    }

    /// Scrolls what is held, fills the strips from what was drawn, and compares the rest with it.
    void compare(cascade::CascadeFrame const& plan, MapImages const& drawn, MapImages& held, CodesApart& apart) const {
        for (std::uint32_t k = 0; k < map_count; ++k) {
            cascade::Update const& update = plan.cascades[k].update;
            if (update.action == cascade::Action::redraw) held[k] = drawn[k];
            if (update.action == cascade::Action::scroll) {
                std::vector<std::uint16_t> next(held[k].size());
                cascade::MapTexels<std::uint16_t const> const from{held[k].data(), map_px, map_px};
                auto const stats = cascade::scroll(from, cascade::MapTexels<std::uint16_t>{next.data(), map_px, map_px},
                                                   {update.shift, cascade::unorm16_codes, depth_});
                REQUIRE(stats.clamped == 0);  // the depth range holds the whole scene: what is clamped is not told here
                fill(update.exposed, drawn[k], next);
                held[k] = std::move(next);
            }
            for (std::size_t i = 0; i < held[k].size(); ++i) apart.add(held[k][i], drawn[k][i], depth_ == math::Depth::forward ? 65535 : 0);
        }
    }

    static void fill(cascade::ExposedRects const& exposed, std::vector<std::uint16_t> const& from, std::vector<std::uint16_t>& to) {
        for (std::int32_t r = 0; r < exposed.count; ++r) {
            cascade::TexelRect const& rect = exposed.rects[static_cast<std::size_t>(r)];
            for (std::int32_t y = rect.y; y < rect.y + rect.height; ++y)
                std::copy_n(from.begin() + std::ptrdiff_t{y} * map_px + rect.x, rect.width, to.begin() + std::ptrdiff_t{y} * map_px + rect.x);
        }
    }

    vulkan::test::TestHost host_;
    math::Depth depth_;
    scene::Geometry geometry_;
    std::vector<backend::Draw> draws_;
    std::vector<math::Aabb> boxes_;
    std::vector<std::unique_ptr<MapDrawer>> drawers_;
    cascade::CascadeConfig config_;
    cascade::Cascades cascades_;
    std::array<MapImages, pass_kinds> held_;
};

WalkReport walk(std::string const& path_name, std::size_t frames, math::Depth depth) {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    WalkReport report;
    {
        ScrolledWalk walk(*device, "town", depth);
        auto const path = scene::make_path({.name = "town"}, path_name);
        REQUIRE(path);
        for (std::size_t i = 0; i < frames; ++i) {
            auto const view = scene::make_view(path->frames[i % path->frames.size()], {1280, 720});
            REQUIRE(view);
            walk.step(*view, report);
        }
    }
    CHECK(device->take_messages() == "");
    auto const per_frame = [&](std::uint64_t n) { return static_cast<double>(n) / static_cast<double>(frames); };
    std::printf("%s, %s, %zu frames, %llu scrolls, %llu in depth\n", path_name.c_str(), depth == math::Depth::forward ? "forward" : "reversed",
                frames, static_cast<unsigned long long>(report.scrolls), static_cast<unsigned long long>(report.depth_moves));
    for (std::size_t kind = 0; kind < pass_kinds; ++kind) {
        CodesApart const& apart = report.apart[kind];
        std::printf("  %s, a frame: %.1f by one code, %.1f by 2 to 64, %.1f by more, of %.0f; %.2f ms\n", pass_names[kind],
                    per_frame(apart.by_one), per_frame(apart.by_more), per_frame(apart.surfaces), per_frame(apart.texels),
                    report.ms[kind] / static_cast<double>(frames));
    }
    return report;
}

void check_walk(WalkReport const& report) {
    CHECK(report.apart[integer].by_one == 0);
    for (Passes const kind : {integer, near}) {
        CHECK(report.apart[kind].by_more == 0);
        CHECK(report.apart[kind].surfaces == 0);
        CHECK(report.apart[kind].written > report.apart[kind].texels / 2);
    }
    // Floats are near a tie between codes where exact depths are: once in a few hundred texels.
    CHECK(report.apart[near].by_one > 0);
    CHECK(report.apart[near].by_one < report.apart[near].texels / 200);
    // Ordinary passes round corners to float in each view anew, and cut triangles at the view's border: once in a while an
    // edge goes to another 1/256 texel, on whose other side a texel's centre lies.
    CodesApart const& matrices = report.apart[ordinary];
    CHECK(matrices.by_one > 0);
    CHECK(matrices.by_one < matrices.texels / 200);
    CHECK(matrices.by_more + matrices.surfaces < matrices.texels / 50'000);
    CHECK(report.scrolls + 3 >= 3 * report.frames);
}

}  // namespace

TEST_CASE("maps that scroll on the device are their own redraw by integer passes, and nearly by others", "[vulkan][ortho][scroll]") {
    check_walk(walk("street", 3, math::Depth::forward));
}

TEST_CASE("the same over long walks", "[vulkan][ortho][scroll][.full]") {
    for (std::string const path : {"street", "spin", "both"})
        for (math::Depth const depth : {math::Depth::forward, math::Depth::reversed}) check_walk(walk(path, 100, depth));
}
