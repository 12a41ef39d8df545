// The vocabulary and the generators, from inside. Everything here holds over Catch2 too.
#include <gnomon/check/check.hpp>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

using namespace gnomon::check;

namespace {

struct Celsius {
    int degrees;
    bool operator==(Celsius const&) const = default;
};
std::string check_string(Celsius const& t) { return std::to_string(t.degrees) + " C"; }

struct Custom {
    int value;
};

std::string text_of(Text const& text) { return std::string(text.data(), text.size()); }

// GLM's shape, without GLM.
struct Vec3 {
    using value_type = float;
    float x, y, z;
    static constexpr int length() { return 3; }
    float const& operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
};

/// All values of a generator over many cases, outside of for_all.
template <class G, class F>
void sample(G const& g, std::uint64_t count, F const& f) {
    Choices choices(42, 0);
    for (std::uint64_t i = 0; i < count; ++i) {
        choices.begin_case(i);
        f(g(choices));
    }
}

}  // namespace

template <>
struct Catch::StringMaker<Custom> {
    static std::string convert(Custom const& c) { return "custom " + std::to_string(c.value); }
};

TEST_CASE("comparisons of every kind decompose", "[vocabulary]") {
    int const three = 3;
    std::vector<int> const list{1, 2, 3};
    CHECK(three == 3);
    CHECK(three != 4);
    CHECK(three < 4);
    CHECK(three <= 3);
    CHECK(three > 2);
    CHECK(three >= 3);
    CHECK((three == 3 || three == 4));
    CHECK(list.size() == 3);
    CHECK(list == std::vector<int>{1, 2, 3});
    CHECK(three + 1 == 2 * 2);
    CHECK((three & 1) == 1);
    CHECK_FALSE(list.empty());
    CHECK(0.5f == 0.5);
    CHECK(static_cast<unsigned char>(3) == three);
    REQUIRE(std::string("abc") == "abc");
    REQUIRE_FALSE(three == 4);
    int const* pointer = nullptr;
    CHECK(pointer == nullptr);
    CHECK(!pointer);
    STATIC_REQUIRE(sizeof(std::uint64_t) == 8);
}

TEST_CASE("exceptions are judged by type and by text", "[vocabulary]") {
    auto const boom = []() -> int { throw std::runtime_error("boom and bust"); };
    CHECK_THROWS(boom());
    CHECK_THROWS_AS(boom(), std::runtime_error);
    CHECK_THROWS_AS(boom(), std::exception);
    CHECK_THROWS_WITH(boom(), "boom and bust");
    CHECK_THROWS_WITH(boom(), Catch::Matchers::Contains("bust") && Catch::Matchers::StartsWith("boom"));
    CHECK_THROWS_MATCHES(boom(), std::runtime_error, Catch::Matchers::Message("boom and bust"));
    CHECK_NOTHROW(1 + 1);
    REQUIRE_NOTHROW(std::string("x"));
    REQUIRE_THROWS_AS(throw 3, int);
}

TEST_CASE("Approx and the matchers accept what is near, and nothing else", "[vocabulary]") {
    CHECK(1.0 == Approx(1.000001));
    CHECK(1.0 != Approx(1.001));
    CHECK(1.0 == Approx(1.05).epsilon(0.1));
    CHECK(1.0f == Approx(1.4).margin(0.5));
    CHECK(Approx(2) == 2);
    CHECK(1.0 <= Approx(1.0));
    CHECK(2.0 >= Approx(1.0));
    CHECK_THAT(1.0f, WithinULP(std::nextafter(1.0f, 2.0f), 1));
    CHECK_THAT(1.0f, !WithinULP(std::nextafter(std::nextafter(1.0f, 2.0f), 2.0f), 1));
    CHECK_THAT(-0.0f, WithinULP(0.0f, 0));
    CHECK_THAT(std::numeric_limits<double>::quiet_NaN(), !WithinULP(1.0, 1000));
    CHECK_THAT(1.0, WithinAbs(1.1, 0.2) && !WithinAbs(2.0, 0.5));
    CHECK_THAT(100.0, WithinRel(101.0, 0.02) || WithinRel(0.0, 0.1));
    CHECK_THAT(100.0f, WithinRel(100.0001f));
    CHECK_THAT(std::string("Hello world"), StartsWith("Hello") && EndsWith("world") && Contains("lo wo"));
    CHECK_THAT(std::string("Hello"), Equals("hello", CaseSensitive::No) && !Equals("hello"));
    CHECK_THAT((std::vector<int>{1, 2, 3}), VectorContains(2) && !VectorContains(4));
    CHECK_THAT((std::vector<int>{3, 1, 2}), UnorderedEquals(std::vector<int>{1, 2, 3}));
}

