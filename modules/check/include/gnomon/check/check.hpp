#pragma once
// gnomon::check: a test harness in one file, with Catch2 v2's vocabulary, and property-based tests.
//
// One translation unit of a test program writes
//
//     #define GNOMON_CHECK_MAIN
//     #include <gnomon/check/check.hpp>
//
// and gets main() and all compiled code; every other file includes the header only, and stays light:
// no <iostream>, <string>, <functional>, <memory>, <chrono>. With GNOMON_CHECK_USE_CATCH2 defined
// the same vocabulary comes from <catch2/catch.hpp> (2.13), and this file adds properties and SKIP.
//
//     TEST_CASE("addition commutes", "[math]") {
//         CHECK(1 + 1 == 2);
//         for_all(integers(-9, 9), integers(-9, 9), [](int a, int b) { CHECK(a + b == b + a); });
//     }
//
// The generator concept. A generator is any const-callable `g(Choices&)` that returns a value: a small
// struct, or a lambda. It asks `Choices` for random integers and must use nothing else that varies.
//
//     struct Point { int x, y; };
//     inline auto points() {
//         return [](Choices& choices) { return Point{integers(-9, 9)(choices), integers(-9, 9)(choices)}; };
//     }
//
// Shrinking, replay and printing need nothing more: a failing case is a short list of integers, which
// is made shorter and smaller while the case keeps failing; 0 is always the simplest choice. So: draw the
// simple alternative as 0, draw "what kind" before "how much", and values shrink well by themselves.
// To print a type of your own, write `check_string(T const&)` beside it (found by ADL; returns anything
// like a string), or specialize Catch::StringMaker<T> with `static std::string convert(T const&)`.
//
// Exception to the size rule: the harness is one file by requirement, so that it can be copied alone.
//
// Contents
//    1  configuration                        both modes
//    2  Text: a small string                 both modes
//    3  write(): values as text              both modes
//    4  Choices: what generators draw from   both modes
//    5  generators                           both modes
//    6  for_all                              both modes
//    7  Catch2 underneath                    GNOMON_CHECK_USE_CATCH2
//    8  assertions and messages              own harness
//    9  Approx and matchers                  own harness
//   10  GENERATE                             own harness
//   11  test registry and sections           own harness
//   12  macros                               own harness
//   13  compiled part: text, choices, shrinking    GNOMON_CHECK_MAIN, both modes
//   14  compiled part: runner, reporters, command line, main()    GNOMON_CHECK_MAIN, own harness

// ---- 1 configuration ------------------------------------------------------------------------------
#if defined(CATCH_CONFIG_MAIN) && !defined(GNOMON_CHECK_MAIN)
#define GNOMON_CHECK_MAIN
#endif
#if defined(GNOMON_CHECK_USE_CATCH2)
#if defined(GNOMON_CHECK_MAIN) && !defined(CATCH_CONFIG_MAIN)
#define CATCH_CONFIG_MAIN
#endif
#include <catch2/catch.hpp>
#endif

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <initializer_list>
#include <iosfwd>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#if defined(__cpp_exceptions)
#define GNOMON_CHECK_EXCEPTIONS 1
#else
#define GNOMON_CHECK_EXCEPTIONS 0
#endif

#if !defined(GNOMON_CHECK_USE_CATCH2)
namespace Catch {
/// Customization point: specialize with `static std::string convert(T const&)` to print a T.
template <class T, class = void>
struct StringMaker {};
}  // namespace Catch
#endif

namespace gnomon::check {

// ---- 2 Text: a small string -----------------------------------------------------------------------

/// A growing char buffer, so that this header needs no <string>. Never null, always terminated.
class Text {
public:
    Text() noexcept = default;
    Text(char const* text);
    Text(char const* text, std::size_t size);
    Text(Text const& other);
    Text(Text&& other) noexcept;
    Text& operator=(Text other) noexcept;
    ~Text();

    Text& append(char const* text, std::size_t size);
    Text& append(char const* text);
    Text& append(char c);
    Text& append(Text const& text);

    [[nodiscard]] char const* data() const noexcept { return data_ ? data_ : ""; }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }

private:
    char* data_ = nullptr;
    std::size_t size_ = 0;
    std::size_t capacity_ = 0;
};

