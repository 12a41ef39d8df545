#include "table.hpp"

#include "image_io.hpp"
#include "output.hpp"

#include <gnomon/check/check.hpp>

#include <limits>

using namespace gnomon::command;

TEST_CASE("figures keep three digits and never turn a small error into none", "[table]") {
    CHECK(figures(0.0) == "0");
    CHECK(figures(1.0) == "1.00");
    CHECK(figures(12.345) == "12.3");
    CHECK(figures(123.45) == "123");
    CHECK(figures(123456.0) == "123456");
    CHECK(figures(0.00123456) == "0.00123");
    CHECK(figures(std::numeric_limits<double>::infinity()) == "inf");
    CHECK(percent(1e-6) == "0.000100");
    CHECK(percent(1.0) == "100");
    CHECK(grouped(0) == "0");
    CHECK(grouped(999) == "999");
    CHECK(grouped(1234567) == "1,234,567");
}

TEST_CASE("columns stand in line, and colour is for terminals", "[table]") {
    std::string const text = aligned({{"run", "ms"}, {"a long name", "1.25"}, {"b", "100"}});
    CHECK(text == "run            ms\na long name  1.25\nb             100\n");
    CHECK(aligned({{"run"}}, {.bold_head = true}).find('\x1b') != std::string::npos);
}

TEST_CASE("a PNG says its size, and a data URI is base64 with padding", "[image]") {
    Picture picture{{3, 2}, 3, Bytes(18, 200)};
    Bytes const png = png_from(picture);
    REQUIRE(png.size() > 24);
    CHECK(png[1] == 'P');
    CHECK(png[19] == 3);
    CHECK(png[23] == 2);
    CHECK(png_from({}).empty());
    CHECK(data_uri({}) == "data:image/png;base64,");
    CHECK(data_uri(bytes_of("Man")) == "data:image/png;base64,TWFu");
    CHECK(data_uri(bytes_of("Ma")) == "data:image/png;base64,TWE=");
    CHECK(data_uri(bytes_of("M")) == "data:image/png;base64,TQ==");
}

TEST_CASE("wrong pixels are thickened within the picture, right ones stay", "[image]") {
    Picture picture{{4, 3}, 3, Bytes(36, 128)};
    picture.pixels[0] = 255;  // the top left corner, no longer grey
    Picture const wide = thickened(picture);
    int colored = 0;
    for (std::size_t i = 0; i < wide.pixels.size(); i += 3) colored += wide.pixels[i] == 255 ? 1 : 0;
    CHECK(colored == 4);
    CHECK(wide.pixels[15] == 255);
    CHECK(wide.pixels[6] == 128);
    CHECK(thickened({}).empty());
}
