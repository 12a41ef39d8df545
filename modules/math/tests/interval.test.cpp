#include <gnomon/check/check.hpp>
#include <gnomon/math/generators.hpp>
#include <gnomon/math/interval.hpp>

#include <limits>

namespace {

using namespace gnomon;
using Interval = math::Interval<float>;

/// Whether the interval holds the exact number, given in 113 bits; floats' sums and products fit but for sticky bits.
bool holds(Interval const& a, __float128 x) {
    return static_cast<__float128>(a.lo) <= x && x <= static_cast<__float128>(a.hi);
}

Interval ordered(float a, float b) { return a <= b ? Interval{a, b} : Interval{b, a}; }

}  // namespace

TEST_CASE("sums, differences and products hold the exact result of any members", "[math][interval][property]") {
    check::for_all(check::cases(20'000), check::any_float<float>(), check::any_float<float>(), check::any_float<float>(), check::any_float<float>(),
                   [](float a, float b, float c, float d) {
                       Interval const x = ordered(a, b);
                       Interval const y = ordered(c, d);
                       CHECK(holds(x + y, static_cast<__float128>(a) + d));
                       CHECK(holds(x - y, static_cast<__float128>(b) - c));
                       CHECK(holds(x * y, static_cast<__float128>(a) * c));
                       CHECK(holds(x * y, static_cast<__float128>(b) * d));
                   });
}

TEST_CASE("a quotient holds the exact result, and there is none by an interval with zero", "[math][interval][property]") {
    check::for_all(check::cases(20'000), check::any_float<float>(), check::any_float<float>(), check::any_float<float>(),
                   [](float a, float c, float d) {
                       Interval const y = ordered(c, d);
                       auto const q = math::try_divide(Interval::exactly(a), y);
                       CHECK(q.has_value() == !math::contains(y, 0.0F));
                       if (q) CHECK(holds(*q, static_cast<__float128>(a) / c));
                   });
}

TEST_CASE("overflow and infinity widen an interval, never empty it", "[math][interval]") {
    float const most = std::numeric_limits<float>::max();
    Interval const doubled = Interval::exactly(most) + Interval::exactly(most);
    CHECK(doubled.lo == most);
    CHECK(doubled.hi == std::numeric_limits<float>::infinity());
    CHECK(Interval::everything() * Interval::exactly(0.0F) == Interval::everything());
}

TEST_CASE("a sign is given only where all members share it", "[math][interval]") {
    CHECK(math::try_sign(Interval{1.0F, 2.0F}) == 1);
    CHECK(math::try_sign(Interval{-2.0F, -1.0F}) == -1);
    CHECK(math::try_sign(Interval{0.0F, -0.0F}) == 0);
    CHECK_FALSE(math::try_sign(Interval{-1.0F, 1.0F}).has_value());
    CHECK_FALSE(math::try_sign(Interval{0.0F, 1.0F}).has_value());
}