// ---- 3 write(): values as text --------------------------------------------------------------------
namespace detail {

template <class T>
using Bare = std::remove_cv_t<std::remove_reference_t<T>>;

template <class T>
concept StringLike = requires(T const& s) {
    { s.data() } -> std::convertible_to<char const*>;
    { s.size() } -> std::convertible_to<std::size_t>;
} && (requires { typename T::traits_type; } || std::is_same_v<T, Text>);

template <class T>
concept HasStringMaker = requires(T const& v) { Catch::StringMaker<T>::convert(v); };

template <class T>
concept HasCheckString = requires(T const& v) { check_string(v); };

template <class T>
concept OptionalLike = requires(T const& v) {
    { v.has_value() } -> std::same_as<bool>;
    *v;
};

template <class T>
concept TupleLike = requires { std::tuple_size<T>::value; };

// A range that contains itself (a file path) has no end of printing.
template <class T>
concept RangeLike = requires(T const& v) {
    v.begin() != v.end();
    *v.begin();
} && !std::is_same_v<Bare<decltype(*std::declval<T const&>().begin())>, T>;

// GLM's vectors and matrices: a static length() and an index.
template <class T>
concept VectorLike = requires(T const& v) {
    typename T::value_type;
    T::length();
    v[0];
};

void put_signed(Text& out, long long value);
void put_unsigned(Text& out, unsigned long long value);
void put_float(Text& out, float value);
void put_double(Text& out, double value);
void put_long_double(Text& out, long double value);
void put_char(Text& out, char value);
void put_quoted(Text& out, char const* text, std::size_t size);
void put_c_string(Text& out, char const* text);
void put_pointer(Text& out, void const* pointer);

template <class T>
void write(Text& out, T const& value);

template <class S>
void append_string(Text& out, S const& text) {
    if constexpr (std::is_convertible_v<S const&, char const*>)
        out.append(static_cast<char const*>(text));
    else
        out.append(text.data(), text.size());
}

template <class T>
void write_arithmetic(Text& out, T value) {
    if constexpr (std::is_same_v<T, bool>)
        out.append(value ? "true" : "false");
    else if constexpr (std::is_same_v<T, char>)
        put_char(out, value);
    else if constexpr (std::is_same_v<T, float>)
        put_float(out, value);
    else if constexpr (std::is_same_v<T, double>)
        put_double(out, value);
    else if constexpr (std::is_floating_point_v<T>)
        put_long_double(out, value);
    else if constexpr (std::is_signed_v<T>)
        put_signed(out, static_cast<long long>(value));
    else
        put_unsigned(out, static_cast<unsigned long long>(value));
}

template <class Range>
void write_range(Text& out, Range const& range) {
    char const* separator = "{ ";
    for (auto const& element : range) {
        out.append(separator);
        write(out, element);
        separator = ", ";
    }
    out.append(separator[0] == '{' ? "{ }" : " }");
}

template <class Tuple, std::size_t... Is>
void write_tuple(Text& out, Tuple const& tuple, std::index_sequence<Is...>) {
    using std::get;
    out.append("{ ");
    ((out.append(Is == 0 ? "" : ", "), write(out, get<Is>(tuple))), ...);
    out.append(" }");
}

template <class Vector>
void write_vector(Text& out, Vector const& vector) {
    using Index = decltype(Vector::length());
    for (Index i = 0; i < Vector::length(); ++i) {
        out.append(i == 0 ? "(" : ", ");
        write(out, vector[i]);
    }
    out.append(")");
}

template <class T>
void write_pointer(Text& out, T value) {
    if constexpr (std::is_same_v<T, std::nullptr_t>)
        out.append("nullptr");
    else if constexpr (std::is_convertible_v<T, char const*>)
        put_c_string(out, value);
    else if constexpr (std::is_function_v<std::remove_pointer_t<T>>)
        put_pointer(out, reinterpret_cast<void const*>(value));
    else
        put_pointer(out, const_cast<void const*>(static_cast<void const volatile*>(value)));
}

template <class T>
void write_class(Text& out, T const& value) {
    if constexpr (StringLike<T>)
        put_quoted(out, value.data(), value.size());
    else if constexpr (std::is_convertible_v<T const&, std::exception const&>)
        out.append(static_cast<std::exception const&>(value).what());
    else if constexpr (OptionalLike<T>) {
        if (value.has_value()) write(out, *value);
        else out.append("{ }");
    } else if constexpr (RangeLike<T>)
        write_range(out, value);
    else if constexpr (TupleLike<T>)
        write_tuple(out, value, std::make_index_sequence<std::tuple_size<T>::value>{});
    else if constexpr (VectorLike<T>)
        write_vector(out, value);
    else if constexpr (requires { value.get(); value.operator->(); })
        put_pointer(out, value.get());
    else
        out.append("{?}");
}

/// Appends `value` as a reader of a failure wants it: quoted strings, floats that read back equal.
template <class T>
void write(Text& out, T const& value) {
    if constexpr (HasCheckString<T>)
        append_string(out, check_string(value));
#if !defined(GNOMON_CHECK_USE_CATCH2)
    else if constexpr (HasStringMaker<T>)
        append_string(out, Catch::StringMaker<T>::convert(value));
#endif
    else if constexpr (std::is_arithmetic_v<T>)
        write_arithmetic(out, value);
    else if constexpr (std::is_array_v<T> && std::is_convertible_v<T const&, char const*>)
        put_c_string(out, value);
    else if constexpr (std::is_array_v<T>)
        write_range(out, value);
    else if constexpr (std::is_enum_v<T>)
        write_arithmetic(out, +static_cast<std::underlying_type_t<T>>(value));
    else if constexpr (std::is_pointer_v<T> || std::is_same_v<T, std::nullptr_t>)
        write_pointer(out, value);
    else if constexpr (std::is_class_v<T> || std::is_union_v<T>)
        write_class(out, value);
    else
        out.append("{?}");
}

}  // namespace detail

