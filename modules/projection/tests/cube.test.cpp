#include <gnomon/check/check.hpp>
#include <gnomon/projection.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace {

using namespace gnomon;
using math::dvec3;
using math::vec3;
using projection::Face;

std::array<math::View, 6> faces(double margin_px, math::Depth depth = math::Depth::reversed,
                                dvec3 const& position = dvec3(0.0)) {
    projection::CubeConfig config;
    config.position_m = position;
    config.size_px = 256;
    config.margin_px = margin_px;
    config.depth = depth;
    return projection::cube_views(config).value();
}

math::vec4 clip(math::View const& view, vec3 const& relative) {
    return math::clip_from_relative(view) * math::vec4(relative.x, relative.y, relative.z, 1.0F);
}

}  // namespace

TEST_CASE("face_of picks a face whose frustum holds the direction, exactly", "[projection][cube][property]") {
    auto const views = faces(0.0);
    auto const any = check::any_float<float>();
    check::for_all(check::cases(20000), any, any, any, [&](float x, float y, float z) {
        vec3 const d(x, y, z);
        if (d == vec3(0.0F)) return;
        math::vec4 const at = clip(views[static_cast<std::size_t>(projection::face_of(d))], d);
        CHECK(at.w > 0.0F);
        CHECK(std::abs(at.x) <= at.w);
        CHECK(std::abs(at.y) <= at.w);
    });
}

TEST_CASE("edges and corners of the cube have one face each, x before y before z", "[projection][cube]") {
    CHECK(projection::face_of(vec3(1.0F, 1.0F, 1.0F)) == Face::positive_x);
    CHECK(projection::face_of(vec3(-1.0F, 1.0F, 1.0F)) == Face::negative_x);
    CHECK(projection::face_of(vec3(0.5F, 1.0F, -1.0F)) == Face::positive_y);
    CHECK(projection::face_of(vec3(0.5F, -1.0F, 1.0F)) == Face::negative_y);
    CHECK(projection::face_of(vec3(0.0F, 0.0F, -1.0F)) == Face::negative_z);
    CHECK(projection::face_of(vec3(0.0F, 0.0F, 0.0F)) == Face::positive_x);
    CHECK(projection::face_of(vec3(-0.0F, 0.0F, 0.0F)) == Face::positive_x);
}

TEST_CASE("the six faces look along their axes, right-handed", "[projection][cube]") {
    std::array const forward{dvec3(1.0, 0.0, 0.0),  dvec3(-1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0),
                             dvec3(0.0, -1.0, 0.0), dvec3(0.0, 0.0, 1.0),  dvec3(0.0, 0.0, -1.0)};
    auto const views = faces(0.0);
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(views[i].back == -forward[i]);
        CHECK(glm::cross(views[i].right, views[i].up) == views[i].back);
        CHECK(projection::face_of(math::to_float(forward[i])) == static_cast<Face>(i));
    }
}

TEST_CASE("with a margin a face holds its own directions and that many texels of its neighbours",
          "[projection][cube][property]") {
    constexpr double margin = 3.0;
    auto const unit = check::floats(-1.0F, 1.0F);
    for (math::Depth const depth : {math::Depth::forward, math::Depth::reversed}) {
        auto const views = faces(margin, depth, dvec3(1e7, -2.0, 1e7));
        check::for_all(unit, unit, unit, [&](float x, float y, float z) {
            vec3 const d(x, y, z);
            if (!(glm::dot(d, d) > 1e-6F)) return;
            math::vec4 const at = clip(views[static_cast<std::size_t>(projection::face_of(d))], d);
            float const inner = 1.0F - 2.0F * static_cast<float>(margin) / 256.0F;
            CHECK(std::abs(at.x) <= at.w * (inner + 1e-5F));
            CHECK(std::abs(at.y) <= at.w * (inner + 1e-5F));
        });
        // The edge of +x and +y falls exactly `margin` texels inside of both faces' borders.
        math::dvec3 const px = math::project(views[0], dvec3(1.0, 1.0, 0.0));
        CHECK(px.y == Approx(margin).margin(1e-6));
    }
}

TEST_CASE("a senseless lamp is refused", "[projection][cube]") {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    projection::CubeConfig config;
    config.position_m.x = nan;
    CHECK(projection::cube_views(config).failure().code == projection::Error::not_finite);
    config.position_m.x = 0.0;
    for (double const bad : {0.0, -1.0, nan}) {
        config.near_m = bad;
        CHECK(projection::cube_views(config).failure().code == projection::Error::bad_depth_range);
    }
    config.near_m = 2.0;
    config.far_m = 2.0;
    CHECK(projection::cube_views(config).failure().code == projection::Error::bad_depth_range);
    config.far_m = 3.0;
    config.size_px = 0;
    CHECK(projection::cube_views(config).failure().code == projection::Error::empty_map);
}
