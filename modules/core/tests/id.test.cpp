#include <gnomon/check/check.hpp>
#include <gnomon/core/id.hpp>

#include <concepts>
#include <type_traits>

TEST_CASE("ids of different things do not mix", "[core][id]") {
    using namespace gnomon::core;
    STATIC_REQUIRE(!std::convertible_to<TriangleId, LightId>);
    STATIC_REQUIRE(!std::equality_comparable_with<TriangleId, LightId>);
    STATIC_REQUIRE(!std::convertible_to<std::uint32_t, LightId>);
    STATIC_REQUIRE(std::is_trivially_copyable_v<LightId>);
    CHECK(LightId{3}.index() == 3);
    CHECK(LightId::none().is_none());
    CHECK_FALSE(LightId{0}.is_none());
}