TEST_CASE("values print as a reader wants them", "[text]") {
    CHECK(text_of(stringify(3)) == "3");
    CHECK(text_of(stringify(std::numeric_limits<std::int64_t>::min())) == "-9223372036854775808");
    CHECK(text_of(stringify(std::numeric_limits<std::uint64_t>::max())) == "18446744073709551615");
    CHECK(text_of(stringify(true)) == "true");
    CHECK(text_of(stringify('a')) == "'a'");
    CHECK(text_of(stringify(static_cast<signed char>(-3))) == "-3");
    CHECK(text_of(stringify("a\n\"b\"")) == "\"a\\n\\\"b\\\"\"");
    CHECK(text_of(stringify(std::string("x"))) == "\"x\"");
    CHECK(text_of(stringify(nullptr)) == "nullptr");
    CHECK(text_of(stringify(std::vector<std::string>{"a", "b"})) == "{ \"a\", \"b\" }");
    CHECK(text_of(stringify(std::array<int, 2>{{1, 2}})) == "{ 1, 2 }");
    CHECK(text_of(stringify(std::tuple(1, 2.5, 'c'))) == "{ 1, 2.5, 'c' }");
    CHECK(text_of(stringify(Celsius{21})) == "21 C");
    CHECK(text_of(stringify(std::vector<Celsius>{{1}, {2}})) == "{ 1 C, 2 C }");
    CHECK(text_of(stringify(Vec3{1, 2, 3.5f})) == "(1.0f, 2.0f, 3.5f)");
    CHECK(text_of(stringify(1.0)) == "1.0");
    CHECK(text_of(stringify(10.0f)) == "10.0f");
    CHECK(text_of(stringify(0.1f)) == "0.1f");
    CHECK(text_of(stringify(-0.0)) == "-0.0");
    CHECK(text_of(stringify(1e300)) == "1e+300");
    CHECK(text_of(stringify(std::numeric_limits<float>::infinity())) == "inf");
}

#if !defined(GNOMON_CHECK_USE_CATCH2)
TEST_CASE("a StringMaker specialization prints its type", "[text]") { CHECK(text_of(stringify(Custom{4})) == "custom 4"); }

TEST_CASE("integers compare by value whatever their signs", "[vocabulary]") {
    CHECK(-1 < 3u);
    CHECK(-1 != 0xffffffffu);
    CHECK(std::numeric_limits<std::uint64_t>::max() > -1);
}
#endif

TEST_CASE("floats print with digits that read back as the same number", "[text][property]") {
    for_all(any_float<float>(), [](float f) { return std::strtof(stringify(f).data(), nullptr) == f; });
    for_all(any_float<double>(), [](double d) { return std::strtod(stringify(d).data(), nullptr) == d; });
}

namespace {
std::vector<std::string>& log_of(int which) {
    static std::vector<std::string> logs[4];
    return logs[which];
}
}  // namespace

