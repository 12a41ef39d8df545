// A program whose tests fail on purpose; tests/command_line.test.cpp runs it and judges its output.
#define GNOMON_CHECK_MAIN
#include <gnomon/check/check.hpp>

#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>

using namespace gnomon::check;

namespace {
struct Point {
    int x, y;
    bool operator==(Point const&) const = default;
};
std::string check_string(Point const& p) { return "<" + std::to_string(p.x) + "," + std::to_string(p.y) + ">"; }
struct Opaque {
    bool operator==(Opaque const&) const { return false; }
};
enum class Colour : unsigned char { red = 1, blue = 2 };
}  // namespace

TEST_CASE("alpha passes", "[good][fast]") {
    CHECK(1 + 1 == 2);
    REQUIRE(true);
}
TEST_CASE("beta passes", "[good]") { SUCCEED("fine"); }
TEST_CASE("comma, bracket [x] and \"quote\"", "[odd]") { CHECK(1 == 2); }

TEST_CASE("numbers", "[show]") {
    int const a = 3;
    CHECK(a == 4);
    CHECK(0.1f + 0.2 == 0.3);
    CHECK(1e30 < 10.0f);
    CHECK_FALSE(a == 3);
    CHECK(static_cast<unsigned char>(7) == 8);
}
TEST_CASE("things", "[show]") {
    CHECK(std::string("a\nb\"") == "c");
    CHECK('x' == 'y');
    CHECK(std::vector<int>{1, 2} == std::vector<int>{});
    CHECK(std::optional<int>(5) == 6);
    CHECK(std::pair(1, true) == std::pair(2, false));
    CHECK(Point{1, 2} == Point{3, 4});
    CHECK(Colour::red == Colour::blue);
    CHECK(Opaque{} == Opaque{});
    char const* none = nullptr;
    CHECK(none != nullptr);
    CHECK_THAT(1.0f, WithinULP(2.0f, 3));
    CHECK_THAT(std::string("hay"), Contains("needle") || StartsWith("x"));
}
TEST_CASE("require stops", "[flow]") {
    REQUIRE(1 == 2);
    FAIL("not reached");
}
TEST_CASE("exceptions", "[flow]") {
    CHECK_THROWS_AS(throw std::runtime_error("wrong type"), std::logic_error);
    CHECK_THROWS(1 + 1);
    CHECK_NOTHROW(throw std::runtime_error("thrown text"));
    CHECK([]() -> bool { throw std::runtime_error("inside"); }());
    throw std::runtime_error("escaped");
}
TEST_CASE("messages", "[flow]") {
    int const n = 7;
    INFO("info " << n << ' ' << 1.5);
    CAPTURE(n, n + 1);
    UNSCOPED_INFO("once");
    CHECK(n == 8);
    { INFO("gone"); }
    CHECK(n == 9);
}
TEST_CASE("sections", "[tree]") {
    WARN("top");
    SECTION("a") {
        SECTION("a1") { WARN("a1"); }
        SECTION("a2") {
            WARN("a2");
            REQUIRE(false);
        }
    }
    SECTION("b") { WARN("b"); }
}
TEST_CASE("hidden", "[.][secret]") { CHECK(false); }
TEST_CASE("skipped", "[skip]") { SKIP("no such device"); }
TEST_CASE("expected to fail", "[!shouldfail][odd]") { CHECK(false); }
TEST_CASE("may fail", "[!mayfail][odd]") { CHECK(false); }
TEST_CASE("xml", "[xml]") {
    INFO("<&>\"' \x01 \xff \xc3\xa9 \xed\xa0\x80 ]]>");
    CHECK(std::string("<tag attr=\"&\">\x02") == "");
}
TEST_CASE("many failures", "[.][many]") {
    for (int i = 0; i < 300; ++i) CHECK(i < 0);
}
TEST_CASE("aborts", "[.][abort]") { std::abort(); }
TEST_CASE("empty", "[.][empty]") {}

TEST_CASE("smallest integer", "[property]") {
    for_all(integers(-1000000, 1000000), [](int v) { CHECK(v < 777); });
}
TEST_CASE("smallest negative", "[property]") {
    for_all(integers<long long>(), [](long long v) { return v > -12345; });
}
TEST_CASE("smallest sum", "[property]") {
    for_all(integers(0, 10000), integers(0, 10000), [](int a, int b) { return a + b < 5000; });
}
TEST_CASE("shortest vector", "[property]") {
    for_all(vector_of(integers(0, 1000), 0, 60), [](std::vector<int> const& v) {
        for (int x : v)
            if (x >= 100) REQUIRE(v.size() < 3);
    });
}
TEST_CASE("shortest unsorted", "[property]") {
    for_all(vector_of(integers<int>(), 0, 100), [](std::vector<int> const& v) {
        for (std::size_t i = 1; i < v.size(); ++i)
            if (v[i - 1] > v[i]) return false;
        return true;
    });
}
TEST_CASE("smallest float", "[property]") {
    for_all(floats(-1000.0, 1000.0), [](double v) { CHECK(v < 12.25); });
}
TEST_CASE("shortest string", "[property]") {
    for_all(strings(0, 40), [](std::string const& s) { return s.find('q') == std::string::npos; });
}
TEST_CASE("nested lists", "[property]") {
    for_all(vector_of(vector_of(integers(0, 9), 0, 6), 0, 6), [](std::vector<std::vector<int>> const& all) {
        std::size_t count = 0;
        for (auto const& v : all) count += v.size();
        return count < 4;
    });
}
TEST_CASE("throwing property", "[property]") {
    for_all(integers(0, 1000), [](int v) {
        if (v > 50) throw std::runtime_error("too large");
    });
}
TEST_CASE("many checks in one case", "[property]") {
    for_all(integers(0, 1000), [](int v) {
        INFO("v is " << v);
        for (int i = 0; i < 100; ++i) CHECK(v < 10);
    });
}
TEST_CASE("impossible filter", "[property]") {
    for_all(filter(integers(0, 10), [](int v) { return v > 10; }), [](int) {});
}
TEST_CASE("only nan", "[property]") {
    for_all(any_float<float>().with_nan(), [](float f) { CHECK(f == f); });
}
TEST_CASE("slow to shrink", "[.][slow]") {
    for_all(vector_of(integers<unsigned>(), 100, 200), [](std::vector<unsigned> const& v) {
        unsigned sum = 0;
        for (unsigned x : v) sum = sum * 31 + x;
        return sum % 2 == 0;
    });
}
