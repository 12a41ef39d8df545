#include <gnomon/check/check.hpp>
#include <gnomon/projection.hpp>
#include <gnomon/shadow.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace gnomon;
using math::dvec2;
using math::dvec3;
using math::vec3;
using math::View;

struct Plane {
    dvec3 point;
    dvec3 normal;
};

float quantized(double depth, shadow::Format format) {
    double const inside = std::fmin(std::fmax(depth, 0.0), 1.0);
    if (format == shadow::Format::f32) return static_cast<float>(inside);
    return static_cast<float>(std::floor(inside * 65535.0 + 0.5)) * (1.0F / 65535.0F);
}

/// A map that holds a plane exactly, but for the snapping of corners (up to 1/512 texel each way) and the format.
struct PlaneMap {
    View view;
    Plane plane;
    shadow::Format format;

    [[nodiscard]] float at(std::int32_t x, std::int32_t y) const noexcept {
        double const snap_x = ((x * 7 + y * 3) % 5 - 2) / 1024.0;
        double const snap_y = ((x * 5 + y * 11) % 5 - 2) / 1024.0;
        math::PixelRay const ray = math::pixel_ray(view, dvec2(x + 0.5 + snap_x, y + 0.5 + snap_y));
        double const along = glm::dot(plane.normal, ray.step);
        double const distance = glm::dot(plane.normal, plane.point - view.eye_m - ray.start_m) / along;
        bool const seen = along < 0.0 && distance > 0.0;
        double const empty = view.depth == math::Depth::reversed ? 0.0 : 1.0;
        return quantized(seen ? math::depth_from_distance(view, distance) : empty, format);
    }
};

dvec3 tilted(View const& view, double angle_rad, double azimuth_rad) {
    dvec3 const side = view.right * std::cos(azimuth_rad) + view.up * std::sin(azimuth_rad);
    return view.back * std::cos(angle_rad) + side * std::sin(angle_rad);
}

View sun_view(math::Depth depth, std::int32_t size, dvec3 const& origin = dvec3(0.0)) {
    projection::DirectionalConfig config;
    config.origin_m = origin;
    config.size_px = math::ivec2(size, size);
    config.depth = depth;
    return projection::directional_view(dvec3(-0.45, -0.8, -0.4), {vec3(-10.0F), vec3(10.0F)}, {}, config).value();
}

View spot_view(math::Depth depth, std::int32_t size, double near_m) {
    projection::SpotConfig config;
    config.position_m = dvec3(3.0, 12.0, -4.0);
    config.direction = dvec3(-0.3, -1.0, 0.2);
    config.outer_cone_rad = 0.6;
    config.near_m = near_m;
    config.far_m = 60.0;
    config.size_px = math::ivec2(size, size);
    config.depth = depth;
    return projection::spot_view(config).value();
}

/// Samples of a plane through the view's middle, all of which are lit: how many does the lookup put in shadow?
int shadowed_samples(View const& view, shadow::Format format, double angle_rad, shadow::LookupConfig const& config) {
    shadow::MapView const map = shadow::make_map_view(view, dvec3(0.0), format);
    bool const ortho = view.lens == math::Lens::orthographic;
    dvec3 const middle = view.eye_m - view.back * (ortho ? 0.0 : 15.0);
    int shadowed = 0;
    for (double const azimuth : {0.0, 0.7, 2.4, 4.0}) {
        Plane const plane{middle, tilted(view, angle_rad, azimuth)};
        PlaneMap const texels{view, plane, format};
        vec3 const normal = math::to_float(plane.normal);
        for (int i = 0; i < 40; ++i) {
            dvec2 const px(view.size_px.x * (0.31 + 0.0097 * i), view.size_px.y * (0.67 - 0.0083 * i));
            math::PixelRay const ray = math::pixel_ray(view, px);
            double const distance =
                glm::dot(plane.normal, plane.point - view.eye_m - ray.start_m) / glm::dot(plane.normal, ray.step);
            if (!(distance > view.near_m && distance < view.far_m)) continue;
            vec3 const p = math::to_float(view.eye_m + ray.start_m + ray.step * distance);
            shadowed += shadow::look_up(map, texels, p, normal, config).visibility < 1.0F ? 1 : 0;
        }
    }
    return shadowed;
}

}  // namespace

TEST_CASE("an unshadowed plane of any tilt is lit everywhere with automatic bias", "[shadow][bias]") {
    for (double const degrees : {0.0, 1.0, 20.0, 45.0, 60.0, 75.0, 80.0, 85.0, 88.0, 89.0, 89.5, 89.9})
        for (int const taps : {1, 2, 3, 5, 7})
            for (bool const follow : {true, false})
                for (shadow::Format const format : {shadow::Format::f32, shadow::Format::unorm16})
                    for (math::Depth const depth : {math::Depth::forward, math::Depth::reversed}) {
                        shadow::LookupConfig config;
                        config.taps = taps;
                        config.bias.receiver_plane = follow;
                        CAPTURE(degrees, taps, follow, static_cast<int>(format), static_cast<int>(depth));
                        double const angle = degrees * 0.017453292519943295;
                        CHECK(shadowed_samples(sun_view(depth, 1024), format, angle, config) == 0);
                        CHECK(shadowed_samples(spot_view(depth, 1024, 1.0), format, angle, config) == 0);
                    }
}

