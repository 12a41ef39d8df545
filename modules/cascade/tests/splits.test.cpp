#include <gnomon/cascade/splits.hpp>
#include <gnomon/check/check.hpp>

#include <cmath>
#include <limits>

namespace {

namespace splitting {

using namespace gnomon;
using namespace gnomon::check;
using cascade::SplitConfig;
using cascade::SplitScheme;
using cascade::VisibleRange;

math::View with_range(double near_m, double far_m, math::Lens lens = math::Lens::perspective) {
    math::View view;
    view.near_m = near_m;
    view.far_m = far_m;
    view.lens = lens;
    return view;
}

TEST_CASE("splits are the schemes' own, in long double, and the last ends at the shadow distance", "[splits]") {
    for_all(
        integers(1, 8), floats(0.01, 5.0), floats(1.5, 5000.0), floats(0.0, 1.0),
        [](int count, double near_m, double ratio, double lambda) {
            SplitConfig config;
            config.count = static_cast<std::uint32_t>(count);
            config.lambda = lambda;
            config.far_m = near_m * ratio;
            for (SplitScheme const scheme : {SplitScheme::uniform, SplitScheme::logarithmic, SplitScheme::practical}) {
                config.scheme = scheme;
                auto const splits =
                    cascade::make_splits(config, with_range(near_m, std::numeric_limits<double>::infinity())).value();
                long double const part = scheme == SplitScheme::uniform       ? 0.0L
                                         : scheme == SplitScheme::logarithmic ? 1.0L
                                                                              : static_cast<long double>(lambda);
                for (std::uint32_t k = 0; k < splits.count; ++k) {
                    long double const t = static_cast<long double>(k + 1) / static_cast<long double>(count);
                    long double const n = near_m;
                    long double const f = config.far_m;
                    long double const end = part * n * std::pow(f / n, t) + (1.0L - part) * (n + t * (f - n));
                    CHECK(std::abs(static_cast<long double>(splits.of[k].end_m) - end) <= 1e-14L * f);
                }
                CHECK(splits.of[splits.count - 1].end_m == config.far_m);
            }
        });
}

TEST_CASE("a cascade begins where the one before begins to blend into it", "[splits]") {
    SplitConfig config;
    config.far_m = 100.0;
    config.overlap = 0.25;
    config.fade = 0.5;
    config.scheme = SplitScheme::uniform;
    auto const splits = cascade::make_splits(config, with_range(20.0, 1000.0)).value();
    CHECK(splits.of[0].begin_m == 20.0);
    CHECK(splits.of[0].blend_m == 35.0);
    CHECK(splits.of[1].begin_m == 35.0);
    CHECK(splits.of[1].end_m == 60.0);
    CHECK(splits.of[3].blend_m == 90.0);
    config.overlap = 0.0;
    CHECK(cascade::make_splits(config, with_range(20.0, 1000.0))->of[1].begin_m == 40.0);
}

TEST_CASE("orthographic cameras may begin behind the eye, uniformly", "[splits]") {
    SplitConfig config;
    config.scheme = SplitScheme::uniform;
    auto const splits = cascade::make_splits(config, with_range(-20.0, 20.0, math::Lens::orthographic)).value();
    CHECK(splits.of[1].end_m == 0.0);
    CHECK_FALSE(cascade::make_splits(config, with_range(-20.0, 20.0)));
    config.scheme = SplitScheme::logarithmic;
    CHECK(cascade::make_splits(config, with_range(-20.0, 20.0, math::Lens::orthographic)).failure().code ==
          cascade::Error::bad_range);
}

TEST_CASE("given ends stand as they are, if they rise", "[splits]") {
    SplitConfig config;
    config.scheme = SplitScheme::given;
    config.count = 3;
    config.ends_m = {5.0, 20.0, 90.0};
    auto const splits = cascade::make_splits(config, with_range(0.1, std::numeric_limits<double>::infinity())).value();
    CHECK((splits.of[0].end_m == 5.0 && splits.of[1].end_m == 20.0 && splits.of[2].end_m == 90.0));
    config.ends_m = {5.0, 5.0, 90.0};
    CHECK(cascade::make_splits(config, with_range(0.1, 100.0)).failure().code == cascade::Error::bad_range);
    config.ends_m = {5.0, 95.0, 90.0};
    CHECK(cascade::make_splits(config, with_range(0.1, 100.0)).failure().code == cascade::Error::bad_range);
    config.ends_m = {5.0, std::numeric_limits<double>::quiet_NaN(), 90.0};
    CHECK(cascade::make_splits(config, with_range(0.1, 100.0)).failure().code == cascade::Error::bad_range);
}

TEST_CASE("the range of visible depths holds them, and stays while they waver", "[splits]") {
    VisibleRange held;
    int changes = 0;
    for (int i = 0; i < 1000; ++i) {
        double const nearest = 2.0 + 0.4 * std::sin(0.1 * i);
        double const farthest = 80.0 + 15.0 * std::cos(0.13 * i);
        VisibleRange const next = cascade::follow_visible(held, nearest, farthest);
        CHECK((next.near_m <= nearest && next.far_m >= farthest && next.far_m <= 2.5 * farthest &&
               next.near_m >= 0.4 * nearest));
        changes += next == held ? 0 : 1;
        held = next;
    }
    CHECK(changes < 8);
    CHECK(cascade::follow_visible(held, std::numeric_limits<double>::quiet_NaN(), 3.0) == held);
    CHECK(cascade::follow_visible(held, 0.0, 3.0) == held);
    CHECK(cascade::follow_visible(held, 1.0, std::numeric_limits<double>::infinity()) == held);
}

}  // namespace splitting

}  // namespace
