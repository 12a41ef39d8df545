#pragma once
// Result: a value, or why there is none. For failures a caller cannot foresee: files, configuration, devices.

#include <gnomon/core/contract.hpp>

#include <concepts>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace gnomon::core {

/// Why there is no value: the module's code, and a sentence that names the value and what to do.
template <class Code>
struct Failure {
    Code code;
    std::string message;
};

template <class Code>
Failure(Code, std::string) -> Failure<Code>;
template <class Code>
Failure(Code, char const*) -> Failure<Code>;

/// Either a `T` or a `Failure<Code>`; nothing else.
template <class T, class Code>
class [[nodiscard]] Result {
public:
    using value_type = T;
    using failure_type = Failure<Code>;

    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Failure<Code> failure) : state_(std::in_place_index<1>, std::move(failure)) {}

    [[nodiscard]] bool has_value() const noexcept { return state_.index() == 0; }
    [[nodiscard]] explicit operator bool() const noexcept { return has_value(); }

    /// expects: `has_value()`.
    [[nodiscard]] T& value() & noexcept {
        GNOMON_EXPECT(has_value());
        return *std::get_if<0>(&state_);
    }
    [[nodiscard]] T const& value() const& noexcept {
        GNOMON_EXPECT(has_value());
        return *std::get_if<0>(&state_);
    }
    [[nodiscard]] T&& value() && noexcept { return std::move(this->value()); }

    [[nodiscard]] T& operator*() & noexcept { return value(); }
    [[nodiscard]] T const& operator*() const& noexcept { return value(); }
    [[nodiscard]] T&& operator*() && noexcept { return std::move(this->value()); }
    [[nodiscard]] T* operator->() noexcept { return &value(); }
    [[nodiscard]] T const* operator->() const noexcept { return &value(); }

    /// expects: `!has_value()`.
    [[nodiscard]] Failure<Code> const& failure() const& noexcept {
        GNOMON_EXPECT(!has_value());
        return *std::get_if<1>(&state_);
    }
    [[nodiscard]] Failure<Code>&& failure() && noexcept {
        GNOMON_EXPECT(!has_value());
        return std::move(*std::get_if<1>(&state_));
    }

    [[nodiscard]] T value_or(T fallback) const& { return has_value() ? value() : std::move(fallback); }

    /// `f(value)` as a new Result; a failure goes through unchanged.
    template <class F>
    [[nodiscard]] auto map(F&& f) && -> Result<std::invoke_result_t<F, T&&>, Code> {
        if (has_value()) return std::forward<F>(f)(std::move(*this).value());
        return std::move(*this).failure();
    }

    /// `f(value)`, which is a Result itself; a failure goes through unchanged.
    template <class F>
    [[nodiscard]] auto and_then(F&& f) && -> std::invoke_result_t<F, T&&> {
        if (has_value()) return std::forward<F>(f)(std::move(*this).value());
        return std::move(*this).failure();
    }

private:
    std::variant<T, Failure<Code>> state_;
};

/// The value of a result that has none to give but success.
struct Done {
    friend constexpr bool operator==(Done, Done) noexcept = default;
};

}  // namespace gnomon::core