TEST_CASE("without any bias the same planes have acne, so the test above can fail", "[shadow][bias]") {
    shadow::LookupConfig config;
    config.bias.automatic = false;
    config.bias.receiver_plane = false;
    CHECK(shadowed_samples(sun_view(math::Depth::reversed, 1024), shadow::Format::f32, 1.0, config) > 50);
    CHECK(shadowed_samples(spot_view(math::Depth::reversed, 1024, 1.0), shadow::Format::f32, 1.0, config) > 50);
    config.bias.receiver_plane = true;
    CHECK(shadowed_samples(sun_view(math::Depth::reversed, 1024), shadow::Format::unorm16, 1.0, config) > 0);
}

TEST_CASE("a plane that faces away or is edge on is in shadow without a lookup, one that faces the light is not", "[shadow]") {
    View const view = sun_view(math::Depth::reversed, 64);
    shadow::MapView const map = shadow::make_map_view(view, dvec3(0.0));
    std::vector<float> const empty(64 * 64, 0.0F);
    shadow::Texels<float> const texels{empty.data(), 64};
    CHECK(shadow::look_up(map, texels, vec3(0.0F), -map.back, {}).visibility == 0.0F);
    CHECK(shadow::look_up(map, texels, vec3(0.0F), map.right, {}).visibility == 0.0F);
    vec3 const barely = glm::normalize(map.right + map.back * 1e-5F);
    CHECK(shadow::look_up(map, texels, vec3(0.0F), barely, {}).visibility == 1.0F);
    CHECK(shadow::look_up(map, texels, vec3(0.0F), map.back, {}).visibility == 1.0F);
}

TEST_CASE("what the map does not hold is lit", "[shadow]") {
    float const nan = std::numeric_limits<float>::quiet_NaN();
    float const inf = std::numeric_limits<float>::infinity();
    for (math::Depth const depth : {math::Depth::forward, math::Depth::reversed}) {
        View const view = spot_view(depth, 32, 0.5);
        shadow::MapView const map = shadow::make_map_view(view, dvec3(0.0));
        // Every texel blocks: only what lies outside of the map can be lit.
        std::vector<float> const full(32 * 32, depth == math::Depth::forward ? 0.0F : 1.0F);
        shadow::Texels<float> const texels{full.data(), 32};
        vec3 const normal = map.back;
        vec3 const inside = map.eye - map.back * 10.0F;
        CHECK(shadow::look_up(map, texels, inside, normal, {}).visibility == 0.0F);
        CHECK(shadow::look_up(map, texels, inside + map.right * 30.0F, normal, {}).visibility == 1.0F);
        CHECK(shadow::look_up(map, texels, map.eye + map.back * 3.0F, normal, {}).visibility == 1.0F);
        CHECK(shadow::look_up(map, texels, vec3(nan), normal, {}).visibility == 1.0F);
        CHECK(shadow::look_up(map, texels, vec3(inf), normal, {}).visibility == 1.0F);
        CHECK(shadow::look_up(map, texels, vec3(1e30F), normal, {}).visibility == 1.0F);
        // At the border a wide filter is lit in part.
        shadow::LookupConfig wide;
        wide.taps = 7;
        math::PixelRay const edge = math::pixel_ray(view, dvec2(0.1, 16.0));
        float const partly =
            shadow::look_up(map, texels, math::to_float(view.eye_m + edge.step * 10.0), normal, wide).visibility;
        CHECK(partly > 0.3F);
        CHECK(partly < 0.7F);
    }
}

TEST_CASE("a depth beyond the far plane is compared as the far plane, so an empty texel never blocks it", "[shadow]") {
    for (math::Depth const depth : {math::Depth::forward, math::Depth::reversed}) {
        View const view = sun_view(depth, 32);
        shadow::MapView const map = shadow::make_map_view(view, dvec3(0.0));
        std::vector<float> const empty(32 * 32, depth == math::Depth::forward ? 1.0F : 0.0F);
        shadow::Texels<float> const texels{empty.data(), 32};
        vec3 const deep = -map.back * 500.0F;
        CHECK(shadow::look_up(map, texels, deep, map.back, {}).visibility == 1.0F);
    }
}

namespace {

/// A ground at y = 0 and a box on it, as a sun's map sees them.
struct BoxMap {
    View view;
    dvec3 lo;
    dvec3 hi;
    shadow::Format format = shadow::Format::f32;

    [[nodiscard]] double hit(math::PixelRay const& ray) const noexcept {
        dvec3 const start = view.eye_m + ray.start_m;
        double enter = -1e30;
        double leave = 1e30;
        for (int axis = 0; axis < 3; ++axis) {
            double const a = (lo[axis] - start[axis]) / ray.step[axis];
            double const b = (hi[axis] - start[axis]) / ray.step[axis];
            enter = std::fmax(enter, std::fmin(a, b));
            leave = std::fmin(leave, std::fmax(a, b));
        }
        double const ground = -start.y / ray.step.y;
        return enter <= leave ? std::fmin(enter, ground) : ground;
    }

