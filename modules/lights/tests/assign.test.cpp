// The formula of assignment against the headers that it repeats, and its search against the predicate.

#include "../../cull/tests/hard_pairs.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/lights/brute_force.hpp>
#include <gnomon/lights/formula/assign.glsl>

#include <bit>
#include <cstddef>
#include <limits>

using namespace gnomon;

namespace {

static_assert(sizeof(formula::GnLight) == sizeof(lights::Light));

/// Of a light, its bytes as a shader's struct.
formula::GnLight shader_light(lights::Light const& light) { return std::bit_cast<formula::GnLight>(light); }

/// Lights that nearly touch clusters: the search by balls must find each that the predicate accepts.
void check_search(std::size_t tries) {
    test::Draw draw{99};
    std::size_t accepted = 0;
    std::size_t searched = 0;
    std::size_t missed = 0;
    std::size_t different = 0;
    for (std::size_t i = 0; i < tries; ++i) {
        test::HardGrid const g = test::make_hard_grid(draw);
        cull::RowGrid const grid = cull::make_row_grid(g.view());
        std::uint32_t const column = draw.below(grid.columns);
        std::uint32_t const row = draw.below(grid.rows);
        std::uint32_t const slice = draw.below(grid.slices);
        test::HardLight const hard = test::make_hard_light(draw, g, {column, row, slice});
        lights::Light light = lights::make_point(hard.center, hard.range);
        if (draw.below(2) != 0) {
            light.kind = lights::Kind::spot;
            light.axis = hard.axis;
            light.cos_half = hard.cosine;
            light.sin_half = hard.sine;
        }
        // Some lie at a border where what rounding does is worst: the eye at the ball's surface.
        if (draw.below(8) == 0) light.range_m = std::sqrt(light.center.x * light.center.x + light.center.y * light.center.y + light.center.z * light.center.z);
        if (!lights::is_sound(light)) continue;
        using Float = formula::Float<float>;
        formula::GnRow<float> const borders = grid.row(row, slice);
        auto const box = gn_cluster_box(borders, Float(grid.left[column]), Float(grid.right[column]), grid.perspective);
        formula::Vec3<float> const center(light.center);
        bool const found = gn_may_hold(box, gn_box_of(formula::GnSphere<float>{center, Float(light.range_m)})).v;
        bool const touches = lights::may_touch(grid, light, column, row, slice);
        auto const span = gn_light_span(shader_light(light), borders, grid.perspective);
        different += gn_touches(span, Float(grid.left[column]), Float(grid.right[column])).v != touches ? 1U : 0U;
        accepted += touches ? 1U : 0U;
        searched += found ? 1U : 0U;
        missed += touches && !found ? 1U : 0U;
    }
    CAPTURE(accepted, searched);
    CHECK(missed == 0);
    CHECK(different == 0);
    CHECK(accepted > tries / 4);
    CHECK(searched - accepted < tries / 5);
}

}  // namespace

TEST_CASE("a search by balls finds every light that the predicate accepts", "[lights]") { check_search(40'000); }
TEST_CASE("a search by balls finds every light that the predicate accepts, a million hard ones", "[lights][.full]") { check_search(1'000'000); }

TEST_CASE("which lights are sound is said alike by header and formula", "[lights]") {
    test::Draw draw{5};
    float const odd[] = {0.0F, -0.0F, 1.0F, -1.0F, 0.7F, 1e-7F, 9.6e-7F, 1e18F, 1.2e18F, 1e9F, 1.1e9F, std::numeric_limits<float>::infinity(),
                         std::numeric_limits<float>::quiet_NaN()};
    std::size_t sound = 0;
    for (int i = 0; i < 20'000; ++i) {
        lights::Light light = lights::make_point({1.0F, 2.0F, 3.0F}, 4.0F);
        light.kind = draw.below(2) != 0 ? lights::Kind::spot : lights::Kind::point;
        float* const numbers[] = {&light.center.x, &light.center.y, &light.center.z, &light.range_m, &light.axis.x, &light.axis.y,
                                  &light.axis.z,   &light.cos_half, &light.sin_half};
        for (int k = 0; k < 3; ++k) {
            unsigned const which = draw.below(9);
            *numbers[which] = odd[draw.below(13)];
        }
        formula::GnLight const l = shader_light(light);
        using Float = formula::Float<float>;
        bool const ball = gn_is_sound_ball(formula::Vec3<float>(l.center), Float(l.range_m)).v;
        bool const cone = gn_is_sound_cone(formula::Vec3<float>(l.axis), Float(l.cos_half), Float(l.sin_half)).v;
        REQUIRE((ball && (l.kind != 1 || cone)) == lights::is_sound(light));
        sound += lights::is_sound(light) ? 1U : 0U;
    }
    CHECK((sound > 2000 && sound < 18'000));
}
