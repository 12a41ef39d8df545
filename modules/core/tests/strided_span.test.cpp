#include <gnomon/check/check.hpp>
#include <gnomon/core/strided_span.hpp>

#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace {
struct Point {
    float x, y, z;
};
}  // namespace

TEST_CASE("a strided span reads what was written, at any stride and alignment", "[core][strided_span]") {
    for (std::size_t const stride : {sizeof(Point), sizeof(Point) + 1, std::size_t{32}}) {
        std::vector<std::byte> bytes(1 + 5 * stride + sizeof(Point));
        for (std::size_t i = 0; i < 5; ++i) {
            Point const p{static_cast<float>(i), 2.0F, -1.0F};
            std::memcpy(bytes.data() + 1 + i * stride, &p, sizeof p);
        }
        gnomon::core::StridedSpan<Point> const points(bytes.data() + 1, 5, stride);
        REQUIRE(points.size() == 5);
        for (std::size_t i = 0; i < 5; ++i) CHECK(points[i].x == static_cast<float>(i));
    }
}

TEST_CASE("a packed span is a strided one", "[core][strided_span]") {
    std::array<float, 3> const numbers{1.0F, 2.0F, 3.0F};
    gnomon::core::StridedSpan<float> const strided{std::span<float const>(numbers)};
    CHECK(strided.stride_bytes() == sizeof(float));
    CHECK(strided[2] == 3.0F);
    CHECK(gnomon::core::StridedSpan<float>{}.empty());
}
