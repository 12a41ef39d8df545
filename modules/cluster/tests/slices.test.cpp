#include <gnomon/check/check.hpp>
#include <gnomon/cluster/slices.hpp>
#include <gnomon/math/scalar.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

using namespace gnomon;
using cluster::DepthSlices;

/// From the definition, by nothing but comparisons of floats.
std::uint32_t slice_by_scan(DepthSlices const& s, float depth_m) {
    auto const inner = s.planes_m().subspan(1, s.count() - 1);
    auto const beyond = std::upper_bound(inner.begin(), inner.end(), depth_m);
    return std::isnan(depth_m) ? 0 : static_cast<std::uint32_t>(beyond - inner.begin());
}

void check_every_plane(DepthSlices const& s) {
    auto const planes = s.planes_m();
    for (std::uint32_t k = 0; k < s.count(); ++k) {
        CHECK(slice_at(s, planes[k]) == k);
        CHECK(slice_at(s, math::next_down(planes[k])) == (k == 0 ? 0 : k - 1));
        float below = planes[k];
        float above = planes[k];
        for (int ulp = 0; ulp <= 64; ++ulp) {
            if (slice_at(s, below) != slice_by_scan(s, below)) CHECK(slice_at(s, below) == slice_by_scan(s, below));
            if (slice_at(s, above) != slice_by_scan(s, above)) CHECK(slice_at(s, above) == slice_by_scan(s, above));
            below = math::next_down(below);
            above = math::next_up(above);
        }
    }
    CHECK(slice_at(s, planes[s.count()]) == s.count() - 1);
}

void check_hard_depths(DepthSlices const& s) {
    float const inf = std::numeric_limits<float>::infinity();
    float const nan = std::numeric_limits<float>::quiet_NaN();
    float const least = std::numeric_limits<float>::denorm_min();
    for (float const x : {0.0F, -0.0F, least, -least, 1e-39F, -1e-39F, -1.0F, 1e30F, std::numeric_limits<float>::max(),
                          std::numeric_limits<float>::lowest()})
        CHECK(slice_at(s, x) == slice_by_scan(s, x));
    CHECK(slice_at(s, inf) == s.count() - 1);
    CHECK(slice_at(s, -inf) == 0);
    CHECK(slice_at(s, nan) == 0);
    CHECK(slice_at(s, -nan) == 0);
}

void check_lanes(DepthSlices const& s, std::span<float const> depths) {
    using Group = math::Lanes<float, 8>;
    formula::Words const words{s.words().data()};
    for (std::size_t i = 0; i + 8 <= depths.size(); i += 8) {
        auto const slices = gn_slice_at(s.table(), words, formula::Float<Group>(Group::load(&depths[i])));
        for (std::size_t lane = 0; lane < 8; ++lane) CHECK(slices.v[lane] == slice_by_scan(s, depths[i + lane]));
    }
}

/// Planes of no scheme: bunches of neighbouring floats, on both sides of zero, which no part of a table can hold apart.
DepthSlices bunched_slices(check::Choices& choices) {
    std::vector<std::int32_t> places;
    auto const bunches = check::integers(1, 5)(choices);
    for (int bunch = 0; bunch < bunches; ++bunch) {
        int place = math::ordinal(check::floats(-1e3F, 1e3F)(choices));
        auto const size = check::integers(1, 40)(choices);
        for (int i = 0; i < size; ++i) places.push_back(place += check::integers(1, 3)(choices));
    }
    places.push_back(math::ordinal(2e3F));
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    std::vector<float> planes;
    for (std::int32_t const place : places) planes.push_back(math::from_ordinal(place));
    return cluster::make_slices(planes).value();
}

/// Slices of any scheme that the factory accepts.
auto any_slices() {
    return [](check::Choices& choices) {
        std::uint64_t const kind = choices.draw(4);
        if (kind == 4) return bunched_slices(choices);
        double const near_m = check::element_of({0.1, 1e-3, 0.05, 1.0, 3.7, 1e-30, 1e4})(choices);
        double const ratio = std::pow(10.0, check::floats(0.01, 6.0)(choices));
        auto const count = static_cast<std::uint32_t>(check::integers(2, 200)(choices));
        double const extent = check::floats(0.05, 4.0)(choices);
        double const first = check::floats(0.01, 0.99)(choices);
        bool const open_end = choices.draw(1) != 0;
        bool const behind = choices.draw(1) != 0;
        double const far_m = near_m * ratio;
        auto made = kind == 0 ? cluster::make_slices(cluster::ExponentialSlices{near_m, far_m, extent, count, open_end})
                    : kind == 1 ? cluster::make_slices(cluster::UniformSlices{behind ? -near_m : near_m, far_m, count, open_end})
                    : kind == 2 ? cluster::make_slices(cluster::UniformDepthSlices{near_m, far_m, count, open_end})
                                : cluster::make_slices(cluster::FirstThenExponentialSlices{
                                      near_m, near_m + (far_m - near_m) * first, far_m, count, open_end});
        return made ? std::move(made).value() : cluster::make_slices(cluster::UniformSlices{0.0, 1.0, 7, false}).value();
    };
}

}  // namespace