    [[nodiscard]] float at(std::int32_t x, std::int32_t y) const noexcept {
        return quantized(math::depth_from_distance(view, hit(math::pixel_ray(view, dvec2(x + 0.5, y + 0.5)))), format);
    }
};

/// How far the shadow of a box of this thickness stays away from its foot, in texels on the ground, at its worst.
double contact_gap_texels(math::Depth depth, double thickness_m, shadow::LookupConfig const& config) {
    View const view = sun_view(depth, 1024);
    shadow::MapView const map = shadow::make_map_view(view, dvec3(0.0));
    // The sun goes toward -x: the shadow begins at the face x = -1. A thin box is the hard one, as nothing of it is far
    // before the ground behind it.
    BoxMap const texels{view, dvec3(-1.0, 0.0, -4.0), dvec3(-1.0 + thickness_m, 2.0, 4.0), shadow::Format::f32};
    double const texel_m = math::pixel_size_m(view, 1.0).x / std::abs(view.back.y);
    double worst = 0.0;
    for (int k = 0; k < 200; ++k)
        for (int step = 0; step < 400; ++step) {
            double const away = step * 0.01 * texel_m;
            vec3 const p(static_cast<float>(-1.0 - away), 0.0F, static_cast<float>(-0.9 + 0.0083 * k));
            if (shadow::look_up(map, texels, p, vec3(0.0F, 1.0F, 0.0F), config).visibility >= 0.5F)
                worst = std::fmax(worst, away / texel_m);
        }
    return worst;
}

}  // namespace

TEST_CASE("a box's shadow begins within a texel of its foot", "[shadow][bias]") {
    for (math::Depth const depth : {math::Depth::forward, math::Depth::reversed})
        for (int const taps : {1, 2, 3}) {
            shadow::LookupConfig config;
            config.taps = taps;
            double const thick = contact_gap_texels(depth, 2.0, config);
            double const thin = contact_gap_texels(depth, 0.001, config);
            INFO("taps " << taps << ": gap of a thick box " << thick << ", of a thin one " << thin << " texels");
            CHECK(thick < 0.51);
            CHECK(thin < 1.0);
        }
    // A bias of three texels, as people set by hand, is the peter-panning that this avoids.
    shadow::LookupConfig manual;
    manual.bias.automatic = false;
    manual.bias.constant = 3.0F;
    CHECK(contact_gap_texels(math::Depth::reversed, 0.001, manual) > 1.0);
}

TEST_CASE("forward and reversed depth see the same shadows", "[shadow][property]") {
    std::array const modes{math::Depth::forward, math::Depth::reversed};
    std::array<BoxMap, 2> maps;
    std::array<shadow::MapView, 2> views;
    for (std::size_t i = 0; i < 2; ++i) {
        maps[i] = {sun_view(modes[i], 1024), dvec3(-1.0, 0.0, -1.0), dvec3(1.0, 2.0, 1.0), shadow::Format::f32};
        views[i] = shadow::make_map_view(maps[i].view, dvec3(0.0));
    }
    auto const place = check::floats(-6.0F, 6.0F);
    int differing = 0;
    check::for_all(check::cases(4000), place, place, check::integers(1, 7), [&](float x, float z, int taps) {
        shadow::LookupConfig config;
        config.taps = taps;
        vec3 const up(0.0F, 1.0F, 0.0F);
        float const a = shadow::look_up(views[0], maps[0], vec3(x, 0.0F, z), up, config).visibility;
        float const b = shadow::look_up(views[1], maps[1], vec3(x, 0.0F, z), up, config).visibility;
        differing += a != b ? 1 : 0;
        CHECK(std::abs(a - b) < 0.51F);
    });
    CHECK(differing <= 8);  // texel centres within rounding of the box's silhouette
}

TEST_CASE("a scene 1e7 m from the origin is looked up as one at it", "[shadow]") {
    dvec3 const far_origin(10'000'384.0, -9'999'360.0, 10'000'384.0);
    View const here = sun_view(math::Depth::reversed, 1024);
    View const there = sun_view(math::Depth::reversed, 1024, far_origin);
    shadow::MapView const a = shadow::make_map_view(here, dvec3(0.0));
    shadow::MapView const b = shadow::make_map_view(there, far_origin);
    CHECK(a.eye == b.eye);
    CHECK(glm::distance(here.right, there.right) < 1e-15);
    for (int i = 0; i < 50; ++i) {
        vec3 const p(-5.0F + 0.21F * static_cast<float>(i), 0.0F, 3.0F);
        shadow::Receiver const ra = shadow::receiver_at(a, p, vec3(0.0F, 1.0F, 0.0F));
        shadow::Receiver const rb = shadow::receiver_at(b, p, vec3(0.0F, 1.0F, 0.0F));
        CHECK(ra.texel.x == Approx(rb.texel.x).margin(0.01));
        CHECK(ra.depth == Approx(rb.depth).margin(1e-6));
    }
}
