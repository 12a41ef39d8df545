// Maps that scroll, on the device: scrolled and filled at their borders against drawn anew, frame by frame along the
// motions of [CSM Scrolling]. By integer passes nothing may differ; by ordinary ones it is counted what does.

#include "pass_scenes.hpp"
#include "test_host.hpp"

#include <gnomon/cascade.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/scene.hpp>
#include <gnomon/vulkan/backend.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
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

    void add(std::uint16_t scrolled, std::uint16_t drawn) {
        int const apart = std::abs(int{scrolled} - int{drawn});
        ++texels;
        written += drawn != 65535 ? 1U : 0U;
        by_one += apart == 1 ? 1U : 0U;
        by_more += apart > 1 && apart <= 64 ? 1U : 0U;
        surfaces += apart > 64 ? 1U : 0U;
    }
};

struct WalkReport {
    CodesApart integer;
    CodesApart ordinary;
    std::uint64_t frames = 0;
    std::uint64_t scrolls = 0;
    std::uint64_t depth_moves = 0;
    double ms[2] = {0.0, 0.0};  ///< Of integer and of ordinary passes; the device's.
};

using MapImages = std::array<std::vector<std::uint16_t>, map_count>;

/// A scene's maps on a device, and the copies that are scrolled.
class ScrolledWalk {
  public:
    ScrolledWalk(backend::Backend& device, std::string const& scene_name) : device_(device) {
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
        auto const list = device.keep(draws_);
        auto const target =
            device.make_target({.size_px = {map_px, map_px}, .layers = map_count, .depth = backend::DepthFormat::unorm16});
        REQUIRE((list && target));
        list_ = *list;
        target_ = *target;
        config_.direction = math::dvec3(-0.45, -0.8, -0.4);
        config_.anchor_m = geometry_.origin_m;
        config_.splits.far_m = 120.0;
    }

    void step(math::View const& camera, WalkReport& report) {
        auto const plan = cascade::plan(cascades_, config_, camera);
        REQUIRE(plan);
        REQUIRE(plan->count == map_count);
        MapImages drawn;
        draw_integer(*plan);
        report.ms[0] += read(drawn);
        compare(*plan, drawn, integer_, report, report.integer);
        draw_ordinary(*plan);
        report.ms[1] += read(drawn);
        compare(*plan, drawn, ordinary_, report, report.ordinary);
        cascade::commit(cascades_, *plan);
        ++report.frames;
    }

  private:
    void draw_integer(cascade::CascadeFrame const& plan) {
        std::array<backend::OrthoLayer, map_count> layers;
        std::array<std::vector<std::uint32_t>, map_count> casters;
        for (std::uint32_t k = 0; k < map_count; ++k) {
            cascade::Volume const& v = plan.cascades[k].volume;
            for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
                auto const box = cascade::try_box_in_light(plan.light, v, boxes_[i], math::dvec3(0.0));
                if (box && cascade::may_cast(v, *box)) casters[k].push_back(i);
            }
            layers[k].light = {plan.light.right, plan.light.down, plan.light.away, v.texel_m, v.depth_unit_m, v.at.x, v.at.y, v.at.z};
            layers[k].draws = casters[k];
            layers[k].layer = k;
        }
        device_.stage("pass");
        REQUIRE(device_.draw_ortho(list_, target_, layers));
    }

    /// Positions are taken relative to the anchor: it stays where it is, so that their differences do too.
    void draw_ordinary(cascade::CascadeFrame const& plan) {
        std::array<backend::PassLayer, map_count> layers;
        for (std::uint32_t k = 0; k < map_count; ++k) {
            math::View view = cascade::view_of(plan.light, plan.cascades[k].volume, plan.anchor_m, plan.anchor_m, math::Depth::forward);
            layers[k].clip_from_relative = math::clip_from_relative(view);
            layers[k].layer = k;
            layers[k].depth = math::Depth::forward;
            layers[k].range = backend::DepthRange::clamp;
        }
        device_.stage("pass");
        REQUIRE(device_.draw(list_, target_, layers));
    }

    /// returns: how long the pass took, in ms.
    double read(MapImages& out) {
        device_.stage("read");
        for (std::uint32_t k = 0; k < map_count; ++k) {
            out[k].resize(std::size_t{map_px} * map_px);
            REQUIRE(device_.read({target_, k, backend::Plane::depth, {0, 0, map_px, map_px}}, std::as_writable_bytes(std::span(out[k]))));
        }
        auto const times = device_.finish();
        REQUIRE(times);
        return times->empty() ? 0.0 : times->front().ms;
    }

    /// Scrolls what is held, fills the strips from what was drawn, and compares the rest with it.
    void compare(cascade::CascadeFrame const& plan, MapImages const& drawn, MapImages& held, WalkReport& report, CodesApart& apart) {
        for (std::uint32_t k = 0; k < map_count; ++k) {
            cascade::Update const& update = plan.cascades[k].update;
            if (update.action == cascade::Action::redraw) held[k] = drawn[k];
            if (update.action == cascade::Action::scroll) {
                std::vector<std::uint16_t> next(held[k].size());
                cascade::MapTexels<std::uint16_t const> const from{held[k].data(), map_px, map_px};
                auto const stats = cascade::scroll(from, cascade::MapTexels<std::uint16_t>{next.data(), map_px, map_px},
                                                   {update.shift, cascade::unorm16_codes, math::Depth::forward});
                REQUIRE(stats.clamped == 0);  // the depth range holds the whole scene: what is clamped is not told here
                fill(update.exposed, drawn[k], next);
                held[k] = std::move(next);
                ++report.scrolls;
                report.depth_moves += update.shift.z != 0 ? 1U : 0U;
            }
            for (std::size_t i = 0; i < held[k].size(); ++i) apart.add(held[k][i], drawn[k][i]);
        }
    }

    static void fill(cascade::ExposedRects const& exposed, std::vector<std::uint16_t> const& from, std::vector<std::uint16_t>& to) {
        for (std::int32_t r = 0; r < exposed.count; ++r) {
            cascade::TexelRect const& rect = exposed.rects[static_cast<std::size_t>(r)];
            for (std::int32_t y = rect.y; y < rect.y + rect.height; ++y)
                std::copy_n(from.begin() + std::ptrdiff_t{y} * map_px + rect.x, rect.width, to.begin() + std::ptrdiff_t{y} * map_px + rect.x);
        }
    }

    backend::Backend& device_;
    scene::Geometry geometry_;
    std::vector<backend::Draw> draws_;
    std::vector<math::Aabb> boxes_;
    backend::DrawListId list_;
    backend::TargetId target_;
    cascade::CascadeConfig config_;
    cascade::Cascades cascades_;
    MapImages integer_;
    MapImages ordinary_;
};