/// The text that a failure shows for `value`.
template <class T>
[[nodiscard]] Text stringify(T const& value) {
    Text out;
    detail::write(out, value);
    return out;
}

// ---- 4 Choices: what generators draw from ---------------------------------------------------------
namespace detail {

struct Tape;  // the recorded choices of one case; compiled part
std::uint64_t tape_next(Tape& tape, std::uint64_t max, std::uint64_t suggestion);
void tape_span(Tape& tape, bool begin);
void tape_reject();

constexpr std::uint64_t mix64(std::uint64_t x) noexcept {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// The high 64 bits of a product.
constexpr std::uint64_t high_product(std::uint64_t a, std::uint64_t b) noexcept {
#if defined(__SIZEOF_INT128__)
    __extension__ using Wide = unsigned __int128;
    return static_cast<std::uint64_t>((static_cast<Wide>(a) * b) >> 64);
#else
    std::uint64_t const low = 0xffffffffu;
    std::uint64_t const middle = (a >> 32) * (b & low) + (((a & low) * (b & low)) >> 32);
    std::uint64_t const other = (a & low) * (b >> 32) + (middle & low);
    return (a >> 32) * (b >> 32) + (middle >> 32) + (other >> 32);
#endif
}

}  // namespace detail

/// The source of every generator: a stream of integers that is random at first, and recorded and replayed when a
/// case fails. While replaying, a draw returns what was recorded (at most `max`), and 0 after its end.
class Choices {
public:
    Choices(std::uint64_t seed, std::uint64_t case_index, detail::Tape* tape = nullptr) noexcept
        : seed_(seed), tape_(tape) {
        begin_case(case_index);
    }

    /// Restarts the stream of case `index`: the same seed and index give the same values everywhere.
    void begin_case(std::uint64_t index) noexcept { state_ = detail::mix64(seed_ + index * 0xd1342543de82ef95u); }

    /// An integer in [0, max], uniform; 0 is the simplest.
    [[nodiscard]] std::uint64_t draw(std::uint64_t max) { return draw_as(max, uniform(max)); }

    /// As `draw`, but chosen as `suggestion` while random. The distribution is the generator's business, the
    /// shrinker sees only the number. Expects: suggestion <= max.
    [[nodiscard]] std::uint64_t draw_as(std::uint64_t max, std::uint64_t suggestion) {
        if (!tape_) [[likely]] return suggestion;
        return detail::tape_next(*tape_, max, suggestion);
    }

    /// True with odds of `numerator` in 65536; false is the simpler.
    [[nodiscard]] bool chance(std::uint32_t numerator) {
        return draw_as(1, (raw() & 0xffffu) < numerator ? 1u : 0u) != 0;
    }

    /// 64 random bits that are not recorded: only for computing suggestions.
    [[nodiscard]] std::uint64_t raw() noexcept {
        state_ += 0x9e3779b97f4a7c15u;
        return detail::mix64(state_);
    }

    /// A random integer in [0, max] that is not recorded: only for computing suggestions.
    [[nodiscard]] std::uint64_t uniform(std::uint64_t max) noexcept {
        std::uint64_t const bits = raw();
        return max == ~std::uint64_t{0} ? bits : detail::high_product(bits, max + 1);
    }

    /// Marks the choices of one part (an element of a list): the shrinker tries to drop it whole.
    struct Span {
        explicit Span(Choices& choices) : tape(choices.tape_) {
            if (tape) detail::tape_span(*tape, true);
        }
        ~Span() {
            if (tape) detail::tape_span(*tape, false);
        }
        Span(Span const&) = delete;
        Span& operator=(Span const&) = delete;
        detail::Tape* tape;
    };

