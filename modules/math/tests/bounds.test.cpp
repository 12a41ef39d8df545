#include <gnomon/check/check.hpp>
#include <gnomon/math/bounds.hpp>
#include <gnomon/math/generators.hpp>

#include <array>
#include <limits>
#include <vector>

namespace {
using namespace gnomon;
using math::Aabb;
using math::vec3;
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();
}  // namespace

TEST_CASE("the empty box holds nothing, touches nothing and is neutral in a merge", "[math][bounds][property]") {
    check::for_all(math::boxes(), math::points(), [](Aabb const& box, vec3 const& p) {
        CHECK_FALSE(math::contains(Aabb{}, p));
        CHECK_FALSE(math::touches(Aabb{}, box));
        CHECK(math::merged(Aabb{}, box) == box);
    });
    CHECK(math::is_empty(Aabb{}));
}

TEST_CASE("two boxes touch exactly when their intersection is not empty", "[math][bounds][property]") {
    check::for_all(math::boxes(), math::boxes(), [](Aabb const& a, Aabb const& b) {
        Aabb const common{glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)};
        CHECK(math::touches(a, b) == !math::is_empty(common));
        CHECK(math::touches(a, b) == math::touches(b, a));
    });
}

TEST_CASE("a merge holds the corners of both boxes", "[math][bounds][property]") {
    check::for_all(math::boxes(), math::boxes(), [](Aabb const& a, Aabb const& b) {
        Aabb const both = math::merged(a, b);
        for (unsigned i = 0; i < 8; ++i) {
            CHECK(math::contains(both, math::corner(a, i)));
            CHECK(math::contains(both, math::corner(b, i)));
        }
    });
}

TEST_CASE("the centre of any finite box is inside it", "[math][bounds][property]") {
    check::for_all(math::boxes(), [](Aabb const& box) { CHECK(math::contains(box, math::center(box))); });
    float const most = std::numeric_limits<float>::max();
    CHECK(math::center(Aabb{vec3(most), vec3(most)}) == vec3(most));
}

TEST_CASE("points that are not finite leave bounds alone", "[math][bounds]") {
    std::array<vec3, 4> const points{vec3(1.0F), vec3(not_a_number, 0.0F, 0.0F), vec3(0.0F, inf, 0.0F), vec3(2.0F)};
    CHECK(math::bounds_of(points) == Aabb{vec3(1.0F), vec3(2.0F)});
    CHECK(math::is_empty(math::bounds_of({})));
    CHECK_FALSE(math::contains(Aabb{vec3(-1.0F), vec3(1.0F)}, vec3(not_a_number)));
}
