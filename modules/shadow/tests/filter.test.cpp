#include <gnomon/check/check.hpp>
#include <gnomon/shadow/filter.hpp>

#include <limits>

using namespace gnomon;

TEST_CASE("the weights of a row of taps are not negative and add up to 1", "[shadow][filter][property]") {
    check::for_all(check::floats(-100.0F, 17000.0F), check::integers(1, shadow::max_taps), [](float x, int taps) {
        shadow::TapRow const row = shadow::taps_at(x, taps);
        float sum = 0.0F;
        for (int i = 0; i < taps; ++i) {
            CHECK(row.weight(i) >= 0.0F);
            sum += row.weight(i);
        }
        CHECK(std::abs(sum - 1.0F) < 1e-5F);
    });
}

TEST_CASE("the weights' centre is the point that is asked for", "[shadow][filter][property]") {
    check::for_all(check::floats(0.0F, 4096.0F), check::integers(2, 9), [](float x, int taps) {
        shadow::TapRow const row = shadow::taps_at(x, taps);
        float centre = 0.0F;
        for (int i = 0; i < taps; ++i)
            centre += row.weight(i) * (static_cast<float>(row.first - static_cast<int>(x) + i) + 0.5F);

        float const error = std::abs(centre - (x - static_cast<float>(static_cast<int>(x))));
        CHECK(error <= 2e-3F);
    });
}

TEST_CASE("one tap is the texel that holds the point, two are the bilinear neighbours", "[shadow][filter]") {
    CHECK(shadow::taps_at(7.9F, 1).first == 7);
    CHECK(shadow::taps_at(7.9F, 1).weight(0) == 1.0F);
    shadow::TapRow const two = shadow::taps_at(7.75F, 2);
    CHECK(two.first == 7);
    CHECK(two.weight(0) == 0.75F);
    CHECK(two.weight(1) == 0.25F);
    shadow::TapRow const three = shadow::taps_at(7.5F, 3);
    CHECK(three.first == 6);
    CHECK(three.weight(0) == 0.25F);
    CHECK(three.weight(1) == 0.5F);
    CHECK(three.weight(2) == 0.25F);
}

TEST_CASE("no coordinate is undefined behaviour", "[shadow][filter]") {
    float const inf = std::numeric_limits<float>::infinity();
    for (float const x : {std::numeric_limits<float>::quiet_NaN(), inf, -inf, 1e30F, -1e30F}) {
        shadow::TapRow const row = shadow::taps_at(x, 3);
        CHECK((row.first < -1000 || row.first > 20000));
    }
}