TEST_CASE("every plane of any scheme begins its slice, and 64 floats on either side fall where comparisons put them", "[cluster][property]") {
    check::for_all(check::cases(200), any_slices(), [](DepthSlices const& s) {
        if (s.count() > 4000) return;
        check_every_plane(s);
        check_hard_depths(s);
    });
}

TEST_CASE("any depth, in lanes too, has the slice that comparisons give", "[cluster][property]") {
    check::for_all(check::cases(300), any_slices(), check::vector_of(check::any_float<float>().with_nan().with_inf(), 8, 64),
                   [](DepthSlices const& s, std::vector<float> const& depths) {
                       for (float const x : depths) CHECK(slice_at(s, x) == slice_by_scan(s, x));
                       check_lanes(s, depths);
                       if (s.count() > 1000) return;
                       std::vector<float> near_planes;
                       for (float const plane : s.planes_m())
                           for (float const x : {math::next_down(plane), plane, math::next_up(plane)}) near_planes.push_back(x);
                       check_lanes(s, near_planes);
                   });
}

TEST_CASE("the configurations in which logarithms misplace planes have none misplaced", "[cluster]") {
    for (auto const& [near_m, far_m, count] : {std::tuple{0.1, 100.0, 16U}, {0.05, 5000.0, 32U}, {1.0, 10000.0, 64U}}) {
        auto const s = cluster::make_slices(cluster::FirstThenExponentialSlices{
            near_m, near_m * std::pow(far_m / near_m, 1.0 / count), far_m, count, false}).value();
        REQUIRE(s.count() == count);
        check_every_plane(s);
    }
}

TEST_CASE("exponential slices are the paper's, from the number of tiles and the half angle", "[cluster]") {
    // 1080 lines in tiles of 32: 34 tiles; half angle 30 degrees.
    double const extent = 2.0 * std::tan(3.14159265358979323846 / 6.0);
    auto const s = cluster::make_slices(cluster::ExponentialSlices{0.1, 1000.0, extent, 34, false}).value();
    CHECK(s.count() == 276);
    for (std::uint32_t k = 0; k <= s.count(); ++k) {
        long double const plane = 0.1L * std::pow(1.0L + static_cast<long double>(extent) / 34, static_cast<long double>(k));
        CHECK(s.planes_m()[k] == static_cast<float>(plane));
    }
    // Equation 2, away from the planes, where its logarithms cannot err.
    check::for_all(check::floats(0.1, 1000.0), [&](double depth) {
        long double const k = std::log(static_cast<long double>(static_cast<float>(depth)) / 0.1L) /
                              std::log(1.0L + static_cast<long double>(extent) / 34);
        if (std::abs(k - std::round(k)) < 1e-4L) return;
        CHECK(slice_at(s, static_cast<float>(depth)) == static_cast<std::uint32_t>(std::floor(k)));
    });
    // As deep as a tile is high.
    CHECK(std::abs((s.planes_m()[101] - s.planes_m()[100]) / (s.planes_m()[100] * static_cast<float>(extent) / 34) - 1.0F) < 1e-4F);
}

TEST_CASE("the grid with a first slice of five metres has the planes that others print", "[cluster]") {
    auto const s = cluster::make_slices(cluster::FirstThenExponentialSlices{0.1, 5.0, 100.0, 16, false}).value();
    REQUIRE(s.count() == 16);
    CHECK(s.planes_m()[0] == 0.1F);
    for (std::uint32_t i = 1; i <= 16; ++i)
        CHECK(s.planes_m()[i] == static_cast<float>(100.0L * std::pow(20.0L, (static_cast<long double>(i) - 16) / 15)));
}