// The runs of one test case are judged by the next one; the tests of a file run in order unless --order rand is given.
TEST_CASE("sections: record", "[sections]") {
    std::string path = "root";
    SECTION("one") {
        path += "/one";
        SECTION("inner a") { path += "/a"; }
        SECTION("inner b") { path += "/b"; }
    }
    SECTION("two") { path += "/two"; }
    DYNAMIC_SECTION("number " << 3) { path += "/three"; }
    log_of(0).push_back(path);
    SUCCEED();
}
TEST_CASE("sections: every leaf ran once, in order", "[sections]") {
    if (!log_of(0).empty())
        CHECK(log_of(0) == std::vector<std::string>{"root/one/a", "root/one/b", "root/two", "root/three"});
}

TEST_CASE("GENERATE: record", "[generate]") {
    auto const outer = GENERATE(1, 2);
    auto const name = GENERATE(as<std::string>{}, "x", "y");
    std::string const entry = std::to_string(outer) + name;
    log_of(1).push_back(entry);
    SECTION("s") { log_of(1).push_back(entry + "s"); }
    SUCCEED();
}
TEST_CASE("GENERATE: the last generator turns fastest", "[generate]") {
    if (!log_of(1).empty())
        CHECK(log_of(1) == std::vector<std::string>{"1x", "1xs", "1y", "1ys", "2x", "2xs", "2y", "2ys"});
}

TEST_CASE("GENERATE: between sections, record", "[generate]") {
    SECTION("before") { log_of(2).push_back("before"); }
    auto const n = GENERATE(1, 2);
    SECTION("after") { log_of(2).push_back("after" + std::to_string(n)); }
    SUCCEED();
}
TEST_CASE("GENERATE: a section before a generator does not turn with it", "[generate]") {
    if (!log_of(2).empty()) CHECK(log_of(2) == std::vector<std::string>{"before", "after1", "after2"});
}

TEST_CASE("GENERATE takes ranges, tables, random values and combinations", "[generate]") {
    SECTION("range") {
        auto const n = GENERATE(range(1, 4), 10);
        CHECK((n == 10 || (n >= 1 && n < 4)));
    }
    SECTION("table") {
        auto const [number, text] = GENERATE(table<int, std::string>({{1, "1"}, {22, "22"}}));
        CHECK(std::to_string(number) == text);
    }
    SECTION("random") {
        auto const n = GENERATE(take(5, random(1, 6)));
        CHECK(n >= 1);
        CHECK(n <= 6);
    }
    SECTION("filter, map, values, repeat") {
        auto const even = GENERATE(filter([](int i) { return i % 2 == 0; }, range(0, 9)));
        CHECK(even % 2 == 0);
        auto const square = GENERATE(map([](int i) { return i * i; }, values({1, 2})));
        CHECK((square == 1 || square == 4));
    }
    SECTION("chunk") {
        auto const pair = GENERATE(chunk(2, range(0, 4)));
        CHECK(pair.size() == 2);
        CHECK(pair[0] + 1 == pair[1]);
    }
}

namespace {
struct Fixture {
    int value = 5;
};
using Widths = std::tuple<std::int8_t, std::int16_t, std::int32_t, std::int64_t, std::uint8_t, std::uint16_t, std::uint32_t, std::uint64_t>;
}  // namespace

TEST_CASE_METHOD(Fixture, "a fixture is made for each run", "[vocabulary]") {
    SECTION("a") { ++value; }
    SECTION("b") { value += 1; }
    CHECK(value == 6);
}

TEMPLATE_TEST_CASE("a template test runs for each type", "[vocabulary]", float, double) {
    CHECK(std::numeric_limits<TestType>::is_iec559);
}

