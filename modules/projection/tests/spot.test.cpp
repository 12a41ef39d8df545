#include <gnomon/check/check.hpp>
#include <gnomon/projection.hpp>

#include <cmath>
#include <limits>

namespace {
using namespace gnomon;
using math::dvec3;
using math::vec3;
}  // namespace

TEST_CASE("a spot's map holds its whole cone", "[projection][spot][property]") {
    auto const unit = check::floats(-1.0, 1.0);
    check::for_all(unit, unit, unit, check::floats(0.001, 1.5), check::floats(0.0, 6.3), check::booleans(),
                   [](double x, double y, double z, double outer, double turn, bool reversed) {
                       projection::SpotConfig config;
                       config.position_m = dvec3(3.0, -1e7, 0.5);
                       config.direction = dvec3(x, y, z);
                       if (config.direction == dvec3(0.0)) return;
                       config.outer_cone_rad = outer;
                       config.depth = reversed ? math::Depth::reversed : math::Depth::forward;
                       auto const view = projection::spot_view(config);
                       REQUIRE(view);
                       dvec3 const rim = -view->back * std::cos(outer) +
                                         (view->right * std::cos(turn) + view->up * std::sin(turn)) * std::sin(outer);
                       vec3 const at = math::to_float(rim * 10.0);
                       math::vec4 const clip = math::clip_from_relative(*view) * math::vec4(at.x, at.y, at.z, 1.0F);
                       CHECK(clip.w > 0.0F);
                       CHECK(std::abs(clip.x) <= clip.w);
                       CHECK(std::abs(clip.y) <= clip.w);
                   });
}

TEST_CASE("a spot without direction, size or sense is refused", "[projection][spot]") {
    using projection::Error;
    projection::SpotConfig config;
    config.direction = dvec3(0.0);
    CHECK(projection::spot_view(config).failure().code == Error::no_direction);
    config.direction = dvec3(0.0, -1.0, 0.0);
    for (double const bad : {0.0, -0.1, 1.56, 3.2, std::numeric_limits<double>::quiet_NaN()}) {
        config.outer_cone_rad = bad;
        CHECK(projection::spot_view(config).failure().code == Error::bad_cone);
    }
    config.outer_cone_rad = 0.5;
    config.near_m = 0.0;
    CHECK(projection::spot_view(config).failure().code == Error::bad_depth_range);
}

TEST_CASE("a depth range holds what it was made for, and is one for any numbers", "[projection][range][property]") {
    auto const any = check::any_float<double>().with_inf().with_nan();
    check::for_all(any, any, any, [](double nearest, double farthest, double range) {
        projection::DepthRange const r = projection::depth_range(nearest, farthest, range);
        CHECK(r.near_m > 0.0);
        CHECK(r.near_m < r.far_m);
        CHECK(std::isfinite(r.far_m));
    });
    projection::DepthRange const r = projection::depth_range(2.0, 100.0, std::numeric_limits<double>::infinity());
    CHECK(r.near_m < 2.0 / std::sqrt(3.0));
    CHECK(r.near_m > 1.1);
    CHECK(r.far_m > 100.0);
}

TEST_CASE("distances to a box are those of its nearest and farthest points", "[projection][range]") {
    math::Aabb const box{vec3(-1.0F), vec3(1.0F)};
    CHECK(projection::distances_to(box, dvec3(0.0)).near_m == 0.0);
    CHECK(projection::distances_to(box, dvec3(0.0)).far_m == Approx(std::sqrt(3.0)));
    CHECK(projection::distances_to(box, dvec3(4.0, 5.0, 0.0)).near_m == Approx(5.0));
    CHECK(projection::distances_to({}, dvec3(0.0)).far_m == 0.0);
}