    /// Gives this case up as unsuitable; it is not counted. Throws; without exceptions it marks the case.
    void reject() {
        rejected_ = true;
        detail::tape_reject();
    }
    [[nodiscard]] bool rejected() const noexcept { return rejected_; }
    void clear_rejected() noexcept { rejected_ = false; }

private:
    std::uint64_t state_ = 0;
    std::uint64_t seed_;
    detail::Tape* tape_;
    bool rejected_ = false;
};

/// Anything that makes a value from choices.
template <class G>
concept Generator = requires(G const& g, Choices& choices) {
    g(choices);
} && !std::is_void_v<decltype(std::declval<G const&>()(std::declval<Choices&>()))>;

template <Generator G>
using ValueOf = detail::Bare<decltype(std::declval<G const&>()(std::declval<Choices&>()))>;

/// Leaves this case of for_all out unless `condition` holds. Prefer a generator that makes only legal values.
inline void assume(bool condition) {
    if (!condition) detail::tape_reject();
}

// ---- 5 generators ---------------------------------------------------------------------------------

/// Integers in [lo, hi] of any width. Favours the ends, zero, small values and powers of two; shrinks towards 0,
/// or the end nearest to it.
template <class T>
struct Integers {
    using value_type = T;
    T lo, hi;

    [[nodiscard]] T operator()(Choices& choices) const {
        return decode(choices.draw_as(width(), suggest(choices)));
    }

    // A choice counts outwards from the origin: 0, +1, -1, +2, -2, ..., then along the longer side.
    [[nodiscard]] constexpr std::uint64_t width() const noexcept { return wide(hi) - wide(lo); }
    [[nodiscard]] constexpr std::uint64_t origin() const noexcept {
        if constexpr (std::is_signed_v<T>)
            return wide(lo > 0 ? lo : hi < 0 ? hi : T{0});
        else
            return wide(lo);
    }
    [[nodiscard]] constexpr T decode(std::uint64_t choice) const noexcept {
        std::uint64_t const below = origin() - wide(lo);
        std::uint64_t const above = wide(hi) - origin();
        std::uint64_t const both = below < above ? below : above;
        std::uint64_t const steps = choice / 2 + (choice & 1);
        bool const outside = steps > both;
        std::uint64_t const distance = outside ? choice - both : steps;
        bool const up = outside ? above > below : (choice & 1) != 0;
        return static_cast<T>(up ? origin() + distance : origin() - distance);
    }
    [[nodiscard]] constexpr std::uint64_t encode(T value) const noexcept {
        std::uint64_t const below = origin() - wide(lo);
        std::uint64_t const above = wide(hi) - origin();
        std::uint64_t const both = below < above ? below : above;
        std::uint64_t const up = wide(value) - origin();
        bool const is_up = up <= above;
        std::uint64_t const distance = is_up ? up : origin() - wide(value);
        if (distance > both) return distance + both;
        return is_up && distance != 0 ? 2 * distance - 1 : 2 * distance;
    }

private:
    static constexpr std::uint64_t wide(T value) noexcept { return static_cast<std::uint64_t>(value); }

