#include <gnomon/check/check.hpp>
#include <gnomon/math/formula.hpp>
#include <gnomon/math/formula/exact.glsl>
#include <gnomon/math/formula/view.glsl>
#include <gnomon/math/generators.hpp>
#include <gnomon/math/view.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace {

using namespace gnomon;
using math::Lanes;
using F = formula::Float<float>;
using F8 = formula::Float<Lanes<float, 8>>;

bool equal_bits(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

/// `x`, `steps` floats further, within its binade.
float off_by(float x, std::int64_t steps) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(std::bit_cast<std::uint32_t>(x) + steps));
}

float quotient_from_guess(float a, float b, std::int64_t steps) {
    float const about = off_by(gn_mantissa(F(a)).v / gn_mantissa(F(b)).v, steps);
    return gn_exact_quotient(F(a), F(b), F(about), F(-1.0F)).v;
}

float root_from_guess(float x, std::int64_t steps) {
    float const about = off_by(std::sqrt(gn_root_argument(F(x)).v), steps);
    return gn_exact_root(F(x), F(about), F(-1.0F)).v;
}

double real_of(float x) { return static_cast<double>(x); }

bool is_normal(float x) { return std::isnormal(x); }

}  // namespace

TEST_CASE("a quotient is IEEE's, whichever of eleven neighbours the device guesses", "[math][formula][property]") {
    auto const any = check::any_float<float>();
    int tried = 0;
    check::for_all(check::cases(40000), any, any, check::integers(-5, 5), [&](float a, float b, int steps) {
        if (!is_normal(a) || !is_normal(b) || !is_normal(a / b) || std::abs(a / b) == std::numeric_limits<float>::min()) return;
        ++tried;
        CHECK(equal_bits(quotient_from_guess(a, b, steps), a / b));
    });
    CHECK(tried > 10000);
    // Mantissas near each other and near powers of two, where a guess may leave its binade.
    for (std::uint32_t i = 0; i < 64; ++i)
        for (std::uint32_t j = 0; j < 64; ++j)
            for (int steps = -5; steps <= 5; ++steps) {
                float const a = off_by(1.0F, i < 32 ? i : 0x800000U - 64 + i);
                float const b = off_by(4.0F, j < 32 ? j : 0x800000U - 64 + j);
                CHECK(equal_bits(quotient_from_guess(a, b, steps), a / b));
            }
}

TEST_CASE("a root is IEEE's, whichever of seventeen neighbours the device guesses", "[math][formula][property]") {
    check::for_all(check::cases(40000), check::any_float<float>(), check::integers(-8, 8), [](float x, int steps) {
        if (!is_normal(x)) return;
        float const p = std::abs(x);
        CHECK(equal_bits(root_from_guess(p, steps), std::sqrt(p)));
    });
    for (std::uint32_t i = 0; i < 1U << 12U; ++i)
        for (int steps = -8; steps <= 8; steps += 4) {
            float const whole = static_cast<float>(i + 1);
            CHECK(equal_bits(root_from_guess(whole * whole, steps), whole));
            float const beside = off_by(1.0F, i < 2048 ? i : 0x1000000U - 4096 + i);
            CHECK(equal_bits(root_from_guess(beside, steps), std::sqrt(beside)));
        }
}

TEST_CASE("what is not normal is left to the device", "[math][formula]") {
    CHECK(gn_exact_quotient(F(0.0F), F(2.0F), F(1.0F), F(7.0F)).v == 7.0F);
    CHECK(gn_exact_quotient(F(1.0F), F(0.0F), F(1.0F), F(7.0F)).v == 7.0F);
    CHECK(gn_exact_quotient(F(1e30F), F(1e-30F), F(1.0F), F(7.0F)).v == 7.0F);
    CHECK(gn_exact_root(F(-1.0F), F(1.0F), F(7.0F)).v == 7.0F);
    CHECK(equal_bits(gn_exact_root(F(-0.0F), F(1.0F), F(7.0F)).v, -0.0F));
}

