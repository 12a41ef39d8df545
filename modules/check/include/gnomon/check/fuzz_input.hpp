#pragma once
// What a fuzz target reads from its bytes, what writes them, and where fuzzing starts from.

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::check {

/// Takes values off the front of the input. Behind its end there are zeros: every input means something.
class FuzzBytes {
  public:
    explicit FuzzBytes(std::span<std::uint8_t const> bytes) noexcept : rest_(bytes) {}

    [[nodiscard]] bool empty() const noexcept { return rest_.empty(); }
    [[nodiscard]] std::span<std::uint8_t const> rest() const noexcept { return rest_; }

    /// The bytes as they lie, so a float may be any float.
    template <class T>
    requires std::is_trivially_copyable_v<T>
    [[nodiscard]] T take() noexcept {
        T value{};
        std::size_t const n = rest_.size() < sizeof(T) ? rest_.size() : sizeof(T);
        if (n != 0) std::memcpy(&value, rest_.data(), n);
        rest_ = rest_.subspan(n);
        return value;
    }
    /// An integer in [low, high], from two bytes.
    [[nodiscard]] int in(int low, int high) noexcept {
        auto const range = static_cast<unsigned>(high - low) + 1U;
        return low + static_cast<int>(take<std::uint16_t>() % range);
    }
    [[nodiscard]] bool flag() noexcept { return (take<std::uint8_t>() & 1U) != 0; }

  private:
    std::span<std::uint8_t const> rest_;
};

/// Writes what `FuzzBytes` reads.
struct FuzzWriter {
    std::vector<std::uint8_t> bytes;

    template <class T>
    requires std::is_trivially_copyable_v<T> FuzzWriter& put(T const& value) {
        std::uint8_t raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        for (std::uint8_t const byte : raw) bytes.push_back(byte);
        return *this;
    }
    /// What `in(low, high)` reads as `value`.
    FuzzWriter& in(int low, int value) { return put(static_cast<std::uint16_t>(value - low)); }
    FuzzWriter& flag(bool value) { return put(static_cast<std::uint8_t>(value ? 1 : 0)); }
};

/// Numbers for seeds and mutations, the same everywhere: splitmix64.
struct FuzzRandom {
    std::uint64_t state;
    std::uint64_t next() noexcept {
        std::uint64_t z = (state += 0x9E3779B97F4A7C15ULL);
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
        return z ^ (z >> 31U);
    }
    /// In [0, n); 0 for n = 0.
    std::size_t below(std::size_t n) noexcept { return n == 0 ? 0 : static_cast<std::size_t>(next() % n); }
};

/// The inputs that fuzzing starts from.
struct FuzzSeeds {
    struct Seed {
        std::string name;
        std::vector<std::uint8_t> bytes;
    };
    std::vector<Seed> seeds;

    void add(std::string name, std::vector<std::uint8_t> bytes) {
        seeds.push_back({std::move(name), std::move(bytes)});
    }
};

}  // namespace gnomon::check
