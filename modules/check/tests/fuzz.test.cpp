#include <gnomon/check/check.hpp>
#include <gnomon/check/fuzz_driver.hpp>
#include <gnomon/check/fuzz_input.hpp>

namespace {

using gnomon::check::FuzzBytes;
using gnomon::check::FuzzSeeds;
using gnomon::check::FuzzWriter;

FuzzSeeds two_seeds() {
    FuzzSeeds seeds;
    seeds.add("letters", {'a', 'b', 'c', 'd', 'e', 'f', 'g', 'h'});
    seeds.add("empty", {});
    return seeds;
}

}  // namespace

TEST_CASE("fuzz bytes read what the writer wrote, and zeros behind it", "[fuzz]") {
    FuzzWriter out;
    out.put(1.5F).in(-3, 7).flag(true).put(std::uint64_t{1} << 40U);
    FuzzBytes in(out.bytes);
    CHECK(in.take<float>() == 1.5F);
    CHECK(in.in(-3, 10) == 7);
    CHECK(in.flag());
    CHECK(in.take<std::uint64_t>() == std::uint64_t{1} << 40U);
    CHECK(in.empty());
    CHECK(in.take<std::uint32_t>() == 0);
    CHECK(in.in(5, 9) == 5);
}

TEST_CASE("a value that the input ends in the middle of has zeros for the rest", "[fuzz]") {
    std::uint8_t const bytes[] = {0xFF, 0x01};
    FuzzBytes in(bytes);
    CHECK(in.take<std::uint32_t>() == 0x1FF);
    CHECK(in.empty());
}

TEST_CASE("any two bytes give an integer in the range", "[fuzz]") {
    for (int i = 0; i < 65536; ++i) {
        std::uint8_t const bytes[] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8)};
        int const value = FuzzBytes(bytes).in(-16384, 16384);
        if (value < -16384 || value > 16384) CHECK(value == 0);
    }
}

TEST_CASE("mutations depend on their number alone and differ", "[fuzz]") {
    FuzzSeeds const seeds = two_seeds();
    std::uint64_t hash = 0xCBF29CE484222325ULL;
    int same = 0;
    for (std::uint64_t i = 0; i < 2'000; ++i) {
        auto const bytes = gnomon::check::detail::fuzz_mutation(seeds, i);
        for (std::uint8_t const b : bytes) hash = (hash ^ b) * 0x100000001B3ULL;
        same += bytes == seeds.seeds[static_cast<std::size_t>(i % 2)].bytes ? 1 : 0;
    }
    CHECK(same < 400);
    CHECK(hash == 3186629003710091914ULL);  // The same on every machine, with every compiler.
}