TEST_CASE("eight lanes of a formula give one lane's bits", "[math][formula][property]") {
    auto const eight = check::array_of<8>(check::any_float<float>());
    check::for_all(eight, eight, [](std::array<float, 8> const& x, std::array<float, 8> const& y) {
        F8 const a = Lanes<float, 8>::load(x.data());
        F8 const b = Lanes<float, 8>::load(y.data());
        F8 const q = gn_div(a, b);
        F8 const r = gn_sqrt(abs(a));
        F8 const least = gn_min(a, b);
        F8 const mask = gn_select(a < b && !(b < 0.0), a * 0.5, F8(3));
        F8 const exact = gn_exact_quotient(a, b, gn_div(gn_mantissa(a), gn_mantissa(b)), q);
        for (std::size_t i = 0; i < 8; ++i) {
            CHECK(equal_bits(q.v[i], x[i] / y[i]));
            CHECK(equal_bits(r.v[i], std::sqrt(std::abs(x[i]))));
            CHECK(equal_bits(least.v[i], y[i] < x[i] ? y[i] : x[i]));
            CHECK(equal_bits(mask.v[i], x[i] < y[i] && !(y[i] < 0.0F) ? x[i] * 0.5F : 3.0F));
            CHECK(equal_bits(exact.v[i], gn_exact_quotient(F(x[i]), F(y[i]), gn_div(gn_mantissa(F(x[i])), gn_mantissa(F(y[i]))),
                                                           F(q.v[i])).v));
        }
    });
}

TEST_CASE("the float projection of a point is within its bound of the double one", "[math][formula][property]") {
    auto const near_one = check::floats(-1.0F, 1.0F);
    double largest = 0.0;  // error in bounds
    check::for_all(check::cases(4000), check::array_of<8>(near_one), check::integers(0, 3),
                   [&](std::array<float, 8> const& u, int kind) {
        auto const real = [&](std::size_t i) { return static_cast<double>(u[i]); };
        bool const perspective = kind < 2;
        math::PerspectiveConfig lens;
        lens.eye_m = math::dvec3{real(0), real(1), real(2)} * 1e6;
        lens.target_m = lens.eye_m + math::dvec3{real(3), 0.3, real(4) - 1.5};
        lens.far_m = kind == 0 ? std::numeric_limits<double>::infinity() : 200.0;
        lens.size_px = math::ivec2(2048, 1024);
        math::OrthographicConfig box{.eye_m = lens.eye_m, .target_m = lens.target_m, .window_m = {-20, 20, -10, 10},
                                     .near_m = 0.0, .far_m = 200.0, .size_px = lens.size_px, .depth = math::Depth::forward};
        math::View const view = perspective ? math::make_perspective(lens).value() : math::make_orthographic(box).value();
        math::PixelRay const ray = math::pixel_ray(view, math::dvec2{1024.0 + 1500.0 * real(5), 512.0 + 700.0 * real(6)});
        math::vec3 const p = math::to_float(ray.start_m + ray.step * (51.0 + 50.0 * real(7)));

        math::mat4 const m = math::clip_from_relative(view);
        auto const clip = gn_clip_of(m, formula::Vec3<float>(p));
        auto const at = gn_image_point(clip, math::vec2(2048.0F, 1024.0F), perspective);
        math::dvec3 const exact = math::project(view, math::to_double(p));
        // Matrix, product and two sums: 4 e of the absolute products; then quotient, product, sum and product.
        auto const row_error = [&](math::axis_t row) {
            math::dvec3 const a(m[0][row], m[1][row], m[2][row]);
            return 4.0 * 0x1p-24 * (std::abs(a.x * real_of(p.x)) + std::abs(a.y * real_of(p.y)) +
                                    std::abs(a.z * real_of(p.z)) + std::abs(static_cast<double>(m[3][row])));
        };
        double const w = static_cast<double>(clip.w.v);
        double const ndc_x = std::abs(exact.x / 1024.0 - 1.0);
        double const ndc_error = (row_error(0) + ndc_x * row_error(3)) / w + 4.0 * 0x1p-24 * ndc_x + 2.0 * 0x1p-24;
        double const bound_px = ndc_error * 1024.0 * 1.001;
        double const error_px = std::abs(static_cast<double>(at.px.x.v) - exact.x);
        CHECK(error_px <= bound_px);
        double const depth_error = (row_error(2) + std::abs(exact.z) * row_error(3)) / w + 3.0 * 0x1p-24 * std::abs(exact.z);
        CHECK(std::abs(static_cast<double>(at.depth.v) - exact.z) <= depth_error * 1.001);
        largest = std::max(largest, error_px / bound_px);
    });
    CHECK(largest > 0.05);
}
