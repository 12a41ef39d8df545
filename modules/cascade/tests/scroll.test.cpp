#include <gnomon/cascade/scroll.hpp>
#include <gnomon/check/check.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::check;
using cascade::MapScroll;
using cascade::MapTexels;
using cascade::Place;
using cascade::ScrollStats;

__extension__ typedef __int128 Wide;

template <class T>
struct OwnMap {
    std::int32_t size_px;
    std::vector<T> texels;

    explicit OwnMap(std::int32_t size)
        : size_px(size), texels(static_cast<std::size_t>(size) * static_cast<std::size_t>(size + 3), T{}) {}
    MapTexels<T> view() { return {texels.data(), size_px, size_px + 3}; }
    MapTexels<T const> view() const { return {texels.data(), size_px, size_px + 3}; }
};

std::uint32_t hash_of(std::uint64_t x) {
    x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
    x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
    return static_cast<std::uint32_t>(x >> 32U);
}

template <class T>
T texel_of(std::int64_t code, std::int64_t last, bool reversed) {
    std::int64_t const held = reversed ? last - code : code;
    if constexpr (std::is_integral_v<T>)
        return static_cast<T>(held);
    else
        return static_cast<T>(held) * static_cast<T>(0x1p-24F);
}

struct Case {
    std::int32_t size;
    Place shift;
    std::int32_t codes;
    bool reversed;
    std::uint32_t seed;
};

std::string check_string(Case const& c) {
    return "size " + std::to_string(c.size) + " shift " + std::to_string(c.shift.x) + " " + std::to_string(c.shift.y) +
           " " + std::to_string(c.shift.z) + " codes " + std::to_string(c.codes) + (c.reversed ? " reversed" : "");
}

auto scroll_cases(std::int32_t codes_of_floats) {
    return [codes_of_floats](Choices& choices) {
        Case c{};
        c.size = choices.draw(31) == 31 ? 600 : integers(1, 24)(choices);
        auto const move = [&](std::int64_t size) -> std::int64_t {
            switch (choices.draw(5)) {
                case 0: return 0;
                case 1: return size * (choices.draw(1) != 0 ? -1 : 1);
                case 2: return (choices.draw(1) != 0 ? -1 : 1) * (std::int64_t{1} << (40 + choices.draw(20)));
                default:
                    return integers(-static_cast<int>(std::min<std::int64_t>(size, 100000)),
                                    static_cast<int>(std::min<std::int64_t>(size, 100000)))(choices);
            }
        };
        c.codes = codes_of_floats != 0 ? codes_of_floats : element_of({65535, 100, 20})(choices);
        c.shift.x = move(c.size);
        c.shift.y = move(c.size);
        c.shift.z = move(c.codes);
        c.reversed = choices.draw(1) != 0;
        c.seed = static_cast<std::uint32_t>(choices.draw(1000));
        return c;
    };
}

/// Codes of a random map; a third of them the last, some near either end.
std::vector<std::int64_t> random_codes(Case const& c) {
    std::vector<std::int64_t> codes(static_cast<std::size_t>(c.size) * static_cast<std::size_t>(c.size));
    for (std::size_t i = 0; i < codes.size(); ++i) {
        std::uint32_t const h = hash_of(i * 977 + c.seed * 1000003ULL);
        std::int64_t const inner = static_cast<std::int64_t>(h >> 4U) % (std::int64_t{c.codes} + 1);
        codes[i] = h % 3 == 0 ? c.codes : h % 7 == 0 ? inner % 3 : h % 11 == 0 ? c.codes - inner % 3 : inner;
    }
    return codes;
}

/// By the definition, one texel after the other, in wide integers.
std::int64_t expected_code(Case const& c, std::vector<std::int64_t> const& codes, std::int32_t x, std::int32_t y) {
    Wide const from_x = static_cast<Wide>(x) + c.shift.x;
    Wide const from_y = static_cast<Wide>(y) + c.shift.y;
    if (from_x < 0 || from_y < 0 || from_x >= c.size || from_y >= c.size) return c.codes;
    std::int64_t const held = codes[static_cast<std::size_t>(from_y * c.size + from_x)];
    if (held == c.codes) return c.codes;
    Wide const moved = static_cast<Wide>(held) - c.shift.z;
    return moved < 0 ? 0 : moved > c.codes ? c.codes : static_cast<std::int64_t>(moved);
}

ScrollStats expected_stats(Case const& c, std::vector<std::int64_t> const& codes) {
    ScrollStats stats;
    for (std::int32_t y = 0; y < c.size; ++y)
        for (std::int32_t x = 0; x < c.size; ++x) {
            Wide const from_x = static_cast<Wide>(x) + c.shift.x;
            Wide const from_y = static_cast<Wide>(y) + c.shift.y;
            bool const seen = from_x >= 0 && from_y >= 0 && from_x < c.size && from_y < c.size;
            std::int64_t const held = seen ? codes[static_cast<std::size_t>(from_y * c.size + from_x)] : 0;
            Wide const moved = static_cast<Wide>(held) - c.shift.z;
            bool const exact = moved >= 0 && moved < c.codes;
            (!seen ? stats.exposed : held == c.codes ? stats.unwritten : exact ? stats.moved : stats.clamped) += 1;
        }
    return stats;
}