TEMPLATE_LIST_TEST_CASE("integers stay in range and their choices are a bijection", "[generators]", Widths) {
    using T = TestType;
    using Limits = std::numeric_limits<T>;
    T const low = static_cast<T>(Limits::min() / 3);
    T const high = static_cast<T>(Limits::max() / 2 + 1);
    for_all(integers<T>(low, high), [&](T v) { return v >= low && v <= high; });
    for (auto const& g : {integers<T>(low, high), integers<T>(), integers<T>(T(3), T(100)), integers<T>(T(7), T(7))}) {
        for (std::uint64_t choice : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{2}, std::uint64_t{77}, g.width() / 2, g.width() - 1, g.width()}) {
            if (choice > g.width()) continue;
            CHECK(g.encode(g.decode(choice)) == choice);
        }
        CHECK(g.encode(g.lo) <= g.width());
        CHECK(g.decode(g.encode(g.lo)) == g.lo);
        CHECK(g.decode(g.encode(g.hi)) == g.hi);
    }
    CHECK(integers<T>().decode(0) == 0);
    CHECK(integers<T>(T(3), T(100)).decode(0) == 3);
}

TEST_CASE("small integer ranges are covered whole, large ones at their edges", "[generators]") {
    std::set<int> seen;
    sample(integers(-5, 5), 1000, [&](int v) { seen.insert(v); });
    CHECK(seen.size() == 11);
    std::set<std::int32_t> edges;
    sample(integers<std::int32_t>(), 20000, [&](std::int32_t v) { edges.insert(v); });
    for (std::int32_t v : {0, 1, -1, 2, 1024, 1023, 65536, std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()}) {
        CAPTURE(v);
        CHECK(edges.count(v) == 1);
    }
}

TEMPLATE_TEST_CASE("any_float finds the edge values", "[generators]", float, double) {
    using T = TestType;
    using Limits = std::numeric_limits<T>;
    using std::nextafter;
    T const inf = Limits::infinity();
    std::set<T> seen;
    bool negative_zero = false, nan = false;
    std::size_t denormal = 0, far = 0, total = 20000;
    sample(any_float<T>().with_nan().with_inf(), total, [&](T v) {
        if (v != v) { nan = true; return; }
        seen.insert(v);
        negative_zero = negative_zero || (v == T(0) && std::signbit(v));
        denormal += std::fpclassify(v) == FP_SUBNORMAL;
        far += std::fabs(v) > T(9999800) && std::fabs(v) < T(10000200);
    });
    CHECK(nan);
    CHECK(negative_zero);
    CHECK(denormal > total / 200);
    CHECK(far > total / 50);
    for (T v : {T(0), T(1), T(-1), T(0.5), T(1e7), nextafter(T(1e7), inf), nextafter(T(1), T(2)), nextafter(T(1), T(0)), Limits::max(),
                Limits::lowest(), Limits::min(), Limits::denorm_min(), Limits::epsilon(), inf, -inf}) {
        CAPTURE(v);
        CHECK(seen.count(v) == 1);
    }
    sample(any_float<T>(), total, [&](T v) {
        if (!std::isfinite(v)) FAIL("not finite");
    });
}

TEMPLATE_TEST_CASE("floats stay in range and reach both ends and their neighbours", "[generators]", float, double) {
    using T = TestType;
    T const lo = T(-3.25), hi = T(1e6);
    std::set<T> seen;
    sample(floats(lo, hi), 20000, [&](T v) {
        seen.insert(v);
        if (!(v >= lo && v <= hi)) FAIL("out of range");
    });
    for (T v : {lo, hi, std::nextafter(lo, hi), std::nextafter(hi, lo), T(0), T(1), T(-1), T(2)}) {
        CAPTURE(v);
        CHECK(seen.count(v) == 1);
    }
    CHECK(seen.size() > 8000);
    for_all(floats(T(0.25), T(0.75)), [](T v) { return v >= T(0.25) && v <= T(0.75); });
    for_all(floats(std::numeric_limits<T>::lowest(), std::numeric_limits<T>::max()), [](T v) { return std::isfinite(v); });
    for_all(floats(T(5), T(5)), [](T v) { return v == T(5); });
}

