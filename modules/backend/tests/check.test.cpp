#include <gnomon/backend/check.hpp>
#include <gnomon/check/check.hpp>

#include <limits>

namespace {

using namespace gnomon;
using backend::Rect;

}  // namespace

TEST_CASE("an area is what viewport, scissor and target have in common", "[backend][check]") {
    math::ivec2 const size(100, 50);
    backend::PassLayer layer;
    CHECK(backend::area_of(layer, size) == Rect{0, 0, 100, 50});
    layer.scissor = Rect{-5, 40, 20, 20};
    CHECK(backend::area_of(layer, size) == Rect{0, 40, 15, 10});
    layer.viewport = Rect{10, -10, 1000, 55};
    CHECK(backend::area_of(layer, size) == Rect{10, 40, 5, 5});
    layer.viewport = Rect{15, 0, 10, 50};
    CHECK(backend::area_of(layer, size).width == 0);
    constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
    layer.viewport = Rect{-most, -most, most, most};
    CHECK(backend::area_of(layer, size).width == 0);
    layer.viewport = Rect{most, 0, most, most};
    CHECK(backend::area_of(layer, size).height == 0);
    layer.viewport = Rect{0, 0, -1, 10};
    CHECK(backend::area_of(layer, size).width == 0);
}