TEST_CASE("uniform slices of the depth buffer are uniform in depth, finite and infinite", "[cluster]") {
    auto const finite = cluster::make_slices(cluster::UniformDepthSlices{0.5, 50.0, 8, false}).value();
    for (std::uint32_t k = 0; k <= 8; ++k) {
        double const z = static_cast<double>(finite.planes_m()[k]);
        CHECK(std::abs(50.0 / 49.5 - 50.0 * 0.5 / 49.5 / z - k / 8.0) < 1e-6);
    }
    auto const infinite = cluster::make_slices(cluster::UniformDepthSlices{0.5, std::numeric_limits<double>::infinity(), 4, false}).value();
    CHECK(infinite.planes_m()[1] == 0.5F / 0.75F);
    CHECK(infinite.planes_m()[3] == 2.0F);
    CHECK(infinite.planes_m()[4] == std::numeric_limits<float>::infinity());
    auto const straight = cluster::make_slices(cluster::UniformSlices{-2.0, 6.0, 4, true}).value();
    CHECK(straight.planes_m()[1] == 0.0F);
    CHECK(straight.planes_m()[3] == 4.0F);
    CHECK(straight.planes_m()[4] == std::numeric_limits<float>::infinity());
}

TEST_CASE("a bad scheme of slices is refused with a sentence that names the value", "[cluster]") {
    using enum cluster::SliceError;
    double const inf = std::numeric_limits<double>::infinity();
    double const nan = std::numeric_limits<double>::quiet_NaN();
    auto const code = [](auto const& config) {
        auto const made = cluster::make_slices(config);
        if (made) return std::string("made");
        CHECK(made.failure().message.size() > 20);
        return std::to_string(static_cast<int>(made.failure().code));
    };
    auto const is = [](cluster::SliceError error) { return std::to_string(static_cast<int>(error)); };
    using cluster::ExponentialSlices;
    using cluster::FirstThenExponentialSlices;
    using cluster::UniformDepthSlices;
    using cluster::UniformSlices;
    CHECK(code(ExponentialSlices{nan, 100.0, 1.0, 10, false}) == is(not_finite));
    CHECK(code(ExponentialSlices{0.1, inf, 1.0, 10, true}) == is(not_finite));
    CHECK(code(ExponentialSlices{0.1, 1e39, 1.0, 10, true}) == is(not_finite));
    CHECK(code(ExponentialSlices{0.0, 100.0, 1.0, 10, false}) == is(bad_range));
    CHECK(code(ExponentialSlices{10.0, 1.0, 1.0, 10, false}) == is(bad_range));
    CHECK(code(ExponentialSlices{0.1, 100.0, nan, 10, false}) == is(bad_field));
    CHECK(code(ExponentialSlices{0.1, 100.0, 0.0, 10, false}) == is(bad_field));
    CHECK(code(ExponentialSlices{0.1, 100.0, 1.0, 0, false}) == is(bad_field));
    CHECK(code(ExponentialSlices{0.1, 1e6, 1.0, 1U << 20U, false}) == is(bad_count));
    CHECK(code(ExponentialSlices{1.0, 2.0, 1e-300, 1, false}) == is(bad_count));
    CHECK(code(ExponentialSlices{1.0, 1.0 + 1e-6, 1e-7, 1, false}) == is(too_thin));
    CHECK(code(UniformSlices{0.1, inf, 4, false}) == is(not_finite));
    CHECK(code(UniformSlices{0.1, 0.1, 4, false}) == is(bad_range));
    CHECK(code(UniformSlices{0.1, 1.0, 0, false}) == is(bad_count));
    CHECK(code(UniformSlices{1000.0, 1000.001, 1000, false}) == is(too_thin));
    CHECK(code(UniformSlices{0.0, 1.0, cluster::max_slices + 1, false}) == is(bad_count));
    CHECK(code(UniformDepthSlices{-1.0, 1.0, 4, false}) == is(bad_range));
    CHECK(code(UniformDepthSlices{nan, 1.0, 4, false}) == is(not_finite));
    CHECK(code(FirstThenExponentialSlices{0.1, 0.1, 100.0, 4, false}) == is(bad_range));
    CHECK(code(FirstThenExponentialSlices{0.1, 5.0, 4.0, 4, false}) == is(bad_range));
    CHECK(code(FirstThenExponentialSlices{0.1, 5.0, 100.0, 1, false}) == is(bad_count));
    CHECK(code(UniformSlices{0.0, 100.0, cluster::max_slices, false}) == "made");
    std::vector<float> const reversed{3.0F, 2.0F};
    CHECK(cluster::make_slices(reversed).failure().code == too_thin);
    std::vector<float> const early_end{1.0F, std::numeric_limits<float>::infinity(), 2.0F};
    CHECK(cluster::make_slices(early_end).failure().code == not_finite);
    CHECK(cluster::make_slices(std::span<float const>{}).failure().code == bad_count);
}
