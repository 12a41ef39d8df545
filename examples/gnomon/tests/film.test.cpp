#include "film.hpp"

#include <gnomon/check/check.hpp>

#include <webp/demux.h>

#include <cmath>
#include <memory>

using namespace gnomon::command;

namespace {

/// A frame of one colour that changes with its number.
Picture plain_frame(gnomon::math::ivec2 size_px, int number) {
    Picture picture{size_px, 3, {}};
    for (int i = 0; i < size_px.x * size_px.y; ++i)
        for (int const c : {40 * number, 200 - 30 * number, 90}) picture.pixels.push_back(static_cast<unsigned char>(c));
    return picture;
}

struct Decoded {
    std::vector<int> end_ms;
    std::vector<std::vector<unsigned char>> first_pixel;
};

Decoded decoded(Bytes const& file) {
    Decoded out;
    WebPData const data{file.data(), file.size()};
    std::unique_ptr<WebPAnimDecoder, decltype(&WebPAnimDecoderDelete)> const decoder(
        WebPAnimDecoderNew(&data, nullptr), &WebPAnimDecoderDelete);
    if (decoder == nullptr) return out;
    while (WebPAnimDecoderHasMoreFrames(decoder.get()) != 0) {
        std::uint8_t* rgba = nullptr;
        int end_ms = 0;
        if (WebPAnimDecoderGetNext(decoder.get(), &rgba, &end_ms) == 0) break;
        out.end_ms.push_back(end_ms);
        out.first_pixel.push_back({rgba, rgba + 3});
    }
    return out;
}

}  // namespace

TEST_CASE("a film holds every frame, in its colours, for its time", "[film]") {
    gnomon::math::ivec2 const size_px(48, 32);
    Film film({size_px, 30.0});
    for (int i = 0; i < 5; ++i) REQUIRE(film.add(plain_frame(size_px, i)));
    Decoded const seen = decoded(film.finish());
    REQUIRE(seen.end_ms.size() == 5);
    for (int i = 0; i < 5; ++i) {
        auto const at = static_cast<std::size_t>(i);
        CHECK(seen.end_ms[at] == static_cast<int>(std::lround((i + 1) * 1000.0 / 30.0)));
        Picture const frame = plain_frame(size_px, i);
        for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(seen.first_pixel[at][c] - frame.pixels[c]) <= 6);
    }
}

TEST_CASE("a film without frames is no file, and one of the wrong size is refused", "[film]") {
    Film film({{16, 16}, 30.0});
    CHECK_FALSE(film.add(plain_frame({16, 8}, 1)));
    CHECK(film.finish().empty());
    Film endless({{20000, 4}, 30.0});  // WebP ends at 16383
    CHECK_FALSE(endless.add(plain_frame({20000, 4}, 1)));
}
