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
    [[nodiscard]] char const* c_str() const noexcept { return data(); }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
    [[nodiscard]] char operator[](std::size_t index) const noexcept { return data()[index]; }
    [[nodiscard]] char const* begin() const noexcept { return data(); }
    [[nodiscard]] char const* end() const noexcept { return data() + size_; }

    /// At most `count` characters from `first`; an end beyond the text's is the text's.
    [[nodiscard]] Text part(std::size_t first, std::size_t count = npos) const;
    /// The place of `wanted` at or after `from`, else npos.
    [[nodiscard]] std::size_t find(char const* wanted, std::size_t from = 0) const noexcept;
    /// Less, equal or greater than 0, as strcmp.
    [[nodiscard]] int order(Text const& other) const noexcept;
    [[nodiscard]] bool operator==(Text const& other) const noexcept { return order(other) == 0; }

    static constexpr std::size_t npos = ~std::size_t{0};

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
        std::uint64_t const digits = static_cast<std::uint64_t>(std::bit_width(width() | 1));
        std::uint64_t const power = (std::uint64_t{1} << (bits >> 16) % digits) + (bits >> 24) % 3 - 1;
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

/// A fraction with few bits after the point.
template <class T>
[[nodiscard]] T draw_dyadic(Choices& choices, std::int64_t reach) {
    std::uint64_t const digits = 1 + choices.draw(9);
    std::int64_t const parts = std::int64_t{1} << digits;
    return static_cast<T>(Integers<std::int64_t>{-reach * parts, reach * parts}(choices)) / static_cast<T>(parts);
}

/// A landmark or a power of two, of either sign. One choice, so that other kinds of values can replace it.
template <class T>
[[nodiscard]] T draw_landmark(Choices& choices) {
    using Limits = std::numeric_limits<T>;
    constexpr int lowest = Limits::min_exponent - Limits::digits;
    constexpr auto powers = static_cast<std::uint64_t>(Limits::max_exponent - lowest);
    std::uint64_t const bits = choices.raw();
    std::uint64_t const wish = (bits & 1) != 0 ? choices.uniform(landmark_count<T> - 1)
                                               : landmark_count<T> + choices.uniform(powers - 1);
    std::uint64_t const choice = choices.draw_as(2 * (landmark_count<T> + powers) - 1, 2 * wish + (bits >> 8) % 2);
    std::uint64_t const index = choice / 2;
    bool const is_power = index >= landmark_count<T>;
    T const value = is_power ? power_of_two<T>(lowest + static_cast<int>(index - landmark_count<T>)) : landmarks<T>[index];
    return (choice & 1) != 0 ? -value : value;
}

/// A part in [0, 1]: a coarse step, then a fine one.
template <class T>
[[nodiscard]] T draw_unit(Choices& choices) {
    constexpr int fine_bits = std::numeric_limits<T>::digits - 12;
    constexpr std::uint64_t steps = std::uint64_t{1} << fine_bits;
    std::uint64_t const coarse = choices.draw(4096);
    std::uint64_t const fine = choices.draw(steps - 1);
    return (static_cast<T>(coarse) + (coarse < 4096 ? static_cast<T>(fine) / static_cast<T>(steps) : T(0))) / T(4096);
}

}  // namespace detail

/// Finite floats in [lo, hi]: mostly uniform, but the ends, their neighbours, zeros, landmarks, plain integers and
/// all magnitudes are frequent. Shrinks towards integers near 0.
template <class T>
struct Floats {
    using value_type = T;
    T lo, hi;

