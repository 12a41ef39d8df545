#include "values.hpp"

#include <gnomon/check/check.hpp>

using namespace gnomon::command;

TEST_CASE("a number is read whole or not at all", "[values]") {
    CHECK(real_from("-0.45") == -0.45);
    CHECK(real_from("1e7") == 1e7);
    CHECK(real_from(".5") == 0.5);
    for (char const* bad : {"", " 1", "1 ", "1x", "nan", "inf", "-inf", "1e999", "0x10", "--1", "1,2", "+-1"}) {
        INFO("text '" << bad << "'");
        CHECK_FALSE(real_from(bad).has_value());
    }
    CHECK(integer_from("42") == 42);
    for (char const* bad : {"", "4.0", "4k", "99999999999999999999", "0x4"}) CHECK_FALSE(integer_from(bad).has_value());
}

TEST_CASE("a size has two sides, both in range", "[values]") {
    auto const size = read_size("--size", "640x480");
    REQUIRE(size);
    CHECK(size->x == 640);
    CHECK(size->y == 480);
    for (char const* bad : {"0x0", "0x600", "640", "x", "640x", "640x480x3", "-640x480", "100000x100000", "16384x16384",
                            "6e2x400", "640 x 480", "640X480"}) {
        INFO("text '" << bad << "'");
        auto const refused = read_size("--size", bad);
        REQUIRE_FALSE(refused);
        CHECK(refused.failure().code == Exit::usage);
        CHECK(refused.failure().message.find(bad) != std::string::npos);
    }
}

TEST_CASE("a vector has three finite numbers", "[values]") {
    auto const v = read_vector("--eye", "1,-2.5,3e2");
    REQUIRE(v);
    CHECK(*v == gnomon::math::dvec3(1.0, -2.5, 300.0));
    for (char const* bad : {"", "1,2", "1,2,3,4", "1,2,nan", "1,,3", "1,2,3m", "inf,0,0"})
        CHECK_FALSE(read_vector("--eye", bad).has_value());
}

TEST_CASE("a misspelt name brings up the right one, a foreign word none", "[values]") {
    std::vector<std::string> const known = {"city", "cubes", "rayyard", "sheet"};
    CHECK(closest("citty", known) == "city");
    CHECK(closest("rayard", known) == "rayyard");
    CHECK_FALSE(closest("sponza", known).has_value());
    CHECK(suggestion("shet", known).find("did you mean 'sheet'?") != std::string::npos);
    CHECK(join({}) == "none");
}