    [[nodiscard]] std::uint64_t suggest(Choices& choices) const noexcept {
        std::uint64_t const bits = choices.raw();
        if ((bits & 7) > 1) return choices.uniform(width());
        if ((bits & 7) == 0) {  // small: every number of digits is as likely
            std::uint64_t const small = choices.raw() >> ((bits >> 8) & 63);
            return small <= width() ? small : choices.uniform(width());
        }
        return edge(bits >> 8);
    }
    [[nodiscard]] std::uint64_t edge(std::uint64_t bits) const noexcept {
        std::uint64_t const offset = (bits >> 8) % 2;
        if ((bits & 3) == 0) return encode(static_cast<T>(wide(lo) + (offset < width() ? offset : 0)));
        if ((bits & 3) == 1) return encode(static_cast<T>(wide(hi) - (offset < width() ? offset : 0)));
        std::uint64_t const power = (std::uint64_t{1} << ((bits >> 16) & 63)) + (bits >> 24) % 3 - 1;
        std::uint64_t const value = (bits & 4) != 0 ? power : 0 - power;
        std::uint64_t const choice = value - wide(lo) <= width() ? encode(static_cast<T>(value)) : width();
        return choice <= width() ? choice : width();
    }
};

template <class T>
    requires std::is_integral_v<T>
[[nodiscard]] constexpr Integers<T> integers(T lo, T hi) noexcept {
    return {lo < hi ? lo : hi, lo < hi ? hi : lo};
}
/// All values of T.
template <class T>
    requires std::is_integral_v<T>
[[nodiscard]] constexpr Integers<T> integers() noexcept {
    return {std::numeric_limits<T>::min(), std::numeric_limits<T>::max()};
}

/// true and false; shrinks to false.
[[nodiscard]] inline auto booleans() noexcept {
    return [](Choices& choices) { return choices.draw(1) != 0; };
}

/// Always `value`.
template <class T>
[[nodiscard]] auto just(T value) {
    return [value](Choices&) -> T { return value; };
}

/// f(value) for each value of `g`.
template <Generator G, class F>
    requires std::is_invocable_v<F const&, ValueOf<G>>
[[nodiscard]] auto map(G g, F f) {
    return [g, f](Choices& choices) { return f(g(choices)); };
}

/// The values of the generator f(value): for a part that depends on another part.
template <Generator G, class F>
    requires Generator<std::invoke_result_t<F const&, ValueOf<G>>>
[[nodiscard]] auto bind(G g, F f) {
    return [g, f](Choices& choices) { return f(g(choices))(choices); };
}

/// The values of `g` for which `keep` holds. Gives the case up after 100 misses in a row.
template <Generator G, class P>
    requires std::is_invocable_r_v<bool, P const&, ValueOf<G> const&>
[[nodiscard]] auto filter(G g, P keep) {
    return [g, keep](Choices& choices) -> ValueOf<G> {
        for (int attempt = 0; attempt < 100; ++attempt) {
            Choices::Span const span(choices);
            auto value = g(choices);
            if (keep(static_cast<ValueOf<G> const&>(value))) return value;
        }
        choices.reject();
        return g(choices);
    };
}

/// One of the given values, the first is the simplest. Expects at least one.
template <class T>
[[nodiscard]] auto element_of(std::vector<T> values) {
    return [values = std::move(values)](Choices& choices) -> T {
        return values[static_cast<std::size_t>(choices.draw(values.size() - 1))];
    };
}
template <class T>
[[nodiscard]] auto element_of(std::initializer_list<T> values) {
    return element_of(std::vector<T>(values));
}

namespace detail {
template <class T, class Tuple, std::size_t... Is>
T call_nth(Tuple const& generators, std::size_t index, Choices& choices, std::index_sequence<Is...>) {
    using Call = T (*)(Tuple const&, Choices&);
    static constexpr Call calls[] = {
        [](Tuple const& all, Choices& c) -> T { return static_cast<T>(std::get<Is>(all)(c)); }...};
    return calls[index](generators, choices);
}
}  // namespace detail

/// A value of one of the generators; shrinks towards the first. The values convert to the first one's type.
template <Generator G, Generator... Gs>
[[nodiscard]] auto one_of(G first, Gs... others) {
    return [all = std::tuple<G, Gs...>(std::move(first), std::move(others)...)](Choices& choices) {
        auto const index = static_cast<std::size_t>(choices.draw(sizeof...(Gs)));
        return detail::call_nth<ValueOf<G>>(all, index, choices, std::index_sequence_for<G, Gs...>{});
    };
}

/// A tuple with one value of each generator.
template <Generator... Gs>
[[nodiscard]] auto tuple_of(Gs... generators) {
    return [all = std::tuple<Gs...>(std::move(generators)...)](Choices& choices) {
        return std::apply([&](auto const&... g) { return std::tuple<ValueOf<Gs>...>{g(choices)...}; }, all);
    };
}

namespace detail {
/// Fills a list: a flag "one more?" before each element, so that dropping an element is dropping its choices.
template <class List, class G>
[[nodiscard]] List draw_list(Choices& choices, G const& g, std::size_t min, std::size_t max) {
    std::uint64_t const bits = choices.raw();
    std::uint64_t const room = max - min;
    std::uint64_t const reach = (bits & 3) == 0 && room > 4 ? 4 : room;
    std::size_t const goal = (bits & 31) == 31 ? max : min + static_cast<std::size_t>(choices.uniform(reach));
    List list;
    while (list.size() < max) {
        Choices::Span const span(choices);
        bool const more = list.size() < min || choices.draw_as(1, list.size() < goal ? 1u : 0u) != 0;
        if (!more) break;
        list.push_back(g(choices));
    }
    return list;
}
}  // namespace detail

/// A std::vector of min..max values of `g`. Shrinks by dropping elements, then by shrinking them.
template <Generator G>
[[nodiscard]] auto vector_of(G g, std::size_t min, std::size_t max) {
    return [g, min, max](Choices& choices) {
        return detail::draw_list<std::vector<ValueOf<G>>>(choices, g, min, max);
    };
}

namespace detail {
template <class T, class G, std::size_t... Is>
[[nodiscard]] std::array<T, sizeof...(Is)> draw_array(Choices& choices, G const& g, std::index_sequence<Is...>) {
    return {{(static_cast<void>(Is), g(choices))...}};
}
}  // namespace detail

/// A std::array of N values of `g`.
template <std::size_t N, Generator G>
[[nodiscard]] auto array_of(G g) {
    return [g](Choices& choices) {
        return detail::draw_array<ValueOf<G>>(choices, g, std::make_index_sequence<N>{});
    };
}

/// Characters in [lo, hi]; shrinks to 'a' where the range has it, else to lo.
struct Characters {
    using value_type = char;
    char lo, hi;
    [[nodiscard]] char operator()(Choices& choices) const {
        int const origin = lo <= 'a' && 'a' <= hi ? 'a' : lo;
        int const width = hi - lo + 1;
        int const step = static_cast<int>(choices.draw(static_cast<std::uint64_t>(width - 1)));
        return static_cast<char>(lo + (origin - lo + step) % width);
    }
};

/// A std::string (include <string>) of min..max characters in [lo, hi]; printable ASCII unless told.
template <class String = std::string>
[[nodiscard]] auto strings(std::size_t min, std::size_t max, char lo = ' ', char hi = '~') {
    return [=](Choices& choices) { return detail::draw_list<String>(choices, Characters{lo, hi}, min, max); };
}

namespace detail {

template <class T>
using BitsOf = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;

template <class T>
using SignedBitsOf = std::make_signed_t<BitsOf<T>>;

/// The place of a float in the order of all floats; -0 and +0 are neighbours. Not for NaN.
template <class T>
[[nodiscard]] constexpr std::int64_t rank_of(T value) noexcept {
    auto const bits = std::bit_cast<SignedBitsOf<T>>(value);
    return bits >= 0 ? bits : ~(bits & std::numeric_limits<SignedBitsOf<T>>::max());
}
template <class T>
[[nodiscard]] constexpr T from_rank(std::int64_t rank) noexcept {
    auto const bits = static_cast<SignedBitsOf<T>>(rank >= 0 ? rank : ~rank);
    return std::bit_cast<T>(rank >= 0 ? bits : bits | std::numeric_limits<SignedBitsOf<T>>::min());
}

template <class T>
[[nodiscard]] constexpr T power_of_two(int exponent) noexcept {
    using Limits = std::numeric_limits<T>;
    using Bits = BitsOf<T>;
    int const biased = exponent + Limits::max_exponent - 1;
    if (biased > 0) return std::bit_cast<T>(static_cast<Bits>(static_cast<Bits>(biased) << (Limits::digits - 1)));
    return std::bit_cast<T>(static_cast<Bits>(Bits{1} << (biased + Limits::digits - 2)));  // denormal
}

/// Values where float code breaks, simple ones first.
template <class T>
inline constexpr T landmarks[] = {
    T(0), T(1), T(0.5), T(2), T(10), T(1e7), T(16777216), T(0.1), T(1) / T(3), T(1e-4), T(1e10), T(4503599627370496.0),
    std::numeric_limits<T>::epsilon(), std::numeric_limits<T>::min(), std::numeric_limits<T>::denorm_min(),
    std::numeric_limits<T>::max()};
template <class T>
inline constexpr std::uint64_t landmark_count = sizeof(landmarks<T>) / sizeof(T);

/// Moves `value` by -4..4 ULPs, not beyond [lo, hi]; 0 is the simplest step.
template <class T>
[[nodiscard]] T nudge(Choices& choices, T value, T lo, T hi) {
    std::uint64_t const bits = choices.raw();
    std::uint64_t const step = choices.draw_as(8, (bits & 1) != 0 ? 0 : (bits >> 8) % 9);
    std::int64_t const rank = rank_of(value) + Integers<int>{-4, 4}.decode(step);
    std::int64_t const low = rank_of(lo), high = rank_of(hi);
    return from_rank<T>(rank < low ? low : rank > high ? high : rank);
}

/// An integer plus a fraction with few bits.
template <class T>
[[nodiscard]] T draw_dyadic(Choices& choices, std::int64_t reach) {
    auto const whole = static_cast<T>(Integers<std::int64_t>{-reach, reach}(choices));
    std::uint64_t const digits = 1 + choices.draw(9);
    auto const parts = static_cast<T>(std::uint64_t{1} << digits);
    return whole + static_cast<T>(choices.draw((std::uint64_t{1} << digits) - 1)) / parts;
}

template <class T>
[[nodiscard]] T draw_landmark(Choices& choices) {
    bool const power = choices.chance(0x6000);
    T value = T(0);
    if (power) {
        using Limits = std::numeric_limits<T>;
        value = power_of_two<T>(Integers<int>{Limits::min_exponent - Limits::digits, Limits::max_exponent - 1}(choices));
    } else {
        value = landmarks<T>[choices.draw(landmark_count<T> - 1)];
    }
    return choices.chance(0x8000) ? -value : value;
}

}  // namespace detail

/// Finite floats in [lo, hi]: mostly uniform, but the ends, their neighbours, zeros, landmarks, plain integers and
/// all magnitudes are frequent. Shrinks towards integers near 0.
template <class T>
struct Floats {
    using value_type = T;
    T lo, hi;

