#include <gnomon/cascade/select.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/math/generators.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

namespace {

namespace selecting {

using namespace gnomon;
using namespace gnomon::check;
using cascade::CascadeChoice;
using cascade::CascadeDepths;
using cascade::CascadeMaps;

cascade::CascadeFrame some_frame(math::dvec3 const& eye_m, math::dvec3 const& way) {
    cascade::CascadeConfig config;
    config.splits.far_m = 150.0;
    math::PerspectiveConfig camera;
    camera.eye_m = eye_m;
    camera.target_m = eye_m + way;
    camera.size_px = {640, 480};
    return cascade::plan(cascade::Cascades{}, config, math::make_perspective(camera).value()).value();
}

TEST_CASE("the cascade by depth is the first that ends beyond it, and the blend runs over the overlap", "[select]") {
    for_all(integers(1, 8), floats(0.0, 1.0), floats(-10.0F, 250.0F), [](int count, double overlap, float depth_m) {
        cascade::SplitConfig config;
        config.count = static_cast<std::uint32_t>(count);
        config.overlap = overlap;
        config.fade = 0.125;
        config.far_m = 200.0;
        math::View view;
        CascadeDepths const depths = cascade::cascade_depths(cascade::make_splits(config, view).value());
        CascadeChoice const chosen = cascade::choose_by_depth(depths, depth_m);
        std::uint32_t k = 0;
        while (k < depths.count && depth_m >= depths.end_m[k]) ++k;
        CHECK(chosen.cascade == k);
        CHECK(chosen.next == std::min(k + 1, depths.count));
        if (k == depths.count) {
            CHECK(chosen.blend == 0.0F);
            return;
        }
        double const from = static_cast<double>(depths.blend_m[k]);
        double const to = static_cast<double>(depths.end_m[k]);
        double const part =
            static_cast<double>(depth_m) <= from ? 0.0 : (static_cast<double>(depth_m) - from) / (to - from);
        CHECK(std::abs(static_cast<double>(chosen.blend) - part) < 1e-4);
        CHECK((chosen.blend >= 0.0F && chosen.blend <= 1.0F));
    });
    CascadeDepths const depths = cascade::cascade_depths(some_frame(math::dvec3(0.0), {0.0, 0.0, -1.0}));
    for (std::uint32_t k = 0; k < depths.count; ++k) {
        CHECK(cascade::choose_by_depth(depths, depths.end_m[k]).cascade == k + 1);
        CHECK(cascade::choose_by_depth(depths, math::next_down(depths.end_m[k])).cascade == k);
    }
    CHECK(cascade::choose_by_depth(depths, std::numeric_limits<float>::quiet_NaN()) == CascadeChoice{0, 1, 0.0F});
    CHECK(cascade::choose_by_depth(depths, std::numeric_limits<float>::infinity()) == CascadeChoice{4, 4, 0.0F});
}

TEST_CASE("the cascade by map is the first whose window holds the point in double, but for points on a border",
          "[select]") {
    int compared = 0;
    for_all(cases(400), math::points(), math::directions(), array_of<3>(floats(-90.0F, 90.0F)),
            [&](math::vec3 const& eye, math::dvec3 const& way, std::array<float, 3> const& n) {
                math::vec3 const p(n[0], n[1], n[2]);
                math::dvec3 const eye_m = math::to_double(eye);
                cascade::CascadeFrame const frame = some_frame(eye_m, way);
                CascadeMaps const maps = cascade::cascade_maps(frame, {eye_m, 2.0F, 16.0F});
                CascadeChoice const chosen = cascade::choose_by_map(maps, cascade::along_light(frame.light, p));
                math::dvec3 const q =
                    cascade::light_from_relative(frame.light, eye_m - frame.anchor_m + math::to_double(p));
                std::uint32_t first = frame.count;
                std::uint32_t second = frame.count;
                double within = 0.0;
                for (std::uint32_t k = 0; k < frame.count; ++k) {
                    cascade::Volume const& v = frame.cascades[k].volume;
                    double const x = q.x / v.texel_m - static_cast<double>(v.at.x);
                    double const y = q.y / v.texel_m - static_cast<double>(v.at.y);
                    double const z = q.z / v.depth_unit_m - static_cast<double>(v.at.z);
                    double const texels = std::fmin(std::fmin(x, 512.0 - x), std::fmin(y, 512.0 - y)) - 2.0;
                    double const codes = std::fmin(z, 65535.0 - z);
                    if (std::abs(texels) < 0.01 || std::abs(codes) < 1.0) return;
                    if (texels < 0.0 || codes < 0.0) continue;
                    if (first == frame.count) {
                        first = k;
                        within = texels;
                    } else if (second == frame.count) {
                        second = k;
                    }
                }
                ++compared;
                CHECK(chosen.cascade == first);
                CHECK(chosen.next == second);
                double const part = second == frame.count ? 0.0 : std::fmax(0.0, 1.0 - within / 16.0);
                CHECK(std::abs(static_cast<double>(chosen.blend) - part) < 0.002);
            });
    CHECK(compared > 350);
}

TEST_CASE("a point that is no number looks into no map", "[select]") {
    cascade::CascadeFrame const frame = some_frame(math::dvec3(0.0), {0.0, 0.0, -1.0});
    CascadeMaps const maps = cascade::cascade_maps(frame, {});
    float const nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(cascade::choose_by_map(maps, math::vec3(nan, 0.0F, 0.0F)) == CascadeChoice{4, 4, 0.0F});
    CHECK(cascade::choose_by_map(maps, math::vec3(0.0F, 0.0F, nan)) == CascadeChoice{4, 4, 0.0F});
    CHECK(cascade::choose_by_map(maps, math::vec3(0.0F)).cascade == 0);
}

TEST_CASE("lanes choose as single floats do", "[select]") {
    using Group = math::Lanes<float, 8>;
    cascade::CascadeFrame const frame = some_frame(math::dvec3(0.0), {0.3, 0.1, -1.0});
    CascadeDepths const depths = cascade::cascade_depths(frame);
    CascadeMaps const maps = cascade::cascade_maps(frame, {});
    int wrong = 0;
    for (int i = 0; i < 200; ++i) {
        float x[8];
        for (int lane = 0; lane < 8; ++lane) x[lane] = 0.11F * static_cast<float>(i * 8 + lane) - 20.0F;
        formula::Float<Group> const wide(Group::load(x));
        auto const by_depth = gn_cascade_by_depth(depths, wide);
        auto const by_map = gn_cascade_by_map(maps, formula::Vec3<Group>(wide, wide * 0.25, wide * -0.5));
        for (std::size_t lane = 0; lane < 8; ++lane) {
            CascadeChoice const a = cascade::choose_by_depth(depths, x[lane]);
            CascadeChoice const b = cascade::choose_by_map(maps, math::vec3(x[lane], x[lane] * 0.25F, x[lane] * -0.5F));
            wrong +=
                a == CascadeChoice{by_depth.cascade.v[lane], by_depth.next.v[lane], by_depth.blend.v[lane]} ? 0 : 1;
            wrong += b == CascadeChoice{by_map.cascade.v[lane], by_map.next.v[lane], by_map.blend.v[lane]} ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
}

}  // namespace selecting

}  // namespace
