#include <gnomon/check/check.hpp>
#include <gnomon/core/result.hpp>

#include <memory>
#include <string>

namespace {

using namespace gnomon::core;

enum class ParseError : unsigned char { empty, not_a_digit };

Result<int, ParseError> digit(std::string const& text) {
    if (text.empty()) return Failure{ParseError::empty, "the text is empty; give one digit"};
    if (text[0] < '0' || text[0] > '9') return Failure{ParseError::not_a_digit, "'" + text + "' is not a digit"};
    return text[0] - '0';
}

}  // namespace

TEST_CASE("a result holds its value or its failure, never both", "[core][result]") {
    auto const good = digit("7");
    REQUIRE(good);
    CHECK(*good == 7);
    CHECK(good.value_or(1) == 7);
    auto const bad = digit("x");
    REQUIRE_FALSE(bad);
    CHECK(bad.failure().code == ParseError::not_a_digit);
    CHECK(bad.failure().message == "'x' is not a digit");
    CHECK(bad.value_or(1) == 1);
}

TEST_CASE("map and and_then run on a value and pass a failure through", "[core][result]") {
    auto const twice = [](int x) { return 2 * x; };
    auto const next = [](int x) { return digit(std::to_string(x + 1)); };
    CHECK(digit("4").map(twice).value() == 8);
    CHECK(digit("").map(twice).failure().code == ParseError::empty);
    CHECK(digit("4").and_then(next).value() == 5);
    CHECK(digit("y").and_then(next).failure().message == "'y' is not a digit");
}

TEST_CASE("a move-only value can be taken out", "[core][result]") {
    Result<std::unique_ptr<int>, ParseError> boxed = std::make_unique<int>(3);
    std::unique_ptr<int> const taken = std::move(boxed).value();
    CHECK(*taken == 3);
}