    [[nodiscard]] T operator()(Choices& choices) const {
        static constexpr unsigned char odds[16] = {0, 1, 2, 2, 3, 3, 4, 5, 5, 5, 5, 5, 5, 5, 5, 5};
        switch (choices.draw_as(5, odds[choices.raw() & 15])) {
            case 0: return clamp(whole(choices));
            case 1: return clamp(detail::draw_dyadic<T>(choices, 1024));
            case 2: return detail::nudge(choices, choices.chance(0x8000) ? hi : lo, lo, hi);
            case 3: return detail::nudge(choices, clamp(detail::draw_landmark<T>(choices)), lo, hi);
            case 4: return detail::from_rank<T>(Integers<std::int64_t>{detail::rank_of(lo), detail::rank_of(hi)}(choices));
            default: return clamp(uniform(choices));
        }
    }

    [[nodiscard]] constexpr T clamp(T value) const noexcept { return value < lo ? lo : value > hi ? hi : value; }

private:
    [[nodiscard]] T whole(Choices& choices) const {
        constexpr T limit = T(1 << 24);
        T const low = lo < -limit ? -limit : lo > limit ? limit : lo;
        T const high = hi > limit ? limit : hi < -limit ? -limit : hi;
        return static_cast<T>(integers(static_cast<std::int64_t>(low), static_cast<std::int64_t>(high))(choices));
    }
    [[nodiscard]] T uniform(Choices& choices) const {
        constexpr int digits = std::numeric_limits<T>::digits;
        constexpr std::uint64_t steps = std::uint64_t{1} << digits;
        T const t = static_cast<T>(choices.draw(steps)) / static_cast<T>(steps);
        return lo >= T(0) || hi <= T(0) ? outwards(t) : lo * (T(1) - t) + hi * t;
    }
    [[nodiscard]] T outwards(T t) const {  // away from zero, so that small choices are small values
        return lo >= T(0) ? lo * (T(1) - t) + hi * t : hi * (T(1) - t) + lo * t;
    }
};

template <class T>
    requires std::is_floating_point_v<T>
[[nodiscard]] constexpr Floats<T> floats(T lo, T hi) noexcept {
    static_assert(sizeof(T) == 4 || sizeof(T) == 8, "float and double only");
    return {lo < hi ? lo : hi, lo < hi ? hi : lo};
}

/// Any finite float: both zeros, denormals, powers of two, landmarks and their neighbours in ULPs, 1e7 plus a
/// little, the largest, random bits. `.with_inf()` and `.with_nan()` add those.
template <class T>
struct AnyFloat {
    using value_type = T;
    bool inf = false;
    bool nan = false;