TEST_CASE("compound generators make what they promise", "[generators][property]") {
    for_all(vector_of(integers(1, 6), 2, 9), [](std::vector<int> const& v) {
        CHECK(v.size() >= 2);
        CHECK(v.size() <= 9);
        for (int x : v) CHECK((x >= 1 && x <= 6));
    });
    for_all(array_of<4>(booleans()), tuple_of(integers(0, 1), just(7)), [](std::array<bool, 4> const& a, std::tuple<int, int> const& t) {
        return a.size() == 4 && std::get<1>(t) == 7;
    });
    for_all(strings(1, 5, 'a', 'c'), [](std::string const& s) {
        return !s.empty() && s.size() <= 5 && s.find_first_not_of("abc") == std::string::npos;
    });
    for_all(one_of(just(1), integers(10, 20)), [](int v) { return v == 1 || (v >= 10 && v <= 20); });
    for_all(element_of({2, 3, 5, 7}), [](int v) { return v == 2 || v == 3 || v == 5 || v == 7; });
    for_all(map(integers(0, 9), [](int v) { return v * 2; }), [](int v) { return v % 2 == 0; });
    for_all(filter(integers(0, 99), [](int v) { return v % 3 == 0; }), [](int v) { return v % 3 == 0; });
    for_all(bind(integers(1, 5), [](int n) { return vector_of(just(n), 0, 5); }), [](std::vector<int> const& v) {
        for (int x : v)
            if (x != v[0]) return false;
        return true;
    });
}

TEST_CASE("lists have all lengths", "[generators]") {
    std::set<std::size_t> lengths;
    sample(vector_of(booleans(), 0, 12), 2000, [&](std::vector<bool> const& v) { lengths.insert(v.size()); });
    CHECK(lengths.size() == 13);
}

TEST_CASE("a lambda is a generator, and so is a struct", "[generators][property]") {
    struct Evens {
        int operator()(Choices& choices) const { return 2 * integers(0, 50)(choices); }
    };
    STATIC_REQUIRE(Generator<Evens>);
    STATIC_REQUIRE_FALSE(Generator<int>);
    auto const pairs = [](Choices& choices) {
        int const a = integers(0, 9)(choices);
        return std::pair(a, integers(a, 9)(choices));
    };
    for_all(Evens{}, pairs, [](int even, std::pair<int, int> const& p) { return even % 2 == 0 && p.first <= p.second; });
}

TEST_CASE("the same seed and case give the same values", "[property]") {
    std::vector<int> first, second;
    for (std::vector<int>* out : {&first, &second}) {
        Choices choices(7, 0);
        for (std::uint64_t i = 0; i < 100; ++i) {
            choices.begin_case(i);
            out->push_back(integers<int>()(choices));
        }
    }
    CHECK(first == second);
    Choices alone(7, 31);
    CHECK(integers<int>()(alone) == first[31]);
}

TEST_CASE("for_all runs the number of cases it is told, and nests", "[property]") {
    int count = 0;
    for_all(cases(250), integers(0, 9), [&](int) { ++count; });
    bool const plain = count == 250;
    CHECK((plain || std::getenv("GNOMON_PROPERTY_CASES") || std::getenv("GNOMON_PROPERTY_CASE") || count == 1 || count % 25 == 0));
    for_all(cases(20), integers(1, 9), [](int n) { for_all(cases(20), integers(0, n), [n](int m) { CHECK(m <= n); }); });
    int odd = 0;
    for_all(cases(100), integers(0, 99), [&](int v) {
        assume(v % 2 == 1);
        ++odd;
        CHECK(v % 2 == 1);
    });
    CHECK(odd >= 1);
}

TEST_CASE("INFO and CAPTURE are free to appear anywhere", "[vocabulary]") {
    INFO("a " << 1 << " b");
    CAPTURE(1 + 1);
    UNSCOPED_INFO("c");
    CHECK(true);
    for (int i = 0; i < 2; ++i) {
        INFO("i " << i);
        CHECK(i < 2);
    }
}

TEST_CASE("SKIP leaves the test case", "[vocabulary][.skip]") {
    SKIP("on purpose");
    FAIL("not reached");
}
