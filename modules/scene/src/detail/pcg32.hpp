#pragma once
// PCG-XSH-RR 64/32, the generator that the fixed seeds of the procedural scenes mean. Exact on every machine.

#include <cstdint>

namespace gnomon::scene::detail {

class Pcg32 {
public:
    explicit Pcg32(std::uint64_t seed) noexcept {
        next();
        state_ += seed;
        next();
    }

    std::uint32_t next() noexcept {
        std::uint64_t const old = state_;
        state_ = old * 6364136223846793005U + increment;
        auto const mixed = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
        auto const turn = static_cast<std::uint32_t>(old >> 59U);
        return (mixed >> turn) | (mixed << ((32U - turn) & 31U));
    }

    /// In [0, 1), one of 2^32 values.
    double uniform() noexcept { return static_cast<double>(next()) * 0x1p-32; }

    double uniform(double low, double high) noexcept { return low + (high - low) * uniform(); }

    /// In [0, count). The bias of the multiplication is below count / 2^32.
    std::uint32_t below(std::uint32_t count) noexcept {
        return static_cast<std::uint32_t>((std::uint64_t{next()} * count) >> 32U);
    }

private:
    static constexpr std::uint64_t increment = (54U << 1U) | 1U;
    std::uint64_t state_ = 0;
};

}  // namespace gnomon::scene::detail