    [[nodiscard]] constexpr AnyFloat with_inf() const noexcept { return {true, nan}; }
    [[nodiscard]] constexpr AnyFloat with_nan() const noexcept { return {inf, true}; }

    [[nodiscard]] T operator()(Choices& choices) const {
        using Limits = std::numeric_limits<T>;
        static constexpr unsigned char odds[16] = {0, 0, 1, 1, 2, 2, 3, 3, 3, 3, 3, 4, 4, 4, 4, 5};
        std::uint64_t const last = inf || nan ? 5 : 4;
        std::uint64_t const wish = odds[choices.raw() & 15];
        switch (choices.draw_as(last, wish < last ? wish : last)) {
            case 0: return static_cast<T>(Integers<int>{-(1 << 24), 1 << 24}(choices));
            case 1: return detail::draw_dyadic<T>(choices, 1024);
            case 2: return sign(choices) * (T(1e7) + detail::draw_dyadic<T>(choices, 64));
            case 3: return detail::nudge(choices, detail::draw_landmark<T>(choices), Limits::lowest(), Limits::max());
            case 4: {
                constexpr std::int64_t top = detail::rank_of(Limits::max());
                return detail::from_rank<T>(Integers<std::int64_t>{-top - 1, top}(choices));
            }
            default: return special(choices);
        }
    }

private:
    [[nodiscard]] static T sign(Choices& choices) { return choices.chance(0x8000) ? T(-1) : T(1); }
    [[nodiscard]] T special(Choices& choices) const {
        using Limits = std::numeric_limits<T>;
        bool const is_nan = nan && (!inf || choices.chance(0x8000));
        return is_nan ? Limits::quiet_NaN() : sign(choices) * Limits::infinity();
    }
};

template <class T>
    requires std::is_floating_point_v<T>
[[nodiscard]] constexpr AnyFloat<T> any_float() noexcept {
    static_assert(sizeof(T) == 4 || sizeof(T) == 8, "float and double only");
    return {};
}

// ---- 6 for_all ------------------------------------------------------------------------------------

/// How many cases for_all tries; the default is 1000. GNOMON_PROPERTY_CASES and --property-cases scale all counts
/// by their value / 1000.
struct Cases {
    std::uint64_t count;
};
[[nodiscard]] constexpr Cases cases(std::uint64_t count) noexcept { return {count}; }

namespace detail {

/// What inlined code must see of the running test program.
struct Hot {
    std::uint64_t passed = 0;      // assertions
    bool skip_passing = true;      // a passing assertion is only counted
    bool silent = false;           // inside for_all's search: nothing is reported
    bool case_failed = false;      // inside for_all: an assertion failed
};
[[nodiscard]] inline Hot& hot() noexcept {
    static constinit Hot state;
    return state;
}

/// One for_all, with its types erased, so that search, shrinking and report are compiled once.
struct Property {
    void* self;
    // Runs cases [first, last) until one fails; `at` follows. Returns the failing case, or last.
    std::uint64_t (*search)(void* self, Choices& choices, std::uint64_t& at, std::uint64_t last);
    bool (*run)(void* self, Choices& choices);  // one case; false: the function said so
    void (*show)(void* self, Choices& choices, Text& out);
    std::uint64_t cases;
};
void run_property(Property const& property);

template <class F, class... Gs>
struct PropertyBody {
    F& f;
    std::tuple<Gs const&...> generators;