template <class T>
void check_scroll(Case const& c) {
    std::vector<std::int64_t> const codes = random_codes(c);
    OwnMap<T> from(c.size);
    OwnMap<T> to(c.size);
    for (std::int32_t y = 0; y < c.size; ++y)
        for (std::int32_t x = 0; x < c.size; ++x)
            from.view().row(y)[x] = texel_of<T>(codes[static_cast<std::size_t>(y * c.size + x)], c.codes, c.reversed);
    MapScroll const by{c.shift, c.codes, c.reversed ? math::Depth::reversed : math::Depth::forward};
    ScrollStats const stats =
        cascade::scroll<T>(MapTexels<T const>(from.view().first, c.size, c.size + 3), to.view(), by);
    ScrollStats const in_place = cascade::scroll_in_place<T>(from.view(), by);
    CHECK(stats == in_place);
    CHECK(stats == expected_stats(c, codes));
    int wrong = 0;
    for (std::int32_t y = 0; y < c.size; ++y)
        for (std::int32_t x = 0; x < c.size; ++x) {
            std::int64_t const code = expected_code(c, codes, x, y);
            T const expected = texel_of<T>(code, c.codes, c.reversed);
            wrong += to.view().row(y)[x] == expected && from.view().row(y)[x] == expected ? 0 : 1;
        }
    CHECK(wrong == 0);
}

/// A map as a shader's texel fetch sees it.
struct Fetched {
    std::vector<std::int64_t> const* codes;
    Case const* c;
    bool unorm16;

    template <class S>
    friend formula::Float<S> gn_texel(Fetched const& f, formula::Int<S> const& x, formula::Int<S> const& y) {
        std::int64_t const code = (*f.codes)[static_cast<std::size_t>(y.v * f.c->size + x.v)];
        std::int64_t const held = f.c->reversed ? f.c->codes - code : code;
        return f.unorm16 ? static_cast<float>(held) / 65535.0F : static_cast<float>(held) * 0x1p-24F;
    }
};

TEST_CASE("a scrolled map is the shifted one, far stays far and what is beyond the border is cleared, in place too",
          "[scroll]") {
    for_all(cases(600), scroll_cases(0), [](Case const& c) { check_scroll<std::uint16_t>(c); });
    for_all(cases(400), scroll_cases(cascade::float_codes), [](Case const& c) { check_scroll<float>(c); });
}

TEST_CASE("long rows that overlap themselves are scrolled in place in the right order", "[scroll]") {
    for (std::int64_t const dx : {-1, -255, -256, -257, -300, 1, 255, 256, 257, 300})
        for (std::int64_t const dy : {0, 1, -1})
            check_scroll<std::uint16_t>({600, {dx, dy, 3}, cascade::unorm16_codes, dx % 2 == 0, 5});
}

TEST_CASE("the shader's texel is the scrolled map's", "[scroll]") {
    auto const check = [](Case const& c, bool unorm16) {
        std::vector<std::int64_t> const codes = random_codes(c);
        Fetched const map{&codes, &c, unorm16};
        MapScroll const by{c.shift, c.codes, c.reversed ? math::Depth::reversed : math::Depth::forward};
        formula::GnScroll const words = cascade::shader_scroll(by, c.size, unorm16);
        int wrong = 0;
        for (std::int32_t y = 0; y < c.size; ++y)
            for (std::int32_t x = 0; x < c.size; ++x) {
                std::int64_t const code = expected_code(c, codes, x, y);
                std::int64_t const held = c.reversed ? c.codes - code : code;
                float const got = gn_scrolled_texel(words, map, formula::Int<float>(x), formula::Int<float>(y)).v;
                if (unorm16)
                    wrong += math::code_of_depth(got) == held ? 0 : 1;
                else
                    wrong += got == static_cast<float>(held) * 0x1p-24F ? 0 : 1;
            }
        CHECK(wrong == 0);
    };
    for_all(cases(300), scroll_cases(cascade::unorm16_codes), [&](Case const& c) { check(c, true); });
    for_all(cases(300), scroll_cases(cascade::float_codes), [&](Case const& c) { check(c, false); });
}

TEST_CASE("a depth that is no number counts as unwritten", "[scroll]") {
    float const nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(formula::gn_scrolled(formula::Float<float>(nan), 0.5F, 1.0F, false).v == 1.0F);
    CHECK(formula::gn_scrolled(formula::Float<float>(nan), 0.5F, 1.0F, true).v == 0.0F);
}

}  // namespace
