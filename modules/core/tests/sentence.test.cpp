#include <gnomon/check/check.hpp>
#include <gnomon/core/sentence.hpp>

#include <limits>
#include <string>

TEST_CASE("sentences name small and large numbers, and what is none", "[core]") {
    using gnomon::core::sentence;
    using gnomon::core::text_of;
    CHECK(text_of(0.1) == "0.1");
    CHECK(text_of(1e-12) == "1e-12");
    CHECK(text_of(-1e300) == "-1e+300");
    CHECK(text_of(std::numeric_limits<double>::infinity()) == "inf");
    CHECK(sentence({"near ", text_of(3.0), " m"}) == "near 3 m");
    CHECK(sentence({}).empty());
}