    std::tuple<ValueOf<Gs>...> draw(Choices& choices) const {
        return std::apply([&](auto const&... g) { return std::tuple<ValueOf<Gs>...>{g(choices)...}; }, generators);
    }

    bool run(Choices& choices) {
        auto const values = draw(choices);
        if (choices.rejected()) return true;
        using R = decltype(std::apply(f, values));
        if constexpr (std::is_void_v<R>) {
            std::apply(f, values);
            return true;
        } else {
            return static_cast<bool>(std::apply(f, values));
        }
    }

    std::uint64_t search(Choices& choices, std::uint64_t& at, std::uint64_t last) {
        for (std::uint64_t index = at; index < last; ++index) {
            at = index;
            choices.begin_case(index);
            if (!run(choices) || hot().case_failed) return index;
            if (choices.rejected()) [[unlikely]] return index;
        }
        return last;
    }

    void show(Choices& choices, Text& out) const {
        std::size_t number = 0;
        auto const line = [&](auto const& value) {
            out.append("  argument ");
            put_unsigned(out, ++number);
            out.append(": ");
            write(out, value);
            out.append("\n");
        };
        std::apply([&](auto const&... values) { (line(values), ...); }, draw(choices));
    }

    [[nodiscard]] Property erased(Cases cases) {
        return {this,
                [](void* self, Choices& choices, std::uint64_t& at, std::uint64_t last) {
                    return static_cast<PropertyBody*>(self)->search(choices, at, last);
                },
                [](void* self, Choices& choices) { return static_cast<PropertyBody*>(self)->run(choices); },
                [](void* self, Choices& choices, Text& out) { static_cast<PropertyBody*>(self)->show(choices, out); },
                cases.count};
    }
};

template <class All, std::size_t... Is>
void for_all_split(Cases cases, All const& all, std::index_sequence<Is...>) {
    auto& f = std::get<sizeof...(Is)>(all);
    using F = std::remove_reference_t<decltype(f)>;
    PropertyBody<F, Bare<std::tuple_element_t<Is, All>>...> body{f, {std::get<Is>(all)...}};
    run_property(body.erased(cases));
}

}  // namespace detail

/// for_all([cases(n),] generators..., f): calls f with values of the generators, many times.
///
/// f uses CHECK and REQUIRE inside, or returns bool, or throws to fail. The first failing case is shrunk in
/// silence, and its smallest version is run once more with reports on, with the arguments, the seed and the
/// command that replays it. SECTION and GENERATE belong outside of f.
/// cost:    a passing case allocates nothing and records nothing: some ns plus f's own time.
template <class... Args>
void for_all(Cases count, Args&&... generators_and_f) {
    static_assert(sizeof...(Args) >= 2, "for_all needs at least one generator and a function");
    detail::for_all_split(count, std::forward_as_tuple(generators_and_f...),
                          std::make_index_sequence<sizeof...(Args) - 1>{});
}
template <class First, class... Args>
    requires(!std::is_same_v<detail::Bare<First>, Cases>)
void for_all(First&& first, Args&&... others) {
    for_all(cases(1000), std::forward<First>(first), std::forward<Args>(others)...);
}

}  // namespace gnomon::check