WalkReport walk(std::string const& path_name, std::size_t frames) {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::test::TestHost host(*device);
    auto const gpu = vulkan::Backend::make(device->gpu(), host.host());
    REQUIRE(gpu);
    WalkReport report;
    ScrolledWalk walk(**gpu, "town");
    auto const path = scene::make_path({.name = "town"}, path_name);
    REQUIRE(path);
    for (std::size_t i = 0; i < frames; ++i) {
        auto const view = scene::make_view(path->frames[i % path->frames.size()], {1280, 720});
        REQUIRE(view);
        walk.step(*view, report);
    }
    CHECK(device->take_messages() == "");
    auto const per_frame = [&](std::uint64_t n) { return static_cast<double>(n) / static_cast<double>(frames); };
    std::printf("%s, %zu frames, %llu scrolls, %llu in depth: integer %llu apart of %llu; ordinary, a frame: %.0f by one, %.1f by "
                "2 to 64, %.1f by more; %.2f and %.2f ms\n",
                path_name.c_str(), frames, static_cast<unsigned long long>(report.scrolls / 2),
                static_cast<unsigned long long>(report.depth_moves / 2),
                static_cast<unsigned long long>(report.integer.by_one + report.integer.by_more + report.integer.surfaces),
                static_cast<unsigned long long>(report.integer.texels), per_frame(report.ordinary.by_one),
                per_frame(report.ordinary.by_more), per_frame(report.ordinary.surfaces), report.ms[0] / static_cast<double>(frames), report.ms[1] / static_cast<double>(frames));
    return report;
}

void check_walk(WalkReport const& report) {
    CHECK(report.integer.by_one == 0);
    CHECK(report.integer.by_more == 0);
    CHECK(report.integer.surfaces == 0);
    CHECK(report.integer.written > report.integer.texels / 2);
    // Ordinary passes round corners to float in each view anew: to another code of the same surface, and once in a while
    // to another 1/256 texel, on whose other side a texel's centre lies.
    CHECK(report.ordinary.by_one > 0);
    CHECK(report.ordinary.by_one < report.ordinary.texels / 200);
    CHECK(report.ordinary.by_more + report.ordinary.surfaces < report.ordinary.texels / 50'000);
    CHECK(report.scrolls > 3 * report.frames);
}

}  // namespace

TEST_CASE("maps that scroll on the device are their own redraw by integer passes, and nearly by ordinary ones", "[vulkan][ortho][scroll]") {
    check_walk(walk("street", 3));
}

TEST_CASE("the same over long walks", "[vulkan][ortho][scroll][.full]") {
    for (std::string const path : {"street", "spin", "both"}) check_walk(walk(path, 334));
}
