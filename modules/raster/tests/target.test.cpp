#include <gnomon/check/check.hpp>
#include <gnomon/raster/target.hpp>

#include <vector>

using namespace gnomon::raster;

TEST_CASE("a part of an image is an image over the same memory", "[raster][target]") {
    std::vector<float> data(12 * 7);
    ImageView<float> const whole = make_image(data.data(), 12, 7);
    ImageView<float> const part = whole.sub({3, 2, 5, 4});
    part.at(4, 3) = 9.0F;
    CHECK(whole.at(7, 5) == 9.0F);
    CHECK((part.width == 5 && part.height == 4 && part.stride == 12));
    CHECK(part.sub({4, 3, 1, 1}).at(0, 0) == 9.0F);
}

TEST_CASE("a depth target knows its format and size", "[raster][target]") {
    std::vector<float> depth(6);
    std::vector<std::uint16_t> codes(20);
    DepthTarget const a = make_image(depth.data(), 3, 2);
    DepthTarget const b = make_image(codes.data(), 4, 5);
    CHECK((!a.is_unorm16() && a.width() == 3 && a.height() == 2));
    CHECK((b.is_unorm16() && b.width() == 4 && b.height() == 5));
}