    // Every kind draws two choices more, the simplest one, so that the shrinker can go to any simpler kind.
    [[nodiscard]] T operator()(Choices& choices) const {
        static constexpr unsigned char odds[16] = {0, 1, 2, 2, 3, 3, 4, 5, 5, 5, 5, 5, 5, 5, 5, 5};
        switch (choices.draw_as(5, odds[choices.raw() & 15])) {
            case 0: return clamp(whole(choices));
            case 1: return clamp(detail::draw_dyadic<T>(choices, 1024));
            case 2: return detail::nudge(choices, choices.draw(1) != 0 ? hi : lo, lo, hi);
            case 3: return detail::nudge(choices, clamp(detail::draw_landmark<T>(choices)), lo, hi);
            case 4: return any_magnitude(choices);
            default: return clamp(uniform(detail::draw_unit<T>(choices)));
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
    [[nodiscard]] T any_magnitude(Choices& choices) const {
        static_cast<void>(choices.draw(0));
        return detail::from_rank<T>(Integers<std::int64_t>{detail::rank_of(lo), detail::rank_of(hi)}(choices));
    }
    [[nodiscard]] T uniform(T t) const {  // away from zero where there is one side, so that small choices are small values
        bool const downwards = lo < T(0) && hi <= T(0);
        T const from = downwards ? hi : lo;
        T const to = downwards ? lo : hi;
        return from * (T(1) - t) + to * t;
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
            case 2: return far_away(choices);
            case 3: return detail::nudge(choices, detail::draw_landmark<T>(choices), Limits::lowest(), Limits::max());
            case 4: return any_bits(choices);
            default: return special(choices);
        }
    }

private:
    [[nodiscard]] static T far_away(Choices& choices) {  // 1e7 plus or minus a little, of either sign
        T const little = detail::draw_dyadic<T>(choices, 128);
        return little < T(0) ? little - T(1e7) + T(64) : little + T(1e7) - T(64);
    }
    [[nodiscard]] static T any_bits(Choices& choices) {
        constexpr std::int64_t top = detail::rank_of(std::numeric_limits<T>::max());
        static_cast<void>(choices.draw(0));
        return detail::from_rank<T>(Integers<std::int64_t>{-top - 1, top}(choices));
    }
    [[nodiscard]] T special(Choices& choices) const {
        using Limits = std::numeric_limits<T>;
        bool const is_nan = nan && (!inf || choices.draw(1) != 0);
        return is_nan ? Limits::quiet_NaN() : choices.draw(1) != 0 ? -Limits::infinity() : Limits::infinity();
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

// ---- 7 Catch2 underneath --------------------------------------------------------------------------
#if defined(GNOMON_CHECK_USE_CATCH2)

// Catch2 v2 has no SKIP: the test ends here, as passed, with a warning.
#if !defined(SKIP)
#define SKIP(...)                                            \
    do {                                                     \
        WARN("skipped: " << "" __VA_ARGS__);                 \
        ::gnomon::check::detail::leave_test_case();          \
    } while (false)
#endif

namespace gnomon::check {
using Catch::CaseSensitive;
using Catch::MatcherBase;
using Catch::Detail::Approx;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::Equals;
using Catch::Matchers::Message;
using Catch::Matchers::Predicate;
using Catch::Matchers::StartsWith;
using Catch::Matchers::UnorderedEquals;
using Catch::Matchers::VectorContains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using Catch::Matchers::WithinULP;
namespace detail {
[[noreturn]] inline void leave_test_case() { throw Catch::TestFailureException{}; }

template <class T>
concept PrintedHere = (HasCheckString<T> || VectorLike<T> || OptionalLike<T>) && !RangeLike<T>;
}  // namespace detail
}  // namespace gnomon::check

namespace Catch {
template <class T>
    requires gnomon::check::detail::PrintedHere<T>
struct StringMaker<T, void> {
    static std::string convert(T const& value) {
        gnomon::check::Text const text = gnomon::check::stringify(value);
        return std::string(text.data(), text.size());
    }
};
}  // namespace Catch

#else  // own harness

// ---- 8 assertions and messages --------------------------------------------------------------------
namespace gnomon::check {
namespace detail {

enum SiteFlags : unsigned char {
    stop_on_failure = 0,
    go_on = 1,
    expect_false = 2,
    go_on_expect_false = 3,
    never_fail = 4,
    go_on_never_fail = 5
};

/// One assertion in the source.
struct Site {
    char const* file;
    std::uint32_t line;
    unsigned char flags;
    char const* macro;
    char const* text;

    constexpr Site(char const* in_file, std::uint32_t at_line, unsigned flag_bits, char const* name, char const* code) noexcept
        : file(in_file), line(at_line), flags(static_cast<unsigned char>(flag_bits)), macro(name), text(code) {}
};

enum class Kind : unsigned char { expression, exception, no_exception, failure, success, warning, skip };

using Expand = void (*)(Text& out, void const* expression);
void report(Site const& site, bool passed, Expand expand, void const* expression);
void report_text(Site const& site, Kind kind, Text const& text);
void put_comparison(Text& out, Text const& left, char const* sign, Text const& right);

// Called in a catch (...) block. They pass on what is not the tested code's (a REQUIRE inside it).
void report_exception(Site const& site);
[[nodiscard]] Text exception_text();

/// Integers compare by value whatever their signs, so that `v.size() == 3` needs no cast.
template <class Op, class L, class R>
[[nodiscard]] constexpr bool compare(L const& left, R const& right) {
    if constexpr (std::is_arithmetic_v<L> && std::is_arithmetic_v<R> && !std::is_same_v<L, R>) {
        if constexpr (std::is_floating_point_v<L> || std::is_floating_point_v<R>) {
            using Common = std::common_type_t<L, R>;
            return Op::call(static_cast<Common>(left), static_cast<Common>(right));
        } else if constexpr (std::is_signed_v<L> != std::is_signed_v<R>) {
            if constexpr (std::is_signed_v<L>) {
                if (left < 0) return Op::call(-1, 0);
            } else {
                if (right < 0) return Op::call(0, -1);
            }
            return Op::call(static_cast<std::uint64_t>(left), static_cast<std::uint64_t>(right));
        } else {
            return Op::call(left, right);
        }
    } else {
        return Op::call(left, right);
    }
}

template <class>
inline constexpr bool never = false;

/// `left OP right`, evaluated, with both sides kept for the report.
template <class Op, class L, class R>
struct Binary {
    L const& left;
    R const& right;
    bool passed;

    static void expand(Text& out, void const* self) {
        auto const& e = *static_cast<Binary const*>(self);
        put_comparison(out, stringify(e.left), Op::sign, stringify(e.right));
    }
    template <class T>
    void operator&&(T const&) const {
        static_assert(never<T>, "&& in an assertion: use two assertions, or parentheses around the whole");
    }
    template <class T>
    void operator||(T const&) const {
        static_assert(never<T>, "|| in an assertion: use parentheses around the whole");
    }
    template <class T>
    void operator==(T const&) const {
        static_assert(never<T>, "chained comparison in an assertion: use parentheses");
    }
};

// The six comparisons; `a & b`, `a | b`, `a ^ b` too, as they bind less tightly than these.
#define GNOMON_CHECK_OPERATOR(NAME, SIGN)                                   \
    struct NAME {                                                           \
        static constexpr char const* sign = #SIGN;                          \
        template <class A, class B>                                         \
        static constexpr bool call(A const& a, B const& b) {                \
            return static_cast<bool>(a SIGN b);                             \
        }                                                                   \
    };
GNOMON_CHECK_OPERATOR(Equal, ==)
GNOMON_CHECK_OPERATOR(NotEqual, !=)
GNOMON_CHECK_OPERATOR(Less, <)
GNOMON_CHECK_OPERATOR(LessEqual, <=)
GNOMON_CHECK_OPERATOR(Greater, >)
GNOMON_CHECK_OPERATOR(GreaterEqual, >=)
GNOMON_CHECK_OPERATOR(BitAnd, &)
GNOMON_CHECK_OPERATOR(BitOr, |)
GNOMON_CHECK_OPERATOR(BitXor, ^)
#undef GNOMON_CHECK_OPERATOR

/// The left side of an assertion, or all of it.
template <class L>
struct Lhs {
    L const& value;

    static void expand(Text& out, void const* self) { write(out, static_cast<Lhs const*>(self)->value); }

#define GNOMON_CHECK_OPERATOR(NAME, SIGN)                                   \
    template <class R>                                                      \
    [[nodiscard]] constexpr Binary<NAME, L, R> operator SIGN(R const& right) const { \
        return {value, right, compare<NAME>(value, right)};                 \
    }
    GNOMON_CHECK_OPERATOR(Equal, ==)
    GNOMON_CHECK_OPERATOR(NotEqual, !=)
    GNOMON_CHECK_OPERATOR(Less, <)
    GNOMON_CHECK_OPERATOR(LessEqual, <=)
    GNOMON_CHECK_OPERATOR(Greater, >)
    GNOMON_CHECK_OPERATOR(GreaterEqual, >=)
    GNOMON_CHECK_OPERATOR(BitAnd, &)
    GNOMON_CHECK_OPERATOR(BitOr, |)
    GNOMON_CHECK_OPERATOR(BitXor, ^)
#undef GNOMON_CHECK_OPERATOR
};

/// Splits an expression in front of its comparison: <=> binds more tightly than any of them.
struct Decomposer {
    template <class L>
    [[nodiscard]] constexpr Lhs<L> operator<=>(L const& left) const noexcept {
        return {left};
    }
};

// One call per assertion, not inlined: it saves a tenth of the compile time of a file full of them.
#if defined(__GNUC__)
[[gnu::noinline]]
#endif
inline void judge(Site const& site, bool passed, Expand expand, void const* expression) {
    if (passed != ((site.flags & expect_false) != 0) && hot().skip_passing) [[likely]]
        ++hot().passed;
    else
        report(site, passed, expand, expression);
}
template <class L>
void judge(Site const& site, Lhs<L> const& expression) {
    judge(site, static_cast<bool>(expression.value), &Lhs<L>::expand, &expression);
}
template <class Op, class L, class R>
void judge(Site const& site, Binary<Op, L, R> const& expression) {
    judge(site, expression.passed, &Binary<Op, L, R>::expand, &expression);
}

/// What INFO and its kin are written to: as an ostream would print, without one.
class Stream {
public:
    template <class T>
    Stream& operator<<(T const& value) {
        if constexpr (std::is_convertible_v<T const&, char const*>) {
            auto const* const text = static_cast<char const*>(value);
            text_.append(text ? text : "nullptr");
        } else if constexpr (StringLike<T>)
            text_.append(value.data(), value.size());
        else if constexpr (std::is_same_v<T, char>)
            text_.append(value);
        else if constexpr (std::is_same_v<T, float>)
            put_double(text_, static_cast<double>(value));
        else
            write(text_, value);
        return *this;
    }
    [[nodiscard]] Text const& text() const noexcept { return text_; }

private:
    Text text_;
};

void push_message(Site const& site, Text const& text);
void pop_message();
void unscoped_message(Site const& site, Text const& text);
void put_capture_name(Text& out, char const* names, std::size_t index);

/// A message that failures show while it is in scope.
class ScopedMessage {
public:
    ScopedMessage(Site const& site, Text const& text) : active_(!hot().silent) {
        if (active_) push_message(site, text);
    }
    ~ScopedMessage() {
        if (active_) pop_message();
    }
    ScopedMessage(ScopedMessage const&) = delete;
    ScopedMessage& operator=(ScopedMessage const&) = delete;

private:
    bool active_;
};

template <class... Ts>
[[nodiscard]] Text capture_text(char const* names, Ts const&... values) {
    Text out;
    std::size_t index = 0;
    ((out.append(index == 0 ? "" : "\n"), put_capture_name(out, names, index++), write(out, values)), ...);
    return out;
}

bool last_assertion_passed();

}  // namespace detail

// ---- 9 Approx and matchers ------------------------------------------------------------------------

/// A number that equals what is near it: within `margin`, or `epsilon` * (scale + |value|).
class Approx {
public:
    template <class T>
        requires std::is_constructible_v<double, T>
    explicit Approx(T const& value) : value_(static_cast<double>(value)) {}

    template <class T>
        requires std::is_constructible_v<double, T>
    [[nodiscard]] Approx operator()(T const& value) const {
        Approx other(*this);
        other.value_ = static_cast<double>(value);
        return other;
    }
    [[nodiscard]] static Approx custom() { return Approx(0.0); }
    [[nodiscard]] Approx operator-() const { return (*this)(-value_); }

    template <class T>
    Approx& epsilon(T const& e) { return epsilon_ = static_cast<double>(e), *this; }
    template <class T>
    Approx& margin(T const& m) { return margin_ = static_cast<double>(m), *this; }
    template <class T>
    Approx& scale(T const& s) { return scale_ = static_cast<double>(s), *this; }

    [[nodiscard]] bool equals(double other) const noexcept;
    [[nodiscard]] double value() const noexcept { return value_; }

private:
    double value_;
    double epsilon_ = static_cast<double>(std::numeric_limits<float>::epsilon()) * 100;
    double margin_ = 0;
    double scale_ = 0;
};

template <class T>
concept ApproxOperand = std::is_constructible_v<double, T> && !std::is_same_v<T, Approx>;

template <ApproxOperand T>
[[nodiscard]] bool operator==(T const& a, Approx const& b) { return b.equals(static_cast<double>(a)); }
template <ApproxOperand T>
[[nodiscard]] bool operator==(Approx const& a, T const& b) { return b == a; }
template <ApproxOperand T>
[[nodiscard]] bool operator!=(T const& a, Approx const& b) { return !(a == b); }
template <ApproxOperand T>
[[nodiscard]] bool operator!=(Approx const& a, T const& b) { return !(b == a); }
template <ApproxOperand T>
[[nodiscard]] bool operator<=(T const& a, Approx const& b) { return static_cast<double>(a) < b.value() || a == b; }
template <ApproxOperand T>
[[nodiscard]] bool operator<=(Approx const& a, T const& b) { return a.value() < static_cast<double>(b) || b == a; }
template <ApproxOperand T>
[[nodiscard]] bool operator>=(T const& a, Approx const& b) { return static_cast<double>(a) > b.value() || a == b; }
template <ApproxOperand T>
[[nodiscard]] bool operator>=(Approx const& a, T const& b) { return a.value() > static_cast<double>(b) || b == a; }

[[nodiscard]] inline Text check_string(Approx const& a) {
    Text out("Approx( ");
    detail::put_double(out, a.value());
    return out.append(" )");
}

/// Base of all matchers: `bool match(value) const` and `describe() const`, which returns anything like a string.
struct MatcherTag {};
template <class M>
concept Matcher = std::is_base_of_v<MatcherTag, M>;

/// Base for matchers of your own, as Catch2 has it.
template <class T>
struct MatcherBase : MatcherTag {
    MatcherBase() = default;
    MatcherBase(MatcherBase const&) = default;
    MatcherBase& operator=(MatcherBase const&) = default;
    virtual ~MatcherBase() = default;
    virtual bool match(T const& value) const = 0;
    virtual std::string describe() const = 0;
};

namespace matchers {

template <class A, class B>
struct AllOf : MatcherTag {
    A a;
    B b;
    AllOf(A const& first, B const& second) : a(first), b(second) {}
    template <class T>
    [[nodiscard]] bool match(T const& value) const { return a.match(value) && b.match(value); }
    [[nodiscard]] Text describe() const { return (detail::Stream() << "( " << a.describe() << " and " << b.describe() << " )").text(); }
};
template <class A, class B>
struct AnyOf : MatcherTag {
    A a;
    B b;
    AnyOf(A const& first, B const& second) : a(first), b(second) {}
    template <class T>
    [[nodiscard]] bool match(T const& value) const { return a.match(value) || b.match(value); }
    [[nodiscard]] Text describe() const { return (detail::Stream() << "( " << a.describe() << " or " << b.describe() << " )").text(); }
};
template <class A>
struct NotOf : MatcherTag {
    A a;
    explicit NotOf(A const& inner) : a(inner) {}
    template <class T>
    [[nodiscard]] bool match(T const& value) const { return !a.match(value); }
    [[nodiscard]] Text describe() const { return (detail::Stream() << "not " << a.describe()).text(); }
};

}  // namespace matchers

template <Matcher A, Matcher B>
[[nodiscard]] matchers::AllOf<A, B> operator&&(A const& a, B const& b) { return {a, b}; }
template <Matcher A, Matcher B>
[[nodiscard]] matchers::AnyOf<A, B> operator||(A const& a, B const& b) { return {a, b}; }
template <Matcher A>
[[nodiscard]] matchers::NotOf<A> operator!(A const& a) { return matchers::NotOf<A>(a); }

namespace matchers {

/// At most so many ULPs away; NaN matches nothing.
template <class T>
struct Ulps : MatcherTag {
    T target;
    std::uint64_t ulps;
    Ulps(T t, std::uint64_t u) : target(t), ulps(u) {}
    [[nodiscard]] bool match(T value) const {
        if (!(value == value && target == target)) return false;
        if (value == target) return true;
        // The two zeros are one place here: no rank between them.
        std::int64_t const a = place(value), b = place(target);
        std::uint64_t const distance = a > b ? static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b)
                                             : static_cast<std::uint64_t>(b) - static_cast<std::uint64_t>(a);
        return distance <= ulps;
    }
    [[nodiscard]] Text describe() const {
        return (detail::Stream() << "is within " << ulps << " ULPs of " << stringify(target)).text();
    }

private:
    [[nodiscard]] static std::int64_t place(T value) {
        std::int64_t const rank = detail::rank_of(value);
        return rank < 0 ? rank + 1 : rank;
    }
};

struct Absolute : MatcherTag {
    double target, margin;
    Absolute(double t, double m) : target(t), margin(m) {}
    [[nodiscard]] bool match(double value) const { return value + margin >= target && target + margin >= value; }
    [[nodiscard]] Text describe() const {
        return (detail::Stream() << "is within " << margin << " of " << target).text();
    }
};

template <class T>
struct Relative : MatcherTag {
    T target, epsilon;
    Relative(T t, T e) : target(t), epsilon(e) {}
    [[nodiscard]] bool match(T value) const {
        T const a = value < T(0) ? -value : value, b = target < T(0) ? -target : target;
        T const bound = epsilon * (a < b ? b : a);
        T const reach = bound <= std::numeric_limits<T>::max() ? bound : T(0);
        return value + reach >= target && target + reach >= value;
    }
    [[nodiscard]] Text describe() const {
        return (detail::Stream() << "and " << stringify(target) << " are within " << stringify(epsilon * T(100)) << "% of each other").text();
    }
};

[[nodiscard]] bool same_text(char const* a, char const* b, std::size_t size, bool ignore_case) noexcept;

enum class Place : unsigned char { equal, inside, start, end };

struct StringMatcher : MatcherTag {
    Text pattern;
    Place place;
    bool ignore_case;
    StringMatcher(Text text, Place where, bool ignore) : pattern(std::move(text)), place(where), ignore_case(ignore) {}

    template <class S>
    [[nodiscard]] bool match(S const& value) const {
        Text text;
        detail::append_string(text, value);
        return find(text);
    }
    [[nodiscard]] bool find(Text const& text) const noexcept;
    [[nodiscard]] Text describe() const;
};

template <class V>
struct VectorEquals : MatcherTag {
    V expected;
    bool any_order;
    VectorEquals(V const& v, bool any) : expected(v), any_order(any) {}
    [[nodiscard]] bool match(V const& value) const {
        if (value.size() != expected.size()) return false;
        if (!any_order) return value == expected;
        std::vector<bool> used(expected.size(), false);
        for (auto const& element : value)
            if (!take(element, used)) return false;
        return true;
    }
    [[nodiscard]] Text describe() const {
        return (detail::Stream() << (any_order ? "UnorderedEquals: " : "Equals: ") << stringify(expected)).text();
    }

private:
    template <class T>
    [[nodiscard]] bool take(T const& element, std::vector<bool>& used) const {
        for (std::size_t i = 0; i < expected.size(); ++i) {
            if (used[i] || !(expected[i] == element)) continue;
            used[i] = true;
            return true;
        }
        return false;
    }
};

template <class V>
struct VectorHas : MatcherTag {
    V wanted;
    explicit VectorHas(V const& v) : wanted(v) {}
    template <class W>
    [[nodiscard]] bool match(W const& value) const {
        for (auto const& w : wanted) {
            bool found = false;
            for (auto const& element : value) found = found || element == w;
            if (!found) return false;
        }
        return true;
    }
    [[nodiscard]] Text describe() const { return (detail::Stream() << "Contains: " << stringify(wanted)).text(); }
};

template <class T, class F>
struct PredicateMatcher : MatcherTag {
    F f;
    Text text;
    PredicateMatcher(F const& function, Text description) : f(function), text(std::move(description)) {}
    [[nodiscard]] bool match(T const& value) const { return f(value); }
    [[nodiscard]] Text describe() const { return text.size() != 0 ? text : Text("matches undescribed predicate"); }
};

struct MessageMatcher : MatcherTag {
    Text text;
    explicit MessageMatcher(Text expected) : text(std::move(expected)) {}
    [[nodiscard]] bool match(std::exception const& e) const;
    [[nodiscard]] Text describe() const { return (detail::Stream() << "exception message matches " << stringify(text)).text(); }
};

}  // namespace matchers

struct CaseSensitive {
    enum Choice : unsigned char { Yes, No };
};

[[nodiscard]] inline matchers::Ulps<float> WithinULP(float target, std::uint64_t ulps) { return {target, ulps}; }
[[nodiscard]] inline matchers::Ulps<double> WithinULP(double target, std::uint64_t ulps) { return {target, ulps}; }
[[nodiscard]] inline matchers::Absolute WithinAbs(double target, double margin) { return {target, margin}; }
[[nodiscard]] inline matchers::Relative<float> WithinRel(float target, float epsilon = std::numeric_limits<float>::epsilon() * 100) { return {target, epsilon}; }
[[nodiscard]] inline matchers::Relative<double> WithinRel(double target, double epsilon = std::numeric_limits<double>::epsilon() * 100) { return {target, epsilon}; }

namespace detail {
template <class S>
concept StringArgument = StringLike<S> || std::is_convertible_v<S const&, char const*>;

template <class S>
[[nodiscard]] matchers::StringMatcher string_matcher(S const& text, matchers::Place place, CaseSensitive::Choice c) {
    Text pattern;
    append_string(pattern, text);
    return {std::move(pattern), place, c == CaseSensitive::No};
}
}  // namespace detail

template <detail::StringArgument S>
[[nodiscard]] auto Equals(S const& text, CaseSensitive::Choice c = CaseSensitive::Yes) { return detail::string_matcher(text, matchers::Place::equal, c); }
template <detail::StringArgument S>
[[nodiscard]] auto Contains(S const& text, CaseSensitive::Choice c = CaseSensitive::Yes) { return detail::string_matcher(text, matchers::Place::inside, c); }
template <detail::StringArgument S>
[[nodiscard]] auto StartsWith(S const& text, CaseSensitive::Choice c = CaseSensitive::Yes) { return detail::string_matcher(text, matchers::Place::start, c); }
template <detail::StringArgument S>
[[nodiscard]] auto EndsWith(S const& text, CaseSensitive::Choice c = CaseSensitive::Yes) { return detail::string_matcher(text, matchers::Place::end, c); }
template <class T>
[[nodiscard]] auto Equals(std::vector<T> const& expected) { return matchers::VectorEquals<std::vector<T>>(expected, false); }
template <class T>
[[nodiscard]] auto UnorderedEquals(std::vector<T> const& expected) { return matchers::VectorEquals<std::vector<T>>(expected, true); }
template <class T>
[[nodiscard]] auto Contains(std::vector<T> const& wanted) { return matchers::VectorHas<std::vector<T>>(wanted); }
template <class T>
[[nodiscard]] auto VectorContains(T const& wanted) { return matchers::VectorHas<std::vector<T>>(std::vector<T>{wanted}); }
template <class T, class F>
[[nodiscard]] auto Predicate(F const& f, Text text = {}) { return matchers::PredicateMatcher<T, F>(f, std::move(text)); }
[[nodiscard]] inline matchers::MessageMatcher Message(Text text) { return matchers::MessageMatcher(std::move(text)); }

namespace detail {

template <class T, class M>
struct MatchExpression {
    T const& value;
    M const& matcher;
    static void expand(Text& out, void const* self) {
        auto const& e = *static_cast<MatchExpression const*>(self);
        write(out, e.value);
        out.append(" ");
        append_string(out, e.matcher.describe());
    }
};

template <class T, class M>
void judge_match(Site const& site, T const& value, M const& matcher) {
    if constexpr (Matcher<M>) {
        MatchExpression<T, M> const e{value, matcher};
        judge(site, matcher.match(value), &MatchExpression<T, M>::expand, &e);
    } else {
        judge_match(site, value, Equals(matcher));
    }
}

}  // namespace detail

// ---- 10 GENERATE ----------------------------------------------------------------------------------
namespace detail {

struct GeneratorBase {
    GeneratorBase() = default;
    GeneratorBase(GeneratorBase const&) = delete;
    GeneratorBase& operator=(GeneratorBase const&) = delete;
    virtual ~GeneratorBase() = default;
    virtual bool next() = 0;  // false: that was the last value
};

/// The place where the generator of one GENERATE lives between runs of its test case.
struct GeneratorSlot {
    GeneratorBase* generator = nullptr;
};
GeneratorSlot& generator_slot(char const* file, std::uint32_t line, std::uint32_t id);
std::uint64_t test_random();

}  // namespace detail

namespace generators {

template <class T>
struct IGenerator : detail::GeneratorBase {
    using type = T;
    virtual T const& get() const = 0;
};

/// Owns one generator.
template <class T>
class GeneratorWrapper {
public:
    explicit GeneratorWrapper(IGenerator<T>* generator) noexcept : generator_(generator) {}
    template <class Pointer>
        requires requires(Pointer p) { { p.release() } -> std::convertible_to<IGenerator<T>*>; }
    explicit GeneratorWrapper(Pointer pointer) noexcept : generator_(pointer.release()) {}
    GeneratorWrapper(GeneratorWrapper&& other) noexcept : generator_(std::exchange(other.generator_, nullptr)) {}
    GeneratorWrapper& operator=(GeneratorWrapper&& other) noexcept {
        std::swap(generator_, other.generator_);
        return *this;
    }
    ~GeneratorWrapper() { delete generator_; }
    [[nodiscard]] T const& get() const { return generator_->get(); }
    bool next() { return generator_->next(); }
    [[nodiscard]] IGenerator<T>* release() noexcept { return std::exchange(generator_, nullptr); }

private:
    IGenerator<T>* generator_;
};

/// A generator from a function `bool step(T& value)`, which writes the next value or returns false.
template <class T, class Step>
class StepGenerator final : public IGenerator<T> {
public:
    explicit StepGenerator(Step step) : step_(std::move(step)) { step_(value_); }
    T const& get() const override { return value_; }
    bool next() override { return step_(value_); }

private:
    Step step_;
    T value_{};
};
template <class T, class Step>
[[nodiscard]] GeneratorWrapper<T> from_step(Step step) {
    return GeneratorWrapper<T>(new StepGenerator<T, Step>(std::move(step)));
}

template <class T>
class ListGenerator final : public IGenerator<T> {
public:
    explicit ListGenerator(std::vector<T> values) : values_(std::move(values)) {}
    T const& get() const override { return values_[at_]; }
    bool next() override { return ++at_ < values_.size(); }

private:
    std::vector<T> values_;
    std::size_t at_ = 0;
};

/// Several generators one after another.
template <class T>
class ChainGenerator final : public IGenerator<T> {
public:
    explicit ChainGenerator(std::vector<GeneratorWrapper<T>> parts) : parts_(std::move(parts)) {}
    T const& get() const override { return parts_[at_].get(); }
    bool next() override { return parts_[at_].next() || ++at_ < parts_.size(); }

private:
    std::vector<GeneratorWrapper<T>> parts_;
    std::size_t at_ = 0;
};

template <class T>
struct as {};

template <class T>
[[nodiscard]] GeneratorWrapper<T> values(std::vector<T> list) { return GeneratorWrapper<T>(new ListGenerator<T>(std::move(list))); }
template <class T>
[[nodiscard]] GeneratorWrapper<T> values(std::initializer_list<T> list) { return values(std::vector<T>(list)); }
template <class T>
[[nodiscard]] auto value(T v) { return values(std::vector<T>(1, std::move(v))); }
template <class... Ts>
[[nodiscard]] auto table(std::initializer_list<std::tuple<Ts...>> rows) { return values(std::vector<std::tuple<Ts...>>(rows)); }
template <class Range>
[[nodiscard]] auto from_range(Range const& range) {
    return values(std::vector<detail::Bare<decltype(*range.begin())>>(range.begin(), range.end()));
}
template <class Iterator>
[[nodiscard]] auto from_range(Iterator first, Iterator last) { return values(std::vector<detail::Bare<decltype(*first)>>(first, last)); }

/// first, first + step, ... while before `last`.
template <class T>
[[nodiscard]] GeneratorWrapper<T> range(T first, T last, T step) {
    return from_step<T>([=, at = first, start = true](T& out) mutable {
        if (!start) at = static_cast<T>(at + step);
        start = false;
        out = at;
        return step < T{} ? last < at : at < last;
    });
}
template <class T>
[[nodiscard]] GeneratorWrapper<T> range(T first, T last) { return range<T>(first, last, static_cast<T>(first < last ? 1 : -1)); }

/// Random numbers in [low, high], without end: use it inside take().
template <class T>
[[nodiscard]] GeneratorWrapper<T> random(T low, T high) {
    return from_step<T>([=](T& out) {
        Choices choices(detail::test_random(), 0);
        if constexpr (std::is_floating_point_v<T>)
            out = low + (high - low) * (static_cast<T>(choices.raw() >> 11) / static_cast<T>(std::uint64_t{1} << 53));
        else
            out = Integers<T>{low, high}.decode(choices.uniform(Integers<T>{low, high}.width()));
        return true;
    });
}

template <class T>
[[nodiscard]] GeneratorWrapper<T> take(std::size_t count, GeneratorWrapper<T> g) {
    return from_step<T>([=, g = std::move(g), done = std::size_t{0}](T& out) mutable {
        if (done == count || (done != 0 && !g.next())) return false;
        ++done;
        out = g.get();
        return true;
    });
}
template <class T, class P>
[[nodiscard]] GeneratorWrapper<T> filter(P keep, GeneratorWrapper<T> g) {
    return from_step<T>([=, g = std::move(g), start = true](T& out) mutable {
        while (std::exchange(start, false) || g.next()) {
            if (!keep(g.get())) continue;
            out = g.get();
            return true;
        }
        return false;
    });
}
template <class U, class F, class T>
[[nodiscard]] GeneratorWrapper<U> map(F f, GeneratorWrapper<T> g) {
    return from_step<U>([=, g = std::move(g), start = true](U& out) mutable {
        if (!std::exchange(start, false) && !g.next()) return false;
        out = f(g.get());
        return true;
    });
}
template <class F, class T>
[[nodiscard]] auto map(F f, GeneratorWrapper<T> g) { return map<detail::Bare<std::invoke_result_t<F, T>>>(std::move(f), std::move(g)); }
template <class T>
[[nodiscard]] GeneratorWrapper<T> repeat(std::size_t times, GeneratorWrapper<T> g) {
    std::vector<T> once;
    do once.push_back(g.get());
    while (g.next());
    std::vector<T> all;
    for (std::size_t i = 0; i < times; ++i) all.insert(all.end(), once.begin(), once.end());
    return values(std::move(all));
}
template <class T>
[[nodiscard]] GeneratorWrapper<std::vector<T>> chunk(std::size_t size, GeneratorWrapper<T> g) {
    return from_step<std::vector<T>>([=, g = std::move(g), start = true](std::vector<T>& out) mutable {
        out.clear();
        while (out.size() < size && (std::exchange(start, false) || g.next())) out.push_back(g.get());
        return out.size() == size;
    });
}

template <class T>
struct ItemOf { using type = std::decay_t<T>; };
template <class T>
struct ItemOf<GeneratorWrapper<T>> { using type = T; };
template <class T>
struct ItemOf<as<T>> { using type = T; };

template <class T, class U>
void add_part(std::vector<GeneratorWrapper<T>>& parts, GeneratorWrapper<U> g) {
    if constexpr (std::is_same_v<T, U>)
        parts.push_back(std::move(g));
    else
        parts.push_back(map<T>([](U const& v) { return static_cast<T>(v); }, std::move(g)));
}
template <class T, class U>
void add_part(std::vector<GeneratorWrapper<T>>&, as<U>) {}
template <class T, class U>
    requires std::is_constructible_v<T, U>
void add_part(std::vector<GeneratorWrapper<T>>& parts, U&& v) { parts.push_back(value(static_cast<T>(std::forward<U>(v)))); }

template <class First, class... Others>
[[nodiscard]] auto make_generators(First&& first, Others&&... others) {
    using T = typename ItemOf<detail::Bare<First>>::type;
    std::vector<GeneratorWrapper<T>> parts;
    add_part<T>(parts, std::forward<First>(first));
    (add_part<T>(parts, std::forward<Others>(others)), ...);
    return GeneratorWrapper<T>(new ChainGenerator<T>(std::move(parts)));
}

}  // namespace generators

namespace detail {
template <class Make>
[[nodiscard]] auto generate(char const* file, std::uint32_t line, std::uint32_t id, Make make) {
    using T = Bare<decltype(make().get())>;
    GeneratorSlot& slot = generator_slot(file, line, id);
    if (!slot.generator) slot.generator = make().release();
    return T(static_cast<generators::IGenerator<T>*>(slot.generator)->get());
}
}  // namespace detail

// ---- 11 test registry and sections ----------------------------------------------------------------
namespace detail {

struct TestCase {
    char const* name;
    char const* tags;
    char const* types;  // of a TEMPLATE_TEST_CASE: the list as written
    std::uint32_t type_index;
    char const* file;
    std::uint32_t line;
    void (*run)();
    TestCase* next;
};

/// The tests of this program, in the order of registration. A test harness is the one place for a registry.
struct Registry {
    TestCase* first = nullptr;
    TestCase* last = nullptr;

    void add(TestCase& test) noexcept {
        (last ? last->next : first) = &test;
        last = &test;
    }
};
[[nodiscard]] inline Registry& registry() noexcept {
    static constinit Registry all;
    return all;
}

struct TestName {
    char const* name;
    char const* tags;
    constexpr TestName(char const* n = "", char const* t = "") noexcept : name(n), tags(t) {}
};

struct Registrar {
    TestCase test;
    Registrar(char const* file, std::uint32_t line, void (*run)(), TestName name) noexcept
        : test{name.name, name.tags, nullptr, 0, file, line, run, nullptr} {
        registry().add(test);
    }
    Registrar(Registrar const&) = delete;
    Registrar& operator=(Registrar const&) = delete;
};

template <std::size_t N>
struct TypedRegistrar {
    TestCase tests[N];
    TypedRegistrar(char const* file, std::uint32_t line, char const* types, TestName name, void (*const (&run)[N])()) noexcept {
        for (std::size_t i = 0; i < N; ++i) {
            tests[i] = {name.name, name.tags, types, static_cast<std::uint32_t>(i), file, line, run[i], nullptr};
            registry().add(tests[i]);
        }
    }
    TypedRegistrar(TypedRegistrar const&) = delete;
    TypedRegistrar& operator=(TypedRegistrar const&) = delete;
};

template <class Fixture>
void run_method() {
    Fixture fixture;
    fixture.gnomon_test();
}

template <class List>
inline constexpr std::size_t list_size = 0;
template <template <class...> class List, class... Ts>
inline constexpr std::size_t list_size<List<Ts...>> = sizeof...(Ts);

bool section_begin(char const* file, std::uint32_t line, Text const& name);
void section_end() noexcept;

/// One SECTION on this run of the test case: true where the run enters it.
class Section {
public:
    template <class S>
    Section(char const* file, std::uint32_t line, S const& name) {
        Text text;
        append_string(text, name);
        entered_ = section_begin(file, line, text);
    }
    ~Section() {
        if (entered_) section_end();
    }
    Section(Section const&) = delete;
    Section& operator=(Section const&) = delete;
    [[nodiscard]] explicit operator bool() const noexcept { return entered_; }

private:
    bool entered_;
};

}  // namespace detail
}  // namespace gnomon::check

// Catch2's names for the same things.
namespace Catch {
using gnomon::check::Approx;
using gnomon::check::CaseSensitive;
using gnomon::check::MatcherBase;
namespace Detail {
using gnomon::check::Approx;
}
namespace Matchers {
using gnomon::check::Contains;
using gnomon::check::EndsWith;
using gnomon::check::Equals;
using gnomon::check::Message;
using gnomon::check::Predicate;
using gnomon::check::StartsWith;
using gnomon::check::UnorderedEquals;
using gnomon::check::VectorContains;
using gnomon::check::WithinAbs;
using gnomon::check::WithinRel;
using gnomon::check::WithinULP;
}  // namespace Matchers
using namespace Matchers;
namespace Generators = gnomon::check::generators;
inline namespace literals {
[[nodiscard]] inline Approx operator""_a(long double value) { return Approx(static_cast<double>(value)); }
[[nodiscard]] inline Approx operator""_a(unsigned long long value) { return Approx(value); }
}  // namespace literals
}  // namespace Catch
using Catch::Approx;

// ---- 12 macros ------------------------------------------------------------------------------------
#define GNOMON_CHECK_JOIN_(a, b) a##b
#define GNOMON_CHECK_JOIN(a, b) GNOMON_CHECK_JOIN_(a, b)
#define GNOMON_CHECK_UNIQUE(name) GNOMON_CHECK_JOIN(name, __COUNTER__)
#define GNOMON_CHECK_SITE(macro, flags, text) \
    ::gnomon::check::detail::Site(__FILE__, __LINE__, ::gnomon::check::detail::flags, macro, text)

#if GNOMON_CHECK_EXCEPTIONS
#define GNOMON_CHECK_TRY try
#define GNOMON_CHECK_CATCH(site) \
    catch (...) { ::gnomon::check::detail::report_exception(site); }
#else
#define GNOMON_CHECK_TRY
#define GNOMON_CHECK_CATCH(site)
#endif

// The site has a name of its own in each assertion: assertions nest, in lambdas.
#define GNOMON_CHECK_TEST_AT(site, macro, flags, ...)                                                             \
    do {                                                                                                          \
        static constexpr auto site = GNOMON_CHECK_SITE(macro, flags, #__VA_ARGS__);                               \
        GNOMON_CHECK_TRY {                                                                                        \
            ::gnomon::check::detail::judge(site, ::gnomon::check::detail::Decomposer{} <=> __VA_ARGS__);          \
        }                                                                                                         \
        GNOMON_CHECK_CATCH(site)                                                                                  \
    } while (false)
#define GNOMON_CHECK_TEST(macro, flags, ...) \
    GNOMON_CHECK_TEST_AT(GNOMON_CHECK_UNIQUE(gnomon_site_), macro, flags, __VA_ARGS__)

#define REQUIRE(...) GNOMON_CHECK_TEST("REQUIRE", stop_on_failure, __VA_ARGS__)
#define REQUIRE_FALSE(...) GNOMON_CHECK_TEST("REQUIRE_FALSE", expect_false, __VA_ARGS__)
#define CHECK(...) GNOMON_CHECK_TEST("CHECK", go_on, __VA_ARGS__)
#define CHECK_FALSE(...) GNOMON_CHECK_TEST("CHECK_FALSE", go_on_expect_false, __VA_ARGS__)
#define CHECK_NOFAIL(...) GNOMON_CHECK_TEST("CHECK_NOFAIL", go_on_never_fail, __VA_ARGS__)
#define CHECKED_IF(...)                                             \
    GNOMON_CHECK_TEST("CHECKED_IF", go_on_never_fail, __VA_ARGS__);     \
    if (::gnomon::check::detail::last_assertion_passed())
#define CHECKED_ELSE(...)                                           \
    GNOMON_CHECK_TEST("CHECKED_ELSE", go_on_never_fail, __VA_ARGS__);   \
    if (!::gnomon::check::detail::last_assertion_passed())

#define GNOMON_CHECK_THAT(macro, flags, value, ...)                                                        \
    do {                                                                                                   \
        GNOMON_CHECK_TRY {                                                                                 \
            ::gnomon::check::detail::judge_match(GNOMON_CHECK_SITE(macro, flags, #value ", " #__VA_ARGS__), \
                                                 value, __VA_ARGS__);                                      \
        }                                                                                                  \
        GNOMON_CHECK_CATCH(GNOMON_CHECK_SITE(macro, flags, #value ", " #__VA_ARGS__))                      \
    } while (false)
#define REQUIRE_THAT(value, ...) GNOMON_CHECK_THAT("REQUIRE_THAT", stop_on_failure, value, __VA_ARGS__)
#define CHECK_THAT(value, ...) GNOMON_CHECK_THAT("CHECK_THAT", go_on, value, __VA_ARGS__)

#if GNOMON_CHECK_EXCEPTIONS
#define GNOMON_CHECK_NOTHROW(macro, flags, ...)                                                             \
    do {                                                                                                    \
        try {                                                                                               \
            static_cast<void>(__VA_ARGS__);                                                                 \
            ::gnomon::check::detail::report_text(GNOMON_CHECK_SITE(macro, flags, #__VA_ARGS__),             \
                                                 ::gnomon::check::detail::Kind::success, {});               \
        }                                                                                                   \
        GNOMON_CHECK_CATCH(GNOMON_CHECK_SITE(macro, flags, #__VA_ARGS__))                                   \
    } while (false)
// `handler` is one or more catch clauses that judge the exception.
#define GNOMON_CHECK_THROWS(site, handler, ...)                                                             \
    do {                                                                                                    \
        try {                                                                                               \
            static_cast<void>(__VA_ARGS__);                                                                 \
            ::gnomon::check::detail::report_text(site, ::gnomon::check::detail::Kind::no_exception, {});    \
        }                                                                                                   \
        handler                                                                                             \
    } while (false)
#define GNOMON_CHECK_ANY(site)                                                                              \
    catch (...) {                                                                                           \
        static_cast<void>(::gnomon::check::detail::exception_text());                                       \
        ::gnomon::check::detail::report_text(site, ::gnomon::check::detail::Kind::success, {});             \
    }
#define GNOMON_CHECK_AS(site, type)                                                                         \
    catch (type const&) {                                                                                   \
        ::gnomon::check::detail::report_text(site, ::gnomon::check::detail::Kind::success, {});             \
    }                                                                                                       \
    GNOMON_CHECK_CATCH(site)
#define GNOMON_CHECK_WITH(site, ...)                                                                        \
    catch (...) {                                                                                           \
        ::gnomon::check::detail::judge_match(site, ::gnomon::check::detail::exception_text(), __VA_ARGS__); \
    }
#define GNOMON_CHECK_MATCHES(site, type, ...)                                                               \
    catch (type const& gnomon_exception) {                                                                  \
        ::gnomon::check::detail::judge_match(site, gnomon_exception, __VA_ARGS__);                          \
    }                                                                                                       \
    GNOMON_CHECK_CATCH(site)

#define REQUIRE_NOTHROW(...) GNOMON_CHECK_NOTHROW("REQUIRE_NOTHROW", stop_on_failure, __VA_ARGS__)
#define CHECK_NOTHROW(...) GNOMON_CHECK_NOTHROW("CHECK_NOTHROW", go_on, __VA_ARGS__)
#define GNOMON_CHECK_THROWS_ANY(site, ...) GNOMON_CHECK_THROWS(site, GNOMON_CHECK_ANY(site), __VA_ARGS__)
#define REQUIRE_THROWS(...) \
    GNOMON_CHECK_THROWS_ANY(GNOMON_CHECK_SITE("REQUIRE_THROWS", stop_on_failure, #__VA_ARGS__), __VA_ARGS__)
#define CHECK_THROWS(...) GNOMON_CHECK_THROWS_ANY(GNOMON_CHECK_SITE("CHECK_THROWS", go_on, #__VA_ARGS__), __VA_ARGS__)
#define GNOMON_CHECK_THROWS_AS(site, expression, type) GNOMON_CHECK_THROWS(site, GNOMON_CHECK_AS(site, type), expression)
#define REQUIRE_THROWS_AS(expression, type) \
    GNOMON_CHECK_THROWS_AS(GNOMON_CHECK_SITE("REQUIRE_THROWS_AS", stop_on_failure, #expression ", " #type), expression, type)
#define CHECK_THROWS_AS(expression, type) \
    GNOMON_CHECK_THROWS_AS(GNOMON_CHECK_SITE("CHECK_THROWS_AS", go_on, #expression ", " #type), expression, type)
#define GNOMON_CHECK_THROWS_WITH(site, expression, ...) \
    GNOMON_CHECK_THROWS(site, GNOMON_CHECK_WITH(site, __VA_ARGS__), expression)
#define REQUIRE_THROWS_WITH(expression, ...)                                                                         \
    GNOMON_CHECK_THROWS_WITH(GNOMON_CHECK_SITE("REQUIRE_THROWS_WITH", stop_on_failure, #expression ", " #__VA_ARGS__), \
                             expression, __VA_ARGS__)
#define CHECK_THROWS_WITH(expression, ...)                                                                \
    GNOMON_CHECK_THROWS_WITH(GNOMON_CHECK_SITE("CHECK_THROWS_WITH", go_on, #expression ", " #__VA_ARGS__), \
                             expression, __VA_ARGS__)
#define GNOMON_CHECK_THROWS_MATCHES(site, expression, type, ...) \
    GNOMON_CHECK_THROWS(site, GNOMON_CHECK_MATCHES(site, type, __VA_ARGS__), expression)
#define REQUIRE_THROWS_MATCHES(expression, type, ...)                                                          \
    GNOMON_CHECK_THROWS_MATCHES(                                                                               \
        GNOMON_CHECK_SITE("REQUIRE_THROWS_MATCHES", stop_on_failure, #expression ", " #type ", " #__VA_ARGS__), \
        expression, type, __VA_ARGS__)
#define CHECK_THROWS_MATCHES(expression, type, ...)                                                  \
    GNOMON_CHECK_THROWS_MATCHES(                                                                     \
        GNOMON_CHECK_SITE("CHECK_THROWS_MATCHES", go_on, #expression ", " #type ", " #__VA_ARGS__),  \
        expression, type, __VA_ARGS__)
#endif  // exceptions

#define STATIC_REQUIRE(...)                            \
    static_assert(__VA_ARGS__, #__VA_ARGS__);          \
    SUCCEED(#__VA_ARGS__)
#define STATIC_REQUIRE_FALSE(...)                      \
    static_assert(!(__VA_ARGS__), "!(" #__VA_ARGS__ ")"); \
    SUCCEED("!(" #__VA_ARGS__ ")")
#define STATIC_CHECK(...) STATIC_REQUIRE(__VA_ARGS__)
#define STATIC_CHECK_FALSE(...) STATIC_REQUIRE_FALSE(__VA_ARGS__)

#define GNOMON_CHECK_STREAM(...) ((::gnomon::check::detail::Stream() << __VA_ARGS__).text())
#define GNOMON_CHECK_QUIET_STREAM(...) \
    (::gnomon::check::detail::hot().silent ? ::gnomon::check::Text() : GNOMON_CHECK_STREAM(__VA_ARGS__))
#define INFO(...)                                                                      \
    ::gnomon::check::detail::ScopedMessage const GNOMON_CHECK_UNIQUE(gnomon_message_)( \
        GNOMON_CHECK_SITE("INFO", go_on, ""), GNOMON_CHECK_QUIET_STREAM(__VA_ARGS__))
#define UNSCOPED_INFO(...)                                                                     \
    ::gnomon::check::detail::unscoped_message(GNOMON_CHECK_SITE("UNSCOPED_INFO", go_on, ""), \
                                              GNOMON_CHECK_QUIET_STREAM(__VA_ARGS__))
#define CAPTURE(...)                                                                   \
    ::gnomon::check::detail::ScopedMessage const GNOMON_CHECK_UNIQUE(gnomon_message_)( \
        GNOMON_CHECK_SITE("CAPTURE", go_on, ""),                                       \
        ::gnomon::check::detail::hot().silent ? ::gnomon::check::Text()                \
                                              : ::gnomon::check::detail::capture_text(#__VA_ARGS__, __VA_ARGS__))

// `"" __VA_ARGS__` would break FAIL(std::string(...)): the empty string is streamed first instead.
#define GNOMON_CHECK_MESSAGE(macro, flags, kind, ...)                                   \
    ::gnomon::check::detail::report_text(GNOMON_CHECK_SITE(macro, flags, ""),           \
                                         ::gnomon::check::detail::Kind::kind,           \
                                         GNOMON_CHECK_STREAM("" __VA_OPT__(<<) __VA_ARGS__))
#define FAIL(...) GNOMON_CHECK_MESSAGE("FAIL", stop_on_failure, failure, __VA_ARGS__)
#define FAIL_CHECK(...) GNOMON_CHECK_MESSAGE("FAIL_CHECK", go_on, failure, __VA_ARGS__)
#define SUCCEED(...) GNOMON_CHECK_MESSAGE("SUCCEED", go_on, success, __VA_ARGS__)
#define WARN(...) GNOMON_CHECK_MESSAGE("WARN", go_on, warning, __VA_ARGS__)
#define SKIP(...) GNOMON_CHECK_MESSAGE("SKIP", stop_on_failure, skip, __VA_ARGS__)

#define GNOMON_CHECK_SECTION(variable, ...) \
    if (::gnomon::check::detail::Section const variable(__FILE__, __LINE__, __VA_ARGS__); variable)
#define SECTION(...) GNOMON_CHECK_SECTION(GNOMON_CHECK_UNIQUE(gnomon_section_), __VA_ARGS__)
#define DYNAMIC_SECTION(...) SECTION(GNOMON_CHECK_STREAM(__VA_ARGS__))

#define GNOMON_CHECK_GENERATE(capture, ...)                                                              \
    ::gnomon::check::detail::generate(__FILE__, __LINE__, __COUNTER__, capture {                         \
        using namespace ::gnomon::check::generators;                                                     \
        return make_generators(__VA_ARGS__);                                                             \
    })
#define GENERATE(...) GNOMON_CHECK_GENERATE([], __VA_ARGS__)
#define GENERATE_COPY(...) GNOMON_CHECK_GENERATE([=], __VA_ARGS__)
#define GENERATE_REF(...) GNOMON_CHECK_GENERATE([&], __VA_ARGS__)

#define GNOMON_CHECK_TEST_CASE(function, ...)                                                       \
    static void function();                                                                         \
    namespace {                                                                                     \
    ::gnomon::check::detail::Registrar GNOMON_CHECK_JOIN(function, _r)(__FILE__, __LINE__, &function, {__VA_ARGS__}); \
    }                                                                                               \
    static void function()
#define TEST_CASE(...) GNOMON_CHECK_TEST_CASE(GNOMON_CHECK_UNIQUE(gnomon_test_), __VA_ARGS__)

#define GNOMON_CHECK_TEST_CASE_METHOD(fixture, base, ...)                                           \
    namespace {                                                                                     \
    struct fixture : base {                                                                         \
        void gnomon_test();                                                                         \
    };                                                                                              \
    ::gnomon::check::detail::Registrar GNOMON_CHECK_JOIN(fixture, _r)(                              \
        __FILE__, __LINE__, &::gnomon::check::detail::run_method<fixture>, {__VA_ARGS__});          \
    }                                                                                               \
    void fixture::gnomon_test()
#define TEST_CASE_METHOD(base, ...) GNOMON_CHECK_TEST_CASE_METHOD(GNOMON_CHECK_UNIQUE(gnomon_fixture_), base, __VA_ARGS__)

#define GNOMON_CHECK_TEMPLATE_TEST_CASE(function, types, list, name, tags)                          \
    template <class TestType>                                                                       \
    static void function();                                                                         \
    namespace {                                                                                     \
    template <class>                                                                                \
    struct GNOMON_CHECK_JOIN(function, _all);                                                       \
    template <template <class...> class List, class... Ts>                                          \
    struct GNOMON_CHECK_JOIN(function, _all)<List<Ts...>> {                                         \
        static constexpr void (*run[sizeof...(Ts)])() = {&function<Ts>...};                         \
    };                                                                                              \
    ::gnomon::check::detail::TypedRegistrar<::gnomon::check::detail::list_size<list>> GNOMON_CHECK_JOIN(function, _r)( \
        __FILE__, __LINE__, types, {name, tags}, GNOMON_CHECK_JOIN(function, _all)<list>::run);      \
    }                                                                                               \
    template <class TestType>                                                                       \
    static void function()
#define GNOMON_CHECK_LIST(...) ::std::tuple<__VA_ARGS__>
#define GNOMON_CHECK_PACK(...) __VA_ARGS__
#define TEMPLATE_TEST_CASE(name, tags, ...)                                                         \
    GNOMON_CHECK_TEMPLATE_TEST_CASE(GNOMON_CHECK_UNIQUE(gnomon_test_), #__VA_ARGS__,                \
                                    GNOMON_CHECK_PACK(::std::tuple<__VA_ARGS__>), name, tags)
#define TEMPLATE_LIST_TEST_CASE(name, tags, ...)                                                    \
    GNOMON_CHECK_TEMPLATE_TEST_CASE(GNOMON_CHECK_UNIQUE(gnomon_test_), "", GNOMON_CHECK_PACK(__VA_ARGS__), name, tags)

#define SCENARIO(...) TEST_CASE("Scenario: " __VA_ARGS__)
#define GIVEN(text) DYNAMIC_SECTION("    Given: " << text)
#define AND_GIVEN(text) DYNAMIC_SECTION("And given: " << text)
#define WHEN(text) DYNAMIC_SECTION("     When: " << text)
#define AND_WHEN(text) DYNAMIC_SECTION("And when: " << text)
#define THEN(text) DYNAMIC_SECTION("     Then: " << text)
#define AND_THEN(text) DYNAMIC_SECTION("      And: " << text)

#endif  // own harness

#if defined(GNOMON_CHECK_MAIN) && !defined(GNOMON_CHECK_COMPILED)
#define GNOMON_CHECK_COMPILED
// ---- 13 compiled part: text, choices, shrinking ---------------------------------------------------
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

// None of this is hot: what counts is how long it takes to compile. At -O2 that is a third.
#if defined(__clang__)
#pragma clang optimize off
#elif defined(__GNUC__)
#pragma GCC push_options
#pragma GCC optimize("O0")
#endif

namespace gnomon::check {

Text::Text(char const* text) { append(text); }
Text::Text(char const* text, std::size_t size) { append(text, size); }
Text::Text(Text const& other) { append(other.data(), other.size()); }
Text::Text(Text&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      capacity_(std::exchange(other.capacity_, 0)) {}
Text& Text::operator=(Text other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
    return *this;
}
Text::~Text() { delete[] data_; }

Text& Text::append(char const* text, std::size_t size) {
    if (size_ + size + 1 > capacity_) {
        std::size_t const capacity = 2 * capacity_ + size + 16;
        char* const grown = new char[capacity];
        std::memcpy(grown, data(), size_);
        if (size != 0) std::memcpy(grown + size_, text, size);
        delete[] data_;
        data_ = grown;
        capacity_ = capacity;
    } else if (size != 0) {
        std::memcpy(data_ + size_, text, size);
    }
    size_ += size;
    data_[size_] = '\0';
    return *this;
}
Text& Text::append(char const* text) { return append(text, std::strlen(text)); }
Text& Text::append(char c) { return append(&c, 1); }
Text& Text::append(Text const& text) { return append(text.data(), text.size()); }
Text Text::part(std::size_t first, std::size_t count) const {
    if (first >= size_) return {};
    return Text(data() + first, count < size_ - first ? count : size_ - first);
}
std::size_t Text::find(char const* wanted, std::size_t from) const noexcept {
    char const* const at = from <= size_ ? std::strstr(data() + from, wanted) : nullptr;
    return at ? static_cast<std::size_t>(at - data()) : npos;
}
int Text::order(Text const& other) const noexcept {
    std::size_t const shared = size_ < other.size_ ? size_ : other.size_;
    int const order = shared == 0 ? 0 : std::memcmp(data_, other.data_, shared);
    return order != 0 ? order : size_ < other.size_ ? -1 : size_ > other.size_ ? 1 : 0;
}

namespace detail {

template <class... Args>
void put_format(Text& out, char const* format, Args... args) {
    char buffer[64];
    int const size = std::snprintf(buffer, sizeof buffer, format, args...);
    out.append(buffer, static_cast<std::size_t>(size));
}

void put_signed(Text& out, long long value) { put_format(out, "%lld", value); }
void put_unsigned(Text& out, unsigned long long value) {
    char buffer[24];
    char* at = buffer + sizeof buffer;
    do *--at = static_cast<char>('0' + value % 10);
    while ((value /= 10) != 0);
    out.append(at, static_cast<std::size_t>(buffer + sizeof buffer - at));
}

// The fewest digits that read back as the same number, always with a mark of being a float.
template <class T, class Parse>
void put_shortest(Text& out, T value, int most_digits, Parse parse) {
    if (value != value) {
        out.append("nan");
        return;
    }
    char buffer[64];
    for (int digits = 1; digits <= most_digits; ++digits) {
        std::snprintf(buffer, sizeof buffer, "%.*Lg", digits, static_cast<long double>(value));
        if (parse(buffer) == value) break;
    }
    if (std::strstr(buffer, "e+") && value < T(1e15) && value > T(-1e15))  // 1e+01 is not what one wants to read
        std::snprintf(buffer, sizeof buffer, "%.0Lf", static_cast<long double>(value));
    out.append(buffer);
    if (!std::strpbrk(buffer, ".en")) out.append(".0");
}
void put_float(Text& out, float value) {
    put_shortest(out, value, 9, [](char const* s) { return std::strtof(s, nullptr); });
    if (value - value == 0) out.append('f');
}
void put_double(Text& out, double value) {
    put_shortest(out, value, 17, [](char const* s) { return std::strtod(s, nullptr); });
}
void put_long_double(Text& out, long double value) {
    put_shortest(out, value, 36, [](char const* s) { return std::strtold(s, nullptr); });
}

void put_escaped(Text& out, char c, char quote) {
    auto const code = static_cast<unsigned char>(c);
    char const* const from = "\n\t\r\0";
    char const* const to = "ntr0";
    for (int i = 0; i < 4; ++i) {
        if (c == from[i]) {
            out.append('\\').append(to[i]);
            return;
        }
    }
    if (code < 32 || code == 127) {
        put_format(out, "\\x%02x", static_cast<unsigned>(code));
        return;
    }
    if (c == quote || c == '\\') out.append('\\');
    out.append(c);
}
void put_char(Text& out, char value) {
    out.append('\'');
    put_escaped(out, value, '\'');
    out.append('\'');
}
void put_quoted(Text& out, char const* text, std::size_t size) {
    out.append('"');
    for (std::size_t i = 0; i < size; ++i) put_escaped(out, text[i], '"');
    out.append('"');
}
void put_c_string(Text& out, char const* text) {
    if (text) put_quoted(out, text, std::strlen(text));
    else out.append("nullptr");
}
void put_pointer(Text& out, void const* pointer) {
    if (pointer) put_format(out, "%p", pointer);
    else out.append("nullptr");
}

/// A small std::vector: this part of the file must compile fast too.
template <class T>
class List {
public:
    List() noexcept = default;
    List(List const& other) { append(other); }
    List(List&& other) noexcept { swap(other); }
    List& operator=(List other) noexcept {
        swap(other);
        return *this;
    }
    ~List() { delete[] data_; }

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
    [[nodiscard]] T& operator[](std::size_t index) noexcept { return data_[index]; }
    [[nodiscard]] T const& operator[](std::size_t index) const noexcept { return data_[index]; }
    [[nodiscard]] T* begin() noexcept { return data_; }
    [[nodiscard]] T* end() noexcept { return data_ + size_; }
    [[nodiscard]] T const* begin() const noexcept { return data_; }
    [[nodiscard]] T const* end() const noexcept { return data_ + size_; }

    void push_back(T value) {
        if (size_ == capacity_) grow();
        data_[size_++] = std::move(value);
    }
    void append(List const& other) {
        for (T const& value : other) push_back(value);
    }
    void pop_back() noexcept { data_[--size_] = T(); }
    void clear() noexcept { erase(0, size_); }
    void erase(std::size_t first, std::size_t last) noexcept {
        for (std::size_t i = last; i < size_; ++i) data_[first + i - last] = std::move(data_[i]);
        for (std::size_t n = last - first; n > 0; --n) pop_back();
    }
    void swap(List& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        std::swap(capacity_, other.capacity_);
    }

private:
    void grow() {
        std::size_t const capacity = 2 * capacity_ + 4;
        T* const grown = new T[capacity]();
        for (std::size_t i = 0; i < size_; ++i) grown[i] = std::move(data_[i]);
        delete[] data_;
        data_ = grown;
        capacity_ = capacity;
    }

    T* data_ = nullptr;
    std::size_t size_ = 0;
    std::size_t capacity_ = 0;
};

template <class T>
[[nodiscard]] bool contains(List<T> const& list, T const& wanted) {
    for (T const& value : list)
        if (value == wanted) return true;
    return false;
}

struct Rejected {};

struct Tape {
    struct Mark {
        std::size_t begin, end;
    };
    bool replaying = false;
    List<std::uint64_t> input;  // what to replay
    List<std::uint64_t> used;   // what the case really drew
    List<Mark> spans;
    List<std::size_t> open;

    void restart(List<std::uint64_t> choices) {
        replaying = true;
        input = std::move(choices);
        used.clear();
        spans.clear();
        open.clear();
    }
};

void tape_reject() {
#if GNOMON_CHECK_EXCEPTIONS
    throw Rejected{};
#endif
}

// A case of more choices than this is given up: 32 MiB, a runaway generator.
inline constexpr std::size_t longest_tape = std::size_t{1} << 22;

std::uint64_t tape_next(Tape& tape, std::uint64_t max, std::uint64_t suggestion) {
    std::size_t const at = tape.used.size();
    std::uint64_t value = suggestion;
    if (tape.replaying) value = at < tape.input.size() ? tape.input[at] : 0;
    value = value < max ? value : max;
    if (at >= longest_tape) tape_reject();
    tape.used.push_back(value);
    return value;
}

void tape_span(Tape& tape, bool begin) {
    if (begin) {
        tape.open.push_back(tape.spans.size());
        tape.spans.push_back({tape.used.size(), tape.used.size()});
    } else {
        tape.spans[tape.open[tape.open.size() - 1]].end = tape.used.size();
        tape.open.pop_back();
    }
}

[[nodiscard]] double seconds_now() {
    std::timespec now{};
    static_cast<void>(std::timespec_get(&now, TIME_UTC));
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

enum class Verdict : unsigned char { pass, fail, reject };

// The parts of a property run that differ between the harness and Catch2.
struct PropertyHost;

/// Shrinks a failing tape: candidates are smaller in (length, then lexicographic) order, so it terminates;
/// a limit on evaluations and on time bounds it.
class Shrinker {
public:
    Shrinker(Property const& property, Tape tape) : property_(property), best_(std::move(tape)) {}

    void run() {
        deadline_ = seconds_now() + 5.0;
        bool improved = true;
        while (improved && !exhausted()) {
            std::size_t const before = accepted_;
            drop_spans();
            drop_blocks();
            clear_blocks();
            lower_each();
            shift_between();
            improved = accepted_ != before;
        }
    }
    [[nodiscard]] Tape const& best() const noexcept { return best_; }
    [[nodiscard]] std::size_t accepted() const noexcept { return accepted_; }

    [[nodiscard]] static Verdict evaluate(Property const& property, Tape& tape);

private:
    using Values = List<std::uint64_t>;

    [[nodiscard]] bool exhausted() const { return tried_ >= 20000 || seconds_now() > deadline_; }
    [[nodiscard]] static bool smaller(Values const& a, Values const& b) {
        if (a.size() != b.size()) return a.size() < b.size();
        for (std::size_t i = 0; i < a.size(); ++i)
            if (a[i] != b[i]) return a[i] < b[i];
        return false;
    }
    // True if the candidate still fails; it is the best one then.
    bool attempt(Values candidate) {
        if (exhausted()) return false;
        ++tried_;
        Tape tape;
        tape.restart(std::move(candidate));
        if (evaluate(property_, tape) != Verdict::fail || !smaller(tape.used, best_.used)) return false;
        best_ = std::move(tape);
        ++accepted_;
        return true;
    }
    [[nodiscard]] Values without(std::size_t begin, std::size_t end) const {
        Values values = best_.used;
        values.erase(begin, end);
        return values;
    }
    void drop_spans() {
        for (std::size_t i = best_.spans.size(); i-- > 0;) {
            if (i >= best_.spans.size()) continue;
            auto const [begin, end] = best_.spans[i];
            if (begin != end) attempt(without(begin, end));
        }
    }
    void drop_blocks() {
        for (std::size_t size = 8; size >= 1; size /= 2)
            for (std::size_t i = best_.used.size(); i-- > 0 && !exhausted();)
                if (i + size <= best_.used.size()) attempt(without(i, i + size));
    }
    void clear_blocks() {
        for (std::size_t size = 8; size >= 2; size /= 2) {
            for (std::size_t i = 0; i + size <= best_.used.size() && !exhausted(); i += size) {
                Values values = best_.used;
                for (std::size_t k = 0; k < size; ++k) values[i + k] = 0;
                if (smaller(values, best_.used)) attempt(std::move(values));
            }
        }
    }
    bool attempt_at(std::size_t i, std::uint64_t value) {
        Values values = best_.used;
        if (i >= values.size() || value >= values[i]) return false;
        values[i] = value;
        return attempt(std::move(values));
    }
    void lower_each() {
        for (std::size_t i = 0; i < best_.used.size() && !exhausted(); ++i) lower(i);
    }
    void lower(std::size_t i) {
        if (best_.used[i] == 0 || attempt_at(i, 0)) return;
        std::uint64_t passes = 0;
        while (i < best_.used.size() && best_.used[i] - passes > 1) {
            std::uint64_t const middle = passes + (best_.used[i] - passes) / 2;
            if (!attempt_at(i, middle)) passes = middle;
            if (i < best_.used.size() && best_.used[i] <= passes) return;
        }
        if (i < best_.used.size() && best_.used[i] <= 8) change_kind(i);
        // Not every failure is monotone: the zigzag of integers makes pairs (+n, -n).
        if (i < best_.used.size() && best_.used[i] > 2) attempt_at(i, best_.used[i] - 2);
    }
    // A small choice may be a kind of value: try each simpler kind with amounts of all sizes behind it.
    void change_kind(std::size_t i) {
        for (std::uint64_t kind = 0; i + 1 < best_.used.size() && kind < best_.used[i]; ++kind) {
            for (unsigned power = 0; power < 54; power += power < 6 ? 1 : 4) {
                for (std::uint64_t odd = 0; odd < 2; ++odd) {
                    Values values = best_.used;
                    values[i] = kind;
                    values[i + 1] = (std::uint64_t{1} << power) - odd;
                    if (attempt(std::move(values))) return;
                }
            }
        }
    }
    // Moves an amount from one choice to a later one: for sums.
    void shift_between() {
        for (std::size_t i = 0; i < best_.used.size(); ++i)
            for (std::size_t j = i + 1; j < best_.used.size() && j <= i + 8 && !exhausted(); ++j) shift(i, j);
    }
    void shift(std::size_t i, std::size_t j) {
        for (std::uint64_t amount = best_.used[i]; amount != 0; amount /= 2) {
            Values values = best_.used;
            if (j >= values.size() || values[i] < amount || values[j] > ~amount) return;
            values[i] -= amount;
            values[j] += amount;
            if (attempt(std::move(values)) && i >= best_.used.size()) return;
        }
    }

    Property const& property_;
    Tape best_;
    std::size_t tried_ = 0;
    std::size_t accepted_ = 0;
    double deadline_ = 0;
};

// What differs between the own harness and Catch2, defined by section 14 for either.
struct PropertyOptions {
    std::uint64_t seed = 0;       // as the command line gives it
    std::uint64_t key = 0;        // mixed from the seed and the test's name
    std::uint64_t scale = 1000;   // cases, in thousandths of what the code says
    bool one_case = false;
    std::uint64_t case_index = 0;
};
[[nodiscard]] PropertyOptions property_options();
[[nodiscard]] Text replay_command(PropertyOptions const& options, std::uint64_t index);
void report_counterexample(Property const& property, Tape& tape, Text const& summary);
void report_property(bool passed, Text const& text);
#if GNOMON_CHECK_EXCEPTIONS
// Called in a catch block: passes on what no case may swallow (SKIP).
void rethrow_control();
#endif

/// While it lives, assertions only set hot().case_failed.
class Silence {
public:
    Silence();
    ~Silence();
    Silence(Silence const&) = delete;
    Silence& operator=(Silence const&) = delete;
    [[nodiscard]] bool nested() const noexcept { return before_.silent; }

private:
    Hot before_;
#if defined(GNOMON_CHECK_USE_CATCH2)
    Catch::IResultCapture* capture_ = nullptr;
#endif
};

// Runs f, which returns false or sets hot().case_failed to fail, or throws.
template <class F>
[[nodiscard]] Verdict judge_case(F const& f) {
    hot().case_failed = false;
#if GNOMON_CHECK_EXCEPTIONS
    try {
        bool const kept = f();
        return kept && !hot().case_failed ? Verdict::pass : Verdict::fail;
    } catch (Rejected const&) {
        return Verdict::reject;
    } catch (...) {
        rethrow_control();
        return Verdict::fail;
    }
#else
    return f() && !hot().case_failed ? Verdict::pass : Verdict::fail;
#endif
}

Verdict Shrinker::evaluate(Property const& property, Tape& tape) {
    Choices choices(0, 0, &tape);
    Verdict const verdict = judge_case([&] { return property.run(property.self, choices); });
    return choices.rejected() ? Verdict::reject : verdict;
}

[[nodiscard]] std::uint64_t number_from_environment(char const* name, bool& found) {
    char const* const text = std::getenv(name);
    if (!text || *text == '\0') return 0;
    found = true;
    return std::strtoull(text, nullptr, 10);
}

[[nodiscard]] std::uint64_t hash_text(std::uint64_t hash, char const* text) {
    for (; *text; ++text) hash = mix64(hash + static_cast<unsigned char>(*text) + 0x9e3779b97f4a7c15u);
    return hash;
}

struct SearchResult {
    Verdict verdict = Verdict::pass;
    std::uint64_t at = 0;         // the failing case
    std::uint64_t rejected = 0;   // cases given up
};

[[nodiscard]] SearchResult search_cases(Property const& property, PropertyOptions const& options, std::uint64_t count) {
    SearchResult result;
    std::uint64_t last = options.one_case ? options.case_index + 1 : count;
    result.at = options.one_case ? options.case_index : 0;
    while (result.at < last) {
        Choices choices(options.key, result.at);
        Verdict const verdict = judge_case([&] {
            return property.search(property.self, choices, result.at, last) == last;
        });
        if (verdict == Verdict::pass) break;
        if (verdict == Verdict::fail && !choices.rejected()) {
            result.verdict = Verdict::fail;
            break;
        }
        ++result.at;
        if (options.one_case) continue;
        ++last;  // another case takes the place of the unsuitable one, within reason
        if (++result.rejected > 10 * count + 100) {
            result.verdict = Verdict::reject;
            break;
        }
    }
    return result;
}

[[nodiscard]] Tape record_case(Property const& property, std::uint64_t key, std::uint64_t index) {
    Tape tape;
    Choices choices(key, index, &tape);
    static_cast<void>(judge_case([&] { return property.run(property.self, choices); }));
    return tape;
}

[[nodiscard]] Text describe_counterexample(Property const& property, Tape const& best, PropertyOptions const& options,
                                           std::uint64_t index, std::size_t shrinks) {
    Text out("for_all: case ");
    put_unsigned(out, index);
    out.append(" fails; smallest counterexample (");
    put_unsigned(out, shrinks);
    out.append(" shrinks), seed ");
    put_unsigned(out, options.seed);
    out.append(":\n");
    Tape tape;
    tape.restart(best.used);
    Choices choices(0, 0, &tape);
    property.show(property.self, choices, out);
    out.append("  replay: ").append(replay_command(options, index));
    return out;
}

void run_property(Property const& property) {
    PropertyOptions const options = property_options();
    std::uint64_t const scaled = property.cases / 1000 * options.scale + property.cases % 1000 * options.scale / 1000;
    std::uint64_t const count = scaled == 0 && property.cases != 0 ? 1 : scaled;
    SearchResult result;
    Tape best;
    Text summary;
    bool nested = false;
    {
        Silence const silence;
        nested = silence.nested();
        result = search_cases(property, options, count);
        if (result.verdict == Verdict::fail && !nested) {
            Shrinker shrinker(property, record_case(property, options.key, result.at));
            shrinker.run();
            best = shrinker.best();
            summary = describe_counterexample(property, best, options, result.at, shrinker.accepted());
        }
    }
    if (nested) {
        hot().case_failed = hot().case_failed || result.verdict != Verdict::pass;
    } else if (result.verdict == Verdict::fail) {
        best.restart(best.used);
        report_counterexample(property, best, summary);
    } else if (result.verdict == Verdict::reject) {
        put_unsigned(summary, result.at - result.rejected);
        summary.append(" suitable cases, then gave up: ");
        put_unsigned(summary, result.rejected);
        summary.append(" were rejected by filter or assume");
        report_property(false, summary);
    } else {
        put_unsigned(summary, options.one_case ? 1 : count);
        report_property(true, summary.append(" cases"));
    }
}

}  // namespace detail
}  // namespace gnomon::check

// ---- 14 compiled part: runner, reporters, command line, main() ------------------------------------
#if !defined(GNOMON_CHECK_USE_CATCH2)
namespace gnomon::check {

bool Approx::equals(double other) const noexcept {
    auto const near = [&](double margin) { return value_ + margin >= other && other + margin >= value_; };
    bool const finite = value_ - value_ == 0;
    double const size = !finite ? 0.0 : value_ < 0 ? -value_ : value_;
    return near(margin_) || near(epsilon_ * (scale_ + size));
}

namespace matchers {

bool same_text(char const* a, char const* b, std::size_t size, bool ignore_case) noexcept {
    auto const lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    for (std::size_t i = 0; i < size; ++i)
        if (ignore_case ? lower(a[i]) != lower(b[i]) : a[i] != b[i]) return false;
    return true;
}

bool StringMatcher::find(Text const& text) const noexcept {
    if (text.size() < pattern.size() || (place == Place::equal && text.size() != pattern.size())) return false;
    std::size_t const last = text.size() - pattern.size();
    std::size_t const from = place == Place::end ? last : 0;
    std::size_t const to = place == Place::start || place == Place::equal ? 0 : last;
    for (std::size_t i = from; i <= to; ++i)
        if (same_text(text.data() + i, pattern.data(), pattern.size(), ignore_case)) return true;
    return false;
}

Text StringMatcher::describe() const {
    static constexpr char const* names[] = {"equals: ", "contains: ", "starts with: ", "ends with: "};
    Text out(names[static_cast<int>(place)]);
    detail::put_quoted(out, pattern.data(), pattern.size());
    return out.append(ignore_case ? " (case insensitive)" : "");
}

bool MessageMatcher::match(std::exception const& e) const { return std::strcmp(e.what(), text.data()) == 0; }

}  // namespace matchers

namespace detail {

using String = Text;
[[nodiscard]] String operator+(String left, String const& right) { return std::move(left.append(right)); }
[[nodiscard]] String operator+(String left, char const* right) { return std::move(left.append(right)); }
[[nodiscard]] String operator+(char const* left, String const& right) { return String(left) + right; }
void operator+=(String& left, String const& right) { left.append(right); }
void operator+=(String& left, char const* right) { left.append(right); }
[[nodiscard]] String number(std::uint64_t value) {
    String out;
    put_unsigned(out, value);
    return out;
}
[[nodiscard]] String repeat(char c, int times) {
    String out;
    while (times-- > 0) out.append(c);
    return out;
}

// What ends a test case early.
struct TestFailed {};
struct TestSkipped {};

[[noreturn]] inline void leave_test(bool skipped) {
#if GNOMON_CHECK_EXCEPTIONS
    if (skipped) throw TestSkipped{};
    throw TestFailed{};
#else
    std::fflush(nullptr);
    std::_Exit(skipped ? 4 : 1);  // without exceptions there is no way back to the runner
#endif
}

void put_comparison(Text& out, Text const& left, char const* sign, Text const& right) {
    bool const wide = left.size() + right.size() > 60 || std::strchr(left.data(), '\n') || std::strchr(right.data(), '\n');
    char const* const gap = wide ? "\n" : " ";
    out.append(left).append(gap).append(sign).append(gap).append(right);
}

// Calls f(begin, end) for each part of a list at its top-level commas.
template <class F>
void split_list(char const* list, F const& f) {
    int depth = 0;
    char quote = 0;
    char const* begin = list;
    for (char const* at = list;; ++at) {
        if (*at == '\0' || (*at == ',' && depth == 0 && !quote)) {
            char const* end = at;
            while (begin < end && *begin == ' ') ++begin;
            while (begin < end && end[-1] == ' ') --end;
            f(begin, end);
            if (*at == '\0') return;
            begin = at + 1;
        } else if (quote) {
            if (*at == '\\' && at[1]) ++at;
            else if (*at == quote) quote = 0;
        } else if (*at == '"' || *at == '\'') {
            quote = *at;
        } else if (std::strchr("([{<", *at)) {
            ++depth;
        } else if (std::strchr(")]}>", *at) && depth > 0) {
            --depth;
        }
    }
}

[[nodiscard]] String nth_of_list(char const* list, std::size_t index) {
    String found;
    std::size_t number = 0;
    split_list(list, [&](char const* begin, char const* end) {
        if (number++ == index) found = String(begin, static_cast<std::size_t>(end - begin));
    });
    return found;
}

void put_capture_name(Text& out, char const* names, std::size_t index) {
    out.append(nth_of_list(names, index).c_str()).append(" := ");
}

// -- command line --

struct Config {
    List<String> specs;
    List<String> sections;
    String program, name, reporter = "console", out, order = "decl";
    std::uint64_t seed = 0;
    std::uint64_t abort_after = 0;
    std::uint64_t property_scale = 1000, property_case = 0;
    bool one_property_case = false;
    bool show_success = false, durations = false, warn_no_tests = false, warn_no_assertions = false, no_throw = false;
    bool list_tests = false, list_names = false, list_tags = false, list_reporters = false, help = false;
    bool colour = false;
    double min_duration = -1;
};

/// One way to write an option, and what it does with its value (if it takes one).
struct Option {
    char const* short_name;
    char const* long_name;
    char const* value;  // null: a flag
    char const* help;
    bool (*apply)(Config& config, char const* value);
};

[[nodiscard]] bool parse_number(char const* text, std::uint64_t& out) {
    if (*text < '0' || *text > '9') return false;
    char* end = nullptr;
    out = std::strtoull(text, &end, 10);
    return *end == '\0';
}
[[nodiscard]] bool parse_yes(char const* text, bool& out) {
    String const word = text;
    out = word == "yes" || word == "y" || word == "true" || word == "1" || word == "on";
    return out || word == "no" || word == "n" || word == "false" || word == "0" || word == "off";
}
[[nodiscard]] bool one_word(String const& word, std::initializer_list<char const*> words) {
    for (char const* w : words)
        if (word == w) return true;
    return false;
}
[[nodiscard]] bool parse_seed(Config& c, char const* v) {
    if (String(v) == "time") {
        c.seed = static_cast<std::uint64_t>(std::time(nullptr));
        return true;
    }
    return parse_number(v, c.seed);
}
[[nodiscard]] bool parse_warning(Config& c, char const* v) {
    String const word = v;
    if (word == "NoTests") c.warn_no_tests = true;
    else if (word == "NoAssertions") c.warn_no_assertions = true;
    else return false;
    return true;
}
[[nodiscard]] bool parse_order(Config& c, char const* v) {
    c.order = v;
    return one_word(c.order, {"decl", "lex", "rand", "declared", "lexical", "random"});
}
[[nodiscard]] bool parse_reporter(Config& c, char const* v) {
    c.reporter = v;
    return one_word(c.reporter, {"console", "compact", "junit"});
}

inline constexpr Option option_table[] = {
    {"-?", "--help", nullptr, "this text", [](Config& c, char const*) { return c.help = true; }},
    {"-h", nullptr, nullptr, nullptr, [](Config& c, char const*) { return c.help = true; }},
    {"-l", "--list-tests", nullptr, "list the matching test cases", [](Config& c, char const*) { return c.list_tests = true; }},
    {nullptr, "--list-test-names-only", nullptr, "list them one a line", [](Config& c, char const*) { return c.list_names = true; }},
    {"-t", "--list-tags", nullptr, "list the tags of the matching test cases", [](Config& c, char const*) { return c.list_tags = true; }},
    {nullptr, "--list-reporters", nullptr, "list the reporters", [](Config& c, char const*) { return c.list_reporters = true; }},
    {"-s", "--success", nullptr, "report passing assertions too", [](Config& c, char const*) { return c.show_success = true; }},
    {"-a", "--abort", nullptr, "stop at the first failure", [](Config& c, char const*) { c.abort_after = 1; return true; }},
    {"-x", "--abortx", "N", "stop after N failures", [](Config& c, char const* v) { return parse_number(v, c.abort_after) && c.abort_after != 0; }},
    {"-r", "--reporter", "NAME", "console (default), compact or junit", parse_reporter},
    {"-o", "--out", "FILE", "write the report to FILE", [](Config& c, char const* v) { c.out = v; return *v != '\0'; }},
    {"-n", "--name", "NAME", "name of the run in the report", [](Config& c, char const* v) { c.name = v; return true; }},
    {"-c", "--section", "NAME", "run only this section; again for the one inside it", [](Config& c, char const* v) { c.sections.push_back(v); return true; }},
    {nullptr, "--order", "WORD", "decl (default), lex or rand", parse_order},
    {nullptr, "--rng-seed", "N", "seed of random values and orders, or 'time' (default 0)", parse_seed},
    {"-d", "--durations", "yes|no", "show how long each test case took", [](Config& c, char const* v) { return parse_yes(v, c.durations); }},
    {"-D", "--min-duration", "SECONDS", "show it for those at least so long", [](Config& c, char const* v) { char* end = nullptr; c.min_duration = std::strtod(v, &end); return end != v && *end == '\0'; }},
    {"-w", "--warn", "NoTests|NoAssertions", "no test that matches, or one without assertions, is an error", parse_warning},
    {"-e", "--nothrow", nullptr, "leave out test cases tagged [!throws]", [](Config& c, char const*) { return c.no_throw = true; }},
    {nullptr, "--use-colour", "yes|no|auto", "colours on the console", [](Config& c, char const* v) { return String(v) == "auto" || parse_yes(v, c.colour); }},
    {nullptr, "--property-cases", "N", "for_all tries N cases by default; cases(n) is scaled by N / 1000", [](Config& c, char const* v) { return parse_number(v, c.property_scale); }},
    {nullptr, "--property-case", "K", "for_all runs case K only", [](Config& c, char const* v) { c.one_property_case = true; return parse_number(v, c.property_case); }},
};

void print_help(Config const& config) {
    std::printf("usage: %s [test name, pattern or tags ...] [options]\n\n"
                "  \"name\"  name*  *name*  ~excluded  [tag]  [a][b] (both)  [a],[b] (either)\n"
                "  Test cases tagged [.] run only when a pattern names them.\n\n",
                config.program.c_str());
    for (Option const& option : option_table) {
        if (!option.help) continue;
        String left = option.short_name ? String(option.short_name) + ", " : String("    ");
        left += option.long_name;
        if (option.value) left += String(" ") + option.value;
        std::printf("  %-34s %s\n", left.c_str(), option.help);
    }
    std::printf("\nenvironment: GNOMON_PROPERTY_CASES and GNOMON_PROPERTY_CASE, as the options of that name\n"
                "exit code: the number of failures, at most 255; 2 for a wrong command line; 4 if all were skipped\n");
}

/// Reads the command line. Returns the complaint, empty if there is none.
[[nodiscard]] String parse_command_line(Config& config, int argc, char const* const* argv) {
    config.program = argc > 0 && argv[0] ? argv[0] : "tests";
    for (int i = 1; i < argc; ++i) {
        String const argument = argv[i];
        if (argument.size() < 2 || argument[0] != '-') {
            config.specs.push_back(argument);
            continue;
        }
        std::size_t const equals = argument[1] == '-' ? argument.find("=") : String::npos;
        String const flag = argument.part(0, equals);
        Option const* found = nullptr;
        for (Option const& option : option_table)
            if ((option.short_name && flag == option.short_name) || (option.long_name && flag == option.long_name)) found = &option;
        if (!found) return "unknown option '" + flag + "'; --help lists them";
        char const* value = equals == String::npos ? nullptr : argv[i] + equals + 1;
        if (found->value && !value) {
            if (++i == argc) return "option '" + flag + "' needs a value: " + found->value;
            value = argv[i];
        }
        if (!found->value && value) return "option '" + flag + "' takes no value, but has '" + value + "'";
        if (!found->apply(config, value)) return "option '" + flag + "' cannot be '" + value + "'; it takes " + found->value;
    }
    return {};
}

// -- tests and filters --

struct Test {
    TestCase const* source = nullptr;
    String name;
    List<String> tags;  // without brackets, lower case
    bool hidden = false, should_fail = false, may_fail = false, throws = false;
    std::uint64_t order = 0;
};

[[nodiscard]] String lower(String const& text) {
    String out;
    for (char c : text) out.append(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
    return out;
}
[[nodiscard]] String trim(String const& text) {
    auto const blank = [](char c) { return c == ' ' || c == '\t' || c == '\n'; };
    std::size_t first = 0, last = text.size();
    while (first < last && blank(text[first])) ++first;
    while (first < last && blank(text[last - 1])) --last;
    return text.part(first, last - first);
}

void add_tag(Test& test, String tag) {
    if (tag.size() > 1 && tag[0] == '.') {
        test.hidden = true;
        add_tag(test, tag.part(1));
        tag = ".";
    }
    tag = lower(tag);
    if (tag == "." || tag == "!hide") test.hidden = true, tag = ".";
    if (tag == "!shouldfail") test.should_fail = true;
    if (tag == "!mayfail") test.may_fail = true;
    if (tag == "!throws") test.throws = true;
    if (!contains(test.tags, tag)) test.tags.push_back(tag);
}

[[nodiscard]] Test make_test(TestCase const& source, std::size_t number_of_anonymous) {
    Test test;
    test.source = &source;
    test.name = source.name;
    if (test.name.empty()) test.name = "Anonymous test case " + number(number_of_anonymous);
    if (source.types) {
        String const type = nth_of_list(source.types, source.type_index);
        test.name += " - " + (type.empty() ? number(source.type_index) : type);
    }
    String const tags = source.tags;
    for (std::size_t at = tags.find("["); at != String::npos; at = tags.find("[", at + 1)) {
        std::size_t const end = tags.find("]", at);
        if (end == String::npos) break;
        add_tag(test, tags.part(at + 1, end - at - 1));
    }
    return test;
}

struct Pattern {
    String text;
    bool is_tag = false, exclude = false;
    bool any_start = false, any_end = false;

    [[nodiscard]] bool matches(Test const& test) const {
        if (is_tag) return contains(test.tags, text);
        String const name = lower(test.name);
        if (any_start && any_end) return name.find(text.c_str()) != String::npos;
        if (any_start) return name.size() >= text.size() && name.part(name.size() - text.size()) == text;
        if (any_end) return name.part(0, text.size()) == text;
        return name == text;
    }
};
using Filter = List<Pattern>;  // all must agree

/// Reads test specifications: patterns side by side must all match, a comma separates alternatives.
class SpecParser {
public:
    void parse(String const& spec) {
        for (at_ = 0; at_ < spec.size();) {
            char const c = spec[at_];
            if (c == ' ') ++at_;
            else if (c == ',') ++at_, finish();
            else if (c == '~') ++at_, exclude_ = true;
            else if (spec.find("exclude:", at_) == at_) at_ += 8, exclude_ = true;
            else if (c == '[') tag(spec);
            else name(spec);
        }
    }
    [[nodiscard]] List<Filter> take() {
        finish();
        return std::move(filters_);
    }

private:
    void finish() {
        if (!current_.empty()) filters_.push_back(std::move(current_));
        current_.clear();
        exclude_ = false;
    }
    void add(Pattern pattern) {
        pattern.exclude = exclude_;
        exclude_ = false;
        current_.push_back(std::move(pattern));
    }
    void tag(String const& spec) {
        std::size_t const found = spec.find("]", at_);
        std::size_t const end = found < spec.size() ? found : spec.size();
        String text = lower(spec.part(at_ + 1, end - at_ - 1));
        if (text == "!hide") text = ".";
        if (text.size() > 1 && text[0] == '.') {  // [.tag] is [.][tag]
            bool const exclude = exclude_;
            add({".", true, false, false, false});
            exclude_ = exclude;
            text = text.part(1);
        }
        add({text, true, false, false, false});
        at_ = end + 1;
    }
    void name(String const& spec) {
        bool const quoted = spec[at_] == '"';
        if (quoted) ++at_;
        String text;
        for (; at_ < spec.size() && (quoted ? spec[at_] != '"' : spec[at_] != ',' && spec[at_] != '['); ++at_) {
            if (spec[at_] == '\\' && at_ + 1 < spec.size()) ++at_;
            text.append(spec[at_]);
        }
        if (quoted) ++at_;
        Pattern pattern;
        pattern.text = lower(trim(text));
        String& body = pattern.text;
        if (!body.empty() && body[0] == '*') pattern.any_start = true, body = body.part(1);
        if (!body.empty() && body[body.size() - 1] == '*') pattern.any_end = true, body = body.part(0, body.size() - 1);
        if (body.empty()) pattern.any_end = true;
        add(pattern);
    }

    std::size_t at_ = 0;
    bool exclude_ = false;
    Filter current_;
    List<Filter> filters_;
};

[[nodiscard]] bool selected(Filter const& filter, Test const& test) {
    bool use = !test.hidden;
    for (Pattern const& pattern : filter) {
        if (pattern.exclude) continue;
        if (!pattern.matches(test)) return false;
        use = true;
    }
    for (Pattern const& pattern : filter)
        if (pattern.exclude && pattern.matches(test)) return false;
    return use;
}

[[nodiscard]] List<Test> select_tests(Config const& config) {
    SpecParser parser;
    for (String const& spec : config.specs) parser.parse(spec);
    List<Filter> filters = parser.take();
    if (filters.empty()) filters.push_back({});
    List<Test> tests;
    std::size_t anonymous = 0;
    for (TestCase const* source = registry().first; source; source = source->next) {
        if (*source->name == '\0') ++anonymous;
        Test test = make_test(*source, anonymous);
        bool wanted = false;
        for (Filter const& filter : filters) wanted = wanted || selected(filter, test);
        if (wanted && !(config.no_throw && test.throws)) tests.push_back(std::move(test));
    }
    return tests;
}

template <class T, class Before>
void sort_list(List<T>& list, Before const& before) {
    for (std::size_t i = 1; i < list.size(); ++i)
        for (std::size_t k = i; k > 0 && before(list[k], list[k - 1]); --k) std::swap(list[k], list[k - 1]);
}

// A test keeps its place among the others whatever the filter.
void sort_tests(List<Test>& tests, Config const& config) {
    if (config.order[0] == 'd') return;
    bool const random = config.order[0] == 'r';
    for (Test& test : tests) test.order = random ? hash_text(mix64(config.seed + 1), test.name.c_str()) : 0;
    sort_list(tests, [](Test const& a, Test const& b) {
        return a.order != b.order ? a.order < b.order : a.name.order(b.name) < 0;
    });
}

// -- sections and generators: which path this run of the test case takes --

/// A node of the tree of sections and generators that the runs of a test case discover.
struct Tracker {
    enum class State : unsigned char { fresh, running, running_children, needs_run, passed, failed };
    String name;
    String file;
    std::uint32_t line = 0;
    bool is_generator = false;
    State state = State::fresh;
    Tracker* parent = nullptr;
    List<Tracker*> children;
    GeneratorSlot slot;

    Tracker() = default;
    Tracker(Tracker const&) = delete;
    Tracker& operator=(Tracker const&) = delete;
    ~Tracker() {
        clear();
        delete slot.generator;
    }
    void clear() {
        for (Tracker* child : children) delete child;
        children.clear();
    }
    [[nodiscard]] bool complete() const { return state == State::passed || state == State::failed; }
    [[nodiscard]] Tracker* find(String const& wanted, char const* in_file, std::uint32_t at_line, bool generator) const {
        for (Tracker* child : children)
            if (child->is_generator == generator && child->line == at_line && child->name == wanted && child->file == in_file) return child;
        return nullptr;
    }
    void open_parents() {
        for (Tracker* at = parent; at && at->state != State::running_children; at = at->parent) at->state = State::running_children;
    }
};

/// Walks the tree: each run of the test case enters one new path to a leaf.
class Paths {
public:
    explicit Paths(List<String> const& section_filters) : filters_(section_filters) {}

    void begin_run() {
        path_done_ = false;
        root_.state = Tracker::State::running;
        current_ = &root_;
    }
    // True if another run is needed.
    [[nodiscard]] bool end_run() {
        close(root_);
        return !root_.complete();
    }

    [[nodiscard]] bool enter_section(String const& name, char const* file, std::uint32_t line) {
        Tracker* const section = child(name, file, line, false);
        if (path_done_ || section->complete() || !wanted(*section)) return false;
        open(*section);
        return true;
    }
    void leave_section(bool by_exception) {
        Tracker* section = current_;
        while (section->is_generator) section = section->parent;
        if (by_exception && !unwinding_) {
            section->state = Tracker::State::failed;
            section->parent->state = Tracker::State::needs_run;
            unwinding_ = true;
            leave(*section);
        } else {
            close(*section);
        }
    }
    void clear_unwinding() noexcept { unwinding_ = false; }

    [[nodiscard]] GeneratorSlot& generator(String const& name, char const* file, std::uint32_t line) {
        // In a loop the generator that is wanted may be the one that is open.
        if (current_->is_generator && current_->name == name && current_->line == line) return current_->slot;
        Tracker* const tracker = child(name, file, line, true);
        if (!tracker->complete()) open(*tracker);
        return tracker->slot;
    }

private:
    using State = Tracker::State;

    [[nodiscard]] Tracker* child(String const& name, char const* file, std::uint32_t line, bool generator) {
        if (Tracker* const known = current_->find(name, file, line, generator)) return known;
        Tracker* const fresh = new Tracker;
        fresh->name = name;
        fresh->file = file;
        fresh->line = line;
        fresh->is_generator = generator;
        fresh->parent = current_;
        current_->children.push_back(fresh);
        return fresh;
    }
    [[nodiscard]] bool wanted(Tracker const& section) const {
        std::size_t depth = 0;
        for (Tracker const* at = section.parent; at != &root_; at = at->parent) depth += at->is_generator ? 0u : 1u;
        return depth >= filters_.size() || trim(section.name) == trim(filters_[depth]);
    }
    void open(Tracker& tracker) {
        tracker.state = State::running;
        current_ = &tracker;
        tracker.open_parents();
    }
    void leave(Tracker& tracker) {
        current_ = tracker.parent ? tracker.parent : &root_;
        path_done_ = true;
    }
    void close(Tracker& tracker) {
        while (current_ != &tracker) close(*current_);
        if (tracker.state == State::running) tracker.state = State::passed;
        if (tracker.state == State::running_children) {
            bool done = true;
            for (Tracker const* c : tracker.children) done = done && (c->complete() || (!c->is_generator && !wanted(*c)));
            if (done) tracker.state = State::passed;
        }
        leave(tracker);
        if (tracker.is_generator) advance(tracker);
    }
    // A generator moves on when all below it is done; it waits for a section that has not begun.
    void advance(Tracker& tracker) {
        bool waits = !tracker.children.empty();
        bool can_begin = false;
        for (Tracker const* c : tracker.children) {
            if (c->state != State::fresh) waits = false;
            can_begin = can_begin || c->is_generator || wanted(*c);
        }
        if ((waits && can_begin) || (tracker.state == State::passed && tracker.slot.generator && tracker.slot.generator->next())) {
            tracker.clear();
            tracker.state = State::running;
        }
    }

    List<String> const& filters_;
    Tracker root_;
    Tracker* current_ = &root_;
    bool path_done_ = false;
    bool unwinding_ = false;
};

// -- results and reporters --

struct Assertion {
    Site site;
    Kind kind;
    bool passed;
    String expansion;                // of an expression; or the text of a message or an exception
    List<String> messages;
    List<String> sections;    // where, below the test case
};

struct Counts {
    std::uint64_t passed = 0, failed = 0, expected = 0, skipped = 0;
    [[nodiscard]] std::uint64_t total() const noexcept { return passed + failed + expected + skipped; }
};

struct TestResult {
    Counts assertions;
    bool skipped = false;
    double seconds = 0;
};

struct Totals {
    Counts tests, assertions;
};

struct Reporter {
    explicit Reporter(Config const& c, std::FILE* file) : config(c), out(file) {}
    Reporter(Reporter const&) = delete;
    Reporter& operator=(Reporter const&) = delete;
    virtual ~Reporter() = default;
    virtual void run_begins() {}
    virtual void test_begins(Test const&) {}
    virtual void assertion(Test const& test, Assertion const& a) = 0;
    virtual void test_ends(Test const&, TestResult const&) {}
    virtual void run_ends(Totals const& totals) = 0;

    void print(String const& text) const { std::fwrite(text.data(), 1, text.size(), out); }
    [[nodiscard]] String paint(char const* code, String const& text) const {
        return config.colour ? String("\x1b[") + code + "m" + text + "\x1b[0m" : text;
    }

    Config const& config;
    std::FILE* out;
};

[[nodiscard]] String indent(String const& text, char const* by) {
    String result = by;
    for (char c : text) {
        result.append(c);
        if (c == '\n') result += by;
    }
    return result;
}
[[nodiscard]] String place_of(Site const& site) { return String(site.file) + ":" + number(site.line); }
[[nodiscard]] String call_of(Site const& site) {
    return *site.text ? String(site.macro) + "( " + site.text + " )" : String(site.macro);
}
[[nodiscard]] String plural(std::uint64_t count, char const* noun) {
    return number(count) + " " + noun + (count == 1 ? "" : "s");
}
[[nodiscard]] char const* verdict_of(Assertion const& a) {
    if (a.kind == Kind::warning) return "warning";
    if (a.kind == Kind::skip) return "SKIPPED";
    if (a.passed) return "PASSED";
    return (a.site.flags & never_fail) != 0 ? "FAILED - but was ok" : "FAILED";
}
[[nodiscard]] char const* heading_of(Kind kind) {
    switch (kind) {
        case Kind::expression: return "with expansion:";
        case Kind::exception: return "due to unexpected exception with message:";
        case Kind::no_exception: return "because no exception was thrown where one was expected:";
        case Kind::failure:
        case Kind::success:
        case Kind::warning:
        case Kind::skip: return "explicitly with message:";
    }
    return "";
}

[[nodiscard]] String summary_row(Totals const& totals) {
    String text;
    auto const row = [&](char const* what, Counts const& c) {
        text += String(what) + number(c.total());
        if (c.passed) text += " | " + number(c.passed) + " passed";
        if (c.failed) text += " | " + number(c.failed) + " failed";
        if (c.expected) text += " | " + number(c.expected) + " failed as expected";
        if (c.skipped) text += " | " + number(c.skipped) + " skipped";
        text += "\n";
    };
    row("test cases: ", totals.tests);
    row("assertions: ", totals.assertions);
    return text;
}

class ConsoleReporter final : public Reporter {
public:
    using Reporter::Reporter;

    void test_begins(Test const&) override { shown_ = "\n"; }
    void assertion(Test const& test, Assertion const& a) override {
        heading(test, a.sections);
        String text = place_of(a.site) + ": " + paint(a.passed ? "32" : a.kind == Kind::skip ? "33" : "31", verdict_of(a)) + ":\n";
        if (a.kind != Kind::warning && a.kind != Kind::skip) text += "  " + call_of(a.site) + "\n";
        if (!a.expansion.empty()) text += String(heading_of(a.kind)) + "\n" + indent(a.expansion, "  ") + "\n";
        if (a.kind == Kind::no_exception) text += String(heading_of(a.kind)) + "\n";
        if (!a.messages.empty()) text += a.messages.size() == 1 ? "with message:\n" : "with messages:\n";
        for (String const& message : a.messages) text += indent(message, "  ") + "\n";
        print(text + "\n");
    }
    void test_ends(Test const& test, TestResult const& result) override {
        if (!config.durations && !(config.min_duration >= 0 && result.seconds >= config.min_duration)) return;
        char buffer[32];
        std::snprintf(buffer, sizeof buffer, "%.3f s: ", result.seconds);
        print(buffer + test.name + "\n");
    }
    void run_ends(Totals const& totals) override {
        String const line = repeat('=', 79);
        if (totals.tests.total() == 0) {
            print(line + "\nNo tests ran\n\n");
        } else if (totals.tests.failed == 0 && totals.tests.expected == 0 && totals.tests.skipped == 0) {
            print(line + "\n" + paint("32", "All tests passed") + " (" + plural(totals.assertions.passed, "assertion") + " in " +
                  plural(totals.tests.passed, "test case") + ")\n\n");
        } else {
            print(line + "\n" + summary_row(totals) + "\n");
        }
    }

private:
    void heading(Test const& test, List<String> const& sections) {
        String path = test.name + "\n";
        for (String const& section : sections) path += "  " + section + "\n";
        if (path == shown_) return;
        shown_ = path;
        String const line = repeat('-', 79);
        print(line + "\n" + path + line + "\n" + test.source->file + ":" + number(test.source->line) + "\n" +
              repeat('.', 79) + "\n\n");
    }
    String shown_;
};

class CompactReporter final : public Reporter {
public:
    using Reporter::Reporter;

    void assertion(Test const& test, Assertion const& a) override {
        String text = place_of(a.site) + ": " + paint(a.passed ? "32" : "31", lower(verdict_of(a))) + ": ";
        text += a.kind == Kind::warning || a.kind == Kind::skip ? String() : call_of(a.site);
        if (a.kind == Kind::no_exception) text += " threw nothing";
        if (!a.expansion.empty()) text += " for: " + a.expansion;
        for (String const& message : a.messages) text += " with '" + message + "'";
        text += " in '" + test.name;
        for (String const& section : a.sections) text += "/" + section;
        print(text + "'\n");
    }
    void run_ends(Totals const& totals) override {
        Counts const& tests = totals.tests;
        if (tests.failed != 0)
            print("Failed " + plural(tests.failed, "test case") + " of " + number(tests.total()) + ", failed " +
                  plural(totals.assertions.failed, "assertion") + ".\n");
        else
            print("Passed " + plural(tests.passed, "test case") + " with " + plural(totals.assertions.passed, "assertion") +
                  (tests.skipped ? ", skipped " + number(tests.skipped) : String()) + ".\n");
    }
};

/// Length of the UTF-8 sequence at `at` if it is a character that XML 1.0 allows, else 0.
[[nodiscard]] std::size_t xml_character(String const& text, std::size_t at) {
    auto const byte = [&](std::size_t i) -> std::uint32_t {
        return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u;
    };
    std::uint32_t const lead = byte(0);
    if (lead < 0x80) return lead >= 0x20 || lead == '\t' || lead == '\n' ? 1 : 0;
    std::size_t const length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4) return 0;
    std::uint32_t code = lead & (0x7fu >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0u) != 0x80u) return 0;
        code = code << 6 | (byte(i) & 0x3fu);
    }
    bool const overlong = code < (length == 2 ? 0x80u : length == 3 ? 0x800u : 0x10000u);
    bool const surrogate = code >= 0xd800 && code <= 0xdfff;
    return overlong || surrogate || code > 0x10ffff || code == 0xfffe || code == 0xffff ? 0 : length;
}

/// Text for XML content and attributes; what XML cannot hold becomes \xNN.
[[nodiscard]] String xml(String const& text) {
    String out;
    for (std::size_t at = 0; at < text.size();) {
        std::size_t const length = xml_character(text, at);
        if (length == 0) {
            char buffer[8];
            std::snprintf(buffer, sizeof buffer, "\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(text[at])));
            out += buffer;
            ++at;
            continue;
        }
        switch (text[at]) {
            case '&': out += "&amp;"; break;
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '"': out += "&quot;"; break;
            case '\'': out += "&apos;"; break;
            case '\n': out += "&#10;"; break;
            case '\t': out += "&#9;"; break;
            default: out.append(text.data() + at, length);
        }
        at += length;
    }
    return out;
}

/// One <testcase> per test case; it is written at the end, as the counts stand first.
class JunitReporter final : public Reporter {
public:
    using Reporter::Reporter;

    void assertion(Test const&, Assertion const& a) override {
        if (a.passed || a.kind == Kind::warning || (a.site.flags & never_fail) != 0) return;
        String text = String(verdict_of(a)) + ":\n  " + call_of(a.site) + "\n";
        if (!a.expansion.empty()) text += String(heading_of(a.kind)) + "\n" + indent(a.expansion, "  ") + "\n";
        for (String const& message : a.messages) text += message + "\n";
        for (String const& section : a.sections) text += "in section: " + section + "\n";
        text += "at " + place_of(a.site) + "\n";
        char const* const element = a.kind == Kind::skip ? "skipped" : a.kind == Kind::exception ? "error" : "failure";
        String const message = a.kind == Kind::expression || a.expansion.empty() ? String(*a.site.text ? a.site.text : a.site.macro) : a.expansion;
        (a.kind == Kind::exception ? errors_ : failures_) += a.kind == Kind::skip ? 0u : 1u;
        details_ += String("      <") + element + " message=\"" + xml(message) + "\"" +
                    (a.kind == Kind::skip ? String() : " type=\"" + xml(a.site.macro) + "\"") + ">" + xml(text) + "</" + element + ">\n";
    }
    void test_ends(Test const& test, TestResult const& result) override {
        cases_ += "    <testcase classname=\"" + xml(run_name()) + ".global\" name=\"" + xml(test.name) + "\" time=\"" +
                  seconds(result.seconds) + "\"" + (details_.empty() ? "/>\n" : ">\n" + details_ + "    </testcase>\n");
        details_ = {};
        time_ += result.seconds;
    }
    void run_ends(Totals const& totals) override {
        print("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\"" + xml(run_name()) +
              "\" errors=\"" + number(errors_) + "\" failures=\"" + number(failures_) + "\" skipped=\"" +
              number(totals.tests.skipped) + "\" tests=\"" + number(totals.tests.total()) + "\" time=\"" + seconds(time_) +
              "\">\n    <properties>\n      <property name=\"random-seed\" value=\"" + number(config.seed) +
              "\"/>\n    </properties>\n" + cases_ + "  </testsuite>\n</testsuites>\n");
    }

private:
    [[nodiscard]] String run_name() const {
        if (!config.name.empty()) return config.name;
        char const* const slash = std::strrchr(config.program.c_str(), '/');
        return slash ? String(slash + 1) : config.program;
    }
    [[nodiscard]] static String seconds(double value) {
        char buffer[32];
        std::snprintf(buffer, sizeof buffer, "%.3f", value);
        return buffer;
    }
    std::uint64_t errors_ = 0, failures_ = 0;
    double time_ = 0;
    String cases_, details_;
};

// -- the runner --

/// Everything that assertions talk to while the program runs.
class Runner {
public:
    Runner(Config const& config, Reporter& reporter) : config_(config), reporter_(reporter) {}

    void run_test(Test const& test);
    [[nodiscard]] bool aborting() const { return config_.abort_after != 0 && totals_.assertions.failed >= config_.abort_after; }
    [[nodiscard]] Totals const& totals() const noexcept { return totals_; }
    [[nodiscard]] Config const& config() const noexcept { return config_; }
    [[nodiscard]] Test const* test() const noexcept { return test_; }
    [[nodiscard]] Reporter& reporter() noexcept { return reporter_; }

    void record(Assertion assertion);
    void fatal(char const* what);
    [[nodiscard]] std::uint64_t next_property() noexcept { return ++properties_; }

    struct Message {
        String text;
        bool scoped;
    };
    List<Message> messages;
    List<String> sections;
    Paths* paths = nullptr;
    Site last_site{"", 0, go_on, "", ""};
    bool last_passed = true;
    bool one_failure_only = false;  // while for_all shows its smallest case
    bool one_failure_seen = false;
    std::uint64_t random_state = 0;

private:
    void run_once();
    void finish(TestResult& result);

    Config const& config_;
    Reporter& reporter_;
    Test const* test_ = nullptr;
    Totals totals_;
    Counts counts_;  // of the running test, passed ones are in hot()
    bool skipped_ = false;
    std::uint64_t properties_ = 0;
};

[[nodiscard]] inline Runner*& running() noexcept {
    static Runner* runner = nullptr;
    return runner;
}
[[nodiscard]] inline Runner& runner() {
    if (!running()) {
        std::fputs("gnomon check: an assertion ran outside of any test case\n", stderr);
        std::abort();
    }
    return *running();
}

void Runner::record(Assertion a) {
    last_site = a.site;
    last_passed = a.passed;
    bool const counts = a.kind != Kind::warning && a.kind != Kind::skip;
    bool const harmless = (a.site.flags & never_fail) != 0;
    if (counts && a.passed) ++hot().passed;
    if (counts && !a.passed && one_failure_only && std::exchange(one_failure_seen, true)) return;
    if (counts && !a.passed) {
        if (harmless || test_->may_fail || test_->should_fail) ++counts_.expected;
        else ++counts_.failed, ++totals_.assertions.failed;
    }
    if (a.kind == Kind::skip) skipped_ = true;
    if (!a.passed || !counts || config_.show_success) {
        a.sections = sections;
        for (Message const& message : messages) a.messages.push_back(message.text);
        reporter_.assertion(*test_, a);
    }
    for (std::size_t i = messages.size(); i-- > 0;)
        if (!messages[i].scoped) messages.erase(i, i + 1);
}

void Runner::run_once() {
    paths->begin_run();
    messages.clear();
    sections.clear();
    properties_ = 0;
    last_site = {test_->source->file, test_->source->line, go_on, "TEST_CASE", ""};
#if GNOMON_CHECK_EXCEPTIONS
    try {
        test_->source->run();
    } catch (TestFailed const&) {
    } catch (TestSkipped const&) {
    } catch (...) {
        Site const site{last_site.file, last_site.line, go_on, "{Unknown expression after the reported line}", ""};
        record({site, Kind::exception, false, exception_text(), {}, {}});
    }
#else
    test_->source->run();
#endif
    paths->clear_unwinding();
}

void Runner::run_test(Test const& test) {
    test_ = &test;
    counts_ = {};
    skipped_ = false;
    hot() = {};
    hot().skip_passing = !config_.show_success;
    random_state = hash_text(config_.seed, test.name.c_str());
    reporter_.test_begins(test);
    double const begin = seconds_now();
    Paths tree(config_.sections);
    paths = &tree;
    bool again = true;
    while (again && !aborting()) {
        run_once();
        again = tree.end_run();
    }
    paths = nullptr;
    TestResult result;
    result.seconds = seconds_now() - begin;
    finish(result);
}

void Runner::finish(TestResult& result) {
    counts_.passed = hot().passed;
    Site const site{test_->source->file, test_->source->line, go_on, "TEST_CASE", ""};
    messages.clear();
    sections.clear();
    if (test_->should_fail && counts_.expected == 0 && !skipped_) {
        ++counts_.failed;
        ++totals_.assertions.failed;
        reporter_.assertion(*test_, {site, Kind::failure, false, "the test case is tagged [!shouldfail], but nothing failed", {}, {}});
    }
    if (config_.warn_no_assertions && counts_.total() == 0 && !skipped_) {
        ++counts_.failed;
        ++totals_.assertions.failed;
        reporter_.assertion(*test_, {site, Kind::failure, false, "no assertions in the test case", {}, {}});
    }
    totals_.assertions.passed += counts_.passed;
    totals_.assertions.expected += counts_.expected;
    bool const expected = counts_.expected != 0 && (test_->should_fail || test_->may_fail);
    std::uint64_t Counts::* const kind = counts_.failed != 0 ? &Counts::failed : skipped_ ? &Counts::skipped
                                         : expected          ? &Counts::expected
                                                             : &Counts::passed;
    ++(totals_.tests.*kind);
    result.assertions = counts_;
    result.skipped = skipped_;
    reporter_.test_ends(*test_, result);
    test_ = nullptr;
}

// A signal: report what was running, close the report, and let the signal do its work.
void Runner::fatal(char const* what) {
    if (!test_) return;
    Site const site{last_site.file, last_site.line, go_on, "{Unknown expression after the reported line}", ""};
    hot().silent = false;
    record({site, Kind::failure, false, String("fatal error: ") + what, {}, {}});
    TestResult result;
    finish(result);
    reporter_.run_ends(totals_);
    std::fflush(reporter_.out);
}

// -- what the macros call --

// In for_all's search nothing is reported. Returns true if it was handled.
[[nodiscard]] bool handled_in_silence(Site const& site, bool passed) {
    if (!hot().silent) return false;
    if (passed) {
        ++hot().passed;
        return true;
    }
    if ((site.flags & never_fail) != 0) return true;
    hot().case_failed = true;
    if ((site.flags & go_on) == 0) leave_test(false);
    return true;
}

void settle(Site const& site, Kind kind, bool passed, String text) {
    runner().record({site, kind, passed, std::move(text), {}, {}});
    bool const stop = (site.flags & (go_on | never_fail)) == 0;
    if (kind == Kind::skip) leave_test(true);
    if (!passed && kind != Kind::warning && (stop || runner().aborting())) leave_test(false);
}

void report(Site const& site, bool value, Expand expand, void const* expression) {
    bool const passed = value != ((site.flags & expect_false) != 0);
    if (handled_in_silence(site, passed)) return;
    Text text;
    if (!passed || !hot().skip_passing) {
        if ((site.flags & expect_false) != 0) text.append("!(");
        expand(text, expression);
        if ((site.flags & expect_false) != 0) text.append(")");
    }
    settle(site, Kind::expression, passed, text);
}

void report_text(Site const& site, Kind kind, Text const& text) {
    bool const passed = kind == Kind::success || kind == Kind::warning;
    if (kind == Kind::skip) {
        hot().silent = false;
        settle(site, kind, true, text);
        return;
    }
    if (handled_in_silence(site, passed)) return;
    settle(site, kind, passed, text);
}

#if GNOMON_CHECK_EXCEPTIONS
Text exception_text() {
    try {
        throw;
    } catch (TestFailed const&) {
        throw;
    } catch (TestSkipped const&) {
        throw;
    } catch (Rejected const&) {
        throw;
    } catch (std::exception const& e) {
        return e.what();
    } catch (char const* text) {
        return text;
    } catch (...) {
        return "an exception that is no std::exception";
    }
}
void report_exception(Site const& site) {
    Text const text = exception_text();
    if (!handled_in_silence(site, false)) settle(site, Kind::exception, false, text);
}
#endif

void push_message(Site const&, Text const& text) { runner().messages.push_back({text, true}); }
void unscoped_message(Site const&, Text const& text) {
    if (!hot().silent) runner().messages.push_back({text, false});
}
// A message that an exception drops stays until the exception is reported.
void pop_message() {
    List<Runner::Message>& all = runner().messages;
    for (std::size_t i = all.size(); i-- > 0;) {
        if (!all[i].scoped) continue;
        if (std::uncaught_exceptions() > 0) all[i].scoped = false;
        else all.erase(i, i + 1);
        return;
    }
}

bool last_assertion_passed() { return hot().skip_passing && hot().silent ? !hot().case_failed : runner().last_passed; }

bool section_begin(char const* file, std::uint32_t line, Text const& name) {
    if (hot().silent || !runner().paths->enter_section(name, file, line)) return false;
    runner().sections.push_back(name);
    runner().last_site = {file, line, go_on, "SECTION", ""};
    return true;
}
void section_end() noexcept {
    runner().sections.pop_back();
    runner().paths->leave_section(std::uncaught_exceptions() > 0);
}

GeneratorSlot& generator_slot(char const* file, std::uint32_t line, std::uint32_t id) {
    return runner().paths->generator(number(id), file, line);
}
std::uint64_t test_random() {
    runner().random_state += 0x9e3779b97f4a7c15u;
    return mix64(runner().random_state);
}

// -- for_all's view of the harness --

PropertyOptions property_options() {
    Config const& config = runner().config();
    PropertyOptions o;
    o.seed = config.seed;
    o.scale = config.property_scale;
    o.one_case = config.one_property_case;
    o.case_index = config.property_case;
    // Several for_all in one test case see different values.
    o.key = hash_text(mix64(config.seed + 1), runner().test()->name.c_str()) + mix64(runner().next_property());
    return o;
}

[[nodiscard]] String shell_quoted(String const& text) {
    String out = "\"";
    for (char c : text) {
        if (std::strchr("\"\\$`", c)) out.append('\\');
        out.append(c);
    }
    return out + "\"";
}

Text replay_command(PropertyOptions const& options, std::uint64_t index) {
    String name;
    for (char c : runner().test()->name) {
        if (std::strchr(",[\\\"", c)) name.append('\\');
        name.append(c);
    }
    return runner().config().program + " " + shell_quoted(name) + " --rng-seed " + number(options.seed) +
           " --property-case " + number(index);
}

Silence::Silence() : before_(hot()) {
    hot().silent = true;
    hot().skip_passing = true;
}
Silence::~Silence() { hot() = before_; }

#if GNOMON_CHECK_EXCEPTIONS
void rethrow_control() {
    try {
        throw;
    } catch (TestSkipped const&) {
        throw;
    } catch (...) {
    }
}
#endif

void report_property(bool passed, Text const& text) {
    Site const site{runner().last_site.file, runner().last_site.line, go_on, "for_all", ""};
    settle(site, passed ? Kind::success : Kind::failure, passed, text);
}

// Runs the smallest case aloud. Only its first failure is reported, with the arguments as a message.
void report_counterexample(Property const& property, Tape& tape, Text const& summary) {
    Runner& r = runner();
    r.messages.push_back({summary, true});
    r.one_failure_only = true;
    r.one_failure_seen = false;
    bool stopped = false, said_no = false;
    Choices choices(0, 0, &tape);
#if GNOMON_CHECK_EXCEPTIONS
    try {
        said_no = !property.run(property.self, choices);
    } catch (TestFailed const&) {
        stopped = true;
    } catch (TestSkipped const&) {
        throw;
    } catch (...) {
        Site const site{r.last_site.file, r.last_site.line, go_on, "for_all", ""};
        if (!r.one_failure_seen) settle(site, Kind::exception, false, exception_text());
    }
#else
    said_no = !property.run(property.self, choices);
#endif
    if (!r.one_failure_seen) report_property(false, said_no ? "the function returned false" : "the case failed at first, and passed when it was run again");
    r.one_failure_only = false;
    pop_message();
    if (stopped) leave_test(false);
}

// -- listing and main --

void list_tests(List<Test> const& tests, Config const& config) {
    if (!config.list_names) std::printf(config.specs.empty() ? "All available test cases:\n" : "Matching test cases:\n");
    for (Test const& test : tests) {
        std::printf(config.list_names ? "%s\n" : "  %s\n", test.name.c_str());
        if (config.list_names || test.tags.empty()) continue;
        String tags;
        for (String const& tag : test.tags) tags += "[" + tag + "]";
        std::printf("      %s\n", tags.c_str());
    }
    if (!config.list_names) std::printf("%s\n\n", plural(tests.size(), "test case").c_str());
}

void list_tags(List<Test> const& tests) {
    List<String> all;
    for (Test const& test : tests) all.append(test.tags);
    sort_list(all, [](String const& a, String const& b) { return a.order(b) < 0; });
    std::printf("All available tags:\n");
    std::size_t kinds = 0;
    for (std::size_t i = 0; i < all.size(); ++kinds) {
        std::size_t same = i;
        while (same < all.size() && all[same] == all[i]) ++same;
        std::printf("  %2d  [%s]\n", static_cast<int>(same - i), all[i].c_str());
        i = same;
    }
    std::printf("%s\n\n", plural(kinds, "tag").c_str());
}

[[nodiscard]] bool listing(Config const& config, List<Test> const& tests) {
    if (config.help) print_help(config);
    else if (config.list_tests || config.list_names) list_tests(tests, config);
    else if (config.list_tags) list_tags(tests);
    else if (config.list_reporters) std::printf("console\ncompact\njunit\n");
    else return false;
    return true;
}

[[nodiscard]] int exit_code(Totals const& totals, Config const& config) {
    if (totals.tests.total() == 0) return config.warn_no_tests ? 2 : 0;
    if (totals.tests.skipped == totals.tests.total()) return 4;
    Totals const& t = totals;
    std::uint64_t const failures = t.assertions.failed > t.tests.failed ? t.assertions.failed : t.tests.failed;
    return failures < 255 ? static_cast<int>(failures) : 255;
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
extern "C" inline void gnomon_check_on_signal(int signal) {
    std::signal(signal, SIG_DFL);
    char const* const name = signal == SIGSEGV   ? "SIGSEGV: bad memory access"
                             : signal == SIGFPE  ? "SIGFPE: bad arithmetic"
                             : signal == SIGILL  ? "SIGILL: illegal instruction"
                             : signal == SIGABRT ? "SIGABRT: abort() was called"
                                                 : "SIGTERM: asked to stop";
    if (running()) running()->fatal(name);
    std::raise(signal);
}
inline void watch_signals() {
    for (int signal : {SIGSEGV, SIGFPE, SIGILL, SIGABRT, SIGTERM}) std::signal(signal, gnomon_check_on_signal);
}
#else
inline void watch_signals() {}
#endif

[[nodiscard]] int run_all(Config const& config, Reporter& reporter, List<Test> const& tests) {
    Runner all(config, reporter);
    running() = &all;
    watch_signals();
    reporter.run_begins();
    for (Test const& test : tests) {
        if (all.aborting()) break;
        all.run_test(test);
    }
    reporter.run_ends(all.totals());
    std::fflush(reporter.out);
    running() = nullptr;
    return exit_code(all.totals(), config);
}

[[nodiscard]] int complain(String const& text) {
    std::fprintf(stderr, "error: %s\n", text.c_str());
    return 2;
}

[[nodiscard]] int run_with_reporter(Config const& config, List<Test> const& tests) {
    std::FILE* const file = config.out.empty() ? stdout : std::fopen(config.out.c_str(), "wb");
    if (!file) return complain("cannot write '" + config.out + "': " + std::strerror(errno));
    ConsoleReporter console(config, file);
    CompactReporter compact(config, file);
    JunitReporter junit(config, file);
    Reporter& reporter = config.reporter == "junit"     ? static_cast<Reporter&>(junit)
                         : config.reporter == "compact" ? static_cast<Reporter&>(compact)
                                                        : console;
    String specs;
    for (String const& spec : config.specs) specs += (specs.empty() ? "" : " ") + spec;
    if (tests.empty()) std::fprintf(config.out.empty() && config.reporter == "junit" ? stderr : stdout, "No test cases matched '%s'\n", specs.c_str());
    int const code = run_all(config, reporter, tests);
    bool const written = file == stdout ? std::fflush(file) == 0 : std::fclose(file) == 0;
    if (!written) return complain("cannot write all of '" + (config.out.empty() ? String("stdout") : config.out) + "'");
    return code;
}

[[nodiscard]] int run_program(int argc, char const* const* argv) {
    Config config;
    bool found = false;
    std::uint64_t value = number_from_environment("GNOMON_PROPERTY_CASES", found);
    if (found) config.property_scale = value;
    found = false;
    value = number_from_environment("GNOMON_PROPERTY_CASE", found);
    if (found) config.property_case = value, config.one_property_case = true;
    String const complaint = parse_command_line(config, argc, argv);
    if (!complaint.empty()) return complain(complaint);
    List<Test> tests = select_tests(config);
    if (listing(config, tests)) return 0;
    sort_tests(tests, config);
    return run_with_reporter(config, tests);
}

}  // namespace detail
}  // namespace gnomon::check

#if !defined(GNOMON_CHECK_NO_MAIN)
int main(int argc, char** argv) { return gnomon::check::detail::run_program(argc, argv); }
#endif

#else  // Catch2 underneath: for_all's view of it

namespace gnomon::check::detail {

/// Stands in for Catch2's collector of results. Silent: a failure only sets hot().case_failed. Aloud: passes
/// everything on, but only the first failure.
class CaptureFilter final : public Catch::IResultCapture {
public:
    CaptureFilter(Catch::IResultCapture& inner, bool silent) : inner_(inner), silent_(silent) {}
    [[nodiscard]] bool failed() const noexcept { return failed_; }

    bool sectionStarted(Catch::SectionInfo const& info, Catch::Counts& counts) override {
        return !silent_ && inner_.sectionStarted(info, counts);
    }
    void sectionEnded(Catch::SectionEndInfo const& info) override { inner_.sectionEnded(info); }
    void sectionEndedEarly(Catch::SectionEndInfo const& info) override { inner_.sectionEndedEarly(info); }
    auto acquireGeneratorTracker(Catch::StringRef name, Catch::SourceLineInfo const& line)
        -> Catch::IGeneratorTracker& override {
        return inner_.acquireGeneratorTracker(name, line);
    }
#if defined(CATCH_CONFIG_ENABLE_BENCHMARKING)
    void benchmarkPreparing(std::string const& name) override { inner_.benchmarkPreparing(name); }
    void benchmarkStarting(Catch::BenchmarkInfo const& info) override { inner_.benchmarkStarting(info); }
    void benchmarkEnded(Catch::BenchmarkStats<> const& stats) override { inner_.benchmarkEnded(stats); }
    void benchmarkFailed(std::string const& error) override { inner_.benchmarkFailed(error); }
#endif
    void pushScopedMessage(Catch::MessageInfo const& message) override {
        if (!silent_) inner_.pushScopedMessage(message);
    }
    void popScopedMessage(Catch::MessageInfo const& message) override {
        if (!silent_) inner_.popScopedMessage(message);
    }
    void emplaceUnscopedMessage(Catch::MessageBuilder const& builder) override {
        if (!silent_) inner_.emplaceUnscopedMessage(builder);
    }
    void handleFatalErrorCondition(Catch::StringRef message) override { inner_.handleFatalErrorCondition(message); }

    void handleExpr(Catch::AssertionInfo const& info, Catch::ITransientExpression const& expression,
                    Catch::AssertionReaction& reaction) override {
        bool const passed = expression.getResult() != Catch::isFalseTest(info.resultDisposition);
        if (wanted(info, passed, reaction)) inner_.handleExpr(info, expression, reaction);
    }
    void handleMessage(Catch::AssertionInfo const& info, Catch::ResultWas::OfType type, Catch::StringRef const& message,
                       Catch::AssertionReaction& reaction) override {
        if (wanted(info, Catch::isOk(type), reaction)) inner_.handleMessage(info, type, message, reaction);
    }
    void handleUnexpectedExceptionNotThrown(Catch::AssertionInfo const& info,
                                            Catch::AssertionReaction& reaction) override {
        if (wanted(info, false, reaction)) inner_.handleUnexpectedExceptionNotThrown(info, reaction);
    }
    void handleUnexpectedInflightException(Catch::AssertionInfo const& info, std::string const& message,
                                           Catch::AssertionReaction& reaction) override {
        if (wanted(info, false, reaction)) inner_.handleUnexpectedInflightException(info, message, reaction);
    }
    void handleIncomplete(Catch::AssertionInfo const& info) override {
        if (!silent_) inner_.handleIncomplete(info);
    }
    void handleNonExpr(Catch::AssertionInfo const& info, Catch::ResultWas::OfType type,
                       Catch::AssertionReaction& reaction) override {
        if (wanted(info, Catch::isOk(type), reaction)) inner_.handleNonExpr(info, type, reaction);
    }
    bool lastAssertionPassed() override { return silent_ ? last_passed_ : inner_.lastAssertionPassed(); }
    void assertionPassed() override {
        if (!silent_) inner_.assertionPassed();
    }
    std::string getCurrentTestName() const override { return inner_.getCurrentTestName(); }
    Catch::AssertionResult const* getLastResult() const override { return inner_.getLastResult(); }
    void exceptionEarlyReported() override { inner_.exceptionEarlyReported(); }

private:
    // Keeps the books; true where the real collector is to hear of it.
    bool wanted(Catch::AssertionInfo const& info, bool passed, Catch::AssertionReaction& reaction) {
        last_passed_ = passed;
        if (passed) return !silent_;
        if (Catch::shouldSuppressFailure(info.resultDisposition)) return !silent_;
        bool const first = !std::exchange(failed_, true);
        hot().case_failed = true;
        if (!silent_ && first) return true;
        reaction.shouldThrow = !Catch::shouldContinueOnFailure(info.resultDisposition);
        return false;
    }

    Catch::IResultCapture& inner_;
    bool silent_;
    bool failed_ = false;
    bool last_passed_ = true;
};

Silence::Silence() : before_(hot()), capture_(Catch::getCurrentMutableContext().getResultCapture()) {
    hot().silent = true;
    Catch::getCurrentMutableContext().setResultCapture(new CaptureFilter(*capture_, true));
}
Silence::~Silence() {
    delete Catch::getCurrentMutableContext().getResultCapture();
    Catch::getCurrentMutableContext().setResultCapture(capture_);
    hot() = before_;
}

void rethrow_control() {}

PropertyOptions property_options() {
    PropertyOptions options;
    bool found = false;
    options.seed = Catch::rngSeed();
    options.scale = number_from_environment("GNOMON_PROPERTY_CASES", found);
    if (!found) options.scale = 1000;
    options.case_index = number_from_environment("GNOMON_PROPERTY_CASE", options.one_case);
    options.key = hash_text(mix64(options.seed + 1), Catch::getResultCapture().getCurrentTestName().c_str()) + mix64(1);
    return options;
}

Text replay_command(PropertyOptions const& options, std::uint64_t index) {
    Text out("GNOMON_PROPERTY_CASE=");
    put_unsigned(out, index);
    out.append(" ").append(Catch::getCurrentContext().getConfig()->name().c_str()).append(" ");
    out.append(("\"" + Catch::getResultCapture().getCurrentTestName() + "\"").c_str()).append(" --rng-seed ");
    put_unsigned(out, options.seed);
    return out;
}

void report_property(bool passed, Text const& text) {
    if (passed) {
        SUCCEED("for_all: " << text.data());
    } else {
        FAIL_CHECK("for_all: " << text.data());
    }
}

void report_counterexample(Property const& property, Tape& tape, Text const& summary) {
    INFO(summary.data());
    Catch::IResultCapture& collector = Catch::getResultCapture();
    CaptureFilter first_only(collector, false);
    Choices choices(0, 0, &tape);
    bool said_no = false;
    Catch::getCurrentMutableContext().setResultCapture(&first_only);
    try {
        said_no = !property.run(property.self, choices);
    } catch (...) {
        Catch::getCurrentMutableContext().setResultCapture(&collector);
        if (first_only.failed()) throw;
        FAIL_CHECK("for_all: the function threw: " << Catch::translateActiveException());
        return;
    }
    Catch::getCurrentMutableContext().setResultCapture(&collector);
    if (!first_only.failed())
        report_property(false, said_no ? "the function returned false" : "the case failed at first, and passed when it was run again");
}

}  // namespace gnomon::check::detail
#endif  // own harness or Catch2

#if defined(__clang__)
#pragma clang optimize on
#elif defined(__GNUC__)
#pragma GCC pop_options
#endif
#endif  // GNOMON_CHECK_MAIN
