#pragma once
// Points on which orientation goes wrong: near-coplanar, exactly coplanar, far apart in magnitude, denormal, huge.

#include "exact_oracle.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

namespace hard {

/// splitmix64.
struct Random {
    std::uint64_t state;

    std::uint64_t bits() {
        state += 0x9E3779B97F4A7C15U;
        std::uint64_t z = state;
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return z ^ (z >> 31U);
    }
    int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
    float uniform(float lo, float hi) {
        return lo + (hi - lo) * static_cast<float>(static_cast<double>(bits() >> 40U) * 0x1p-24);
    }
};

/// Any finite float: all exponents are equally frequent.
inline float any_float(Random& random) {
    for (;;) {
        auto const x = std::bit_cast<float>(static_cast<std::uint32_t>(random.bits() >> 32U));
        if (std::abs(x) <= 3.402823466e38F) return x;
    }
}

/// One of the kinds of coordinates that break predicates.
inline float coordinate(Random& random, int kind) {
    switch (kind) {
        case 0: return random.uniform(-1.0F, 1.0F);
        case 1: return static_cast<float>(random.below(5) - 2);                        // grids: exact ties
        case 2: return 131072.0F + static_cast<float>(random.below(64)) / 64.0F;        // far away, dyadic
        case 3: return std::bit_cast<float>(static_cast<std::uint32_t>(random.below(9)));  // denormals
        case 4: return (random.below(2) == 0 ? -3.402823466e38F : 3.402823466e38F);
        case 5: return any_float(random);
        case 6: return std::ldexp(1.0F, random.below(277) - 149);                       // powers of two
        default: return random.below(3) == 0 ? -0.0F : random.uniform(0.0F, 1e-38F);
    }
}

inline oracle::Point point(Random& random, int kind) {
    return {coordinate(random, kind), coordinate(random, kind), coordinate(random, kind)};
}

/// Four points; in half of the cases the last is nearly in the plane of the others, or on a line with two of them.
inline std::array<oracle::Point, 4> four_points(Random& random) {
    int const kind = random.below(9);
    std::array<oracle::Point, 4> p;
    for (auto& q : p) q = point(random, kind < 8 ? kind : random.below(8));
    int const shape = random.below(4);
    if (shape < 2) return p;
    float const s = static_cast<float>(random.below(9)) / 8.0F;
    float const t = shape == 2 ? 0.0F : static_cast<float>(random.below(9)) / 8.0F;
    for (std::size_t i = 0; i < 3; ++i) {
        float const x = p[0][i] * (1.0F - s - t) + p[1][i] * s + p[2][i] * t;
        if (std::abs(x) <= 3.402823466e38F) p[3][i] = x;
    }
    if (random.below(2) == 0) p[3][0] = std::nextafter(p[3][0], 0.0F);
    return p;
}

}  // namespace hard
