#pragma once
// Eight lanes as arrays: the reference form of what box_core.hpp computes with. Every operation is the vector one's.

#include "pieces.hpp"

namespace gnomon::raster::detail::scalar_lanes {

struct F8 {
    float v[8];
};
struct I8 {
    std::int32_t v[8];
};
struct M8 {
    std::uint32_t bits;
};

template <class F>
inline F8 each(F f) {
    F8 r;
    for (int i = 0; i < 8; ++i) r.v[i] = f(i);
    return r;
}
template <class F>
inline I8 each_int(F f) {
    I8 r;
    for (int i = 0; i < 8; ++i) r.v[i] = f(i);
    return r;
}
template <class F>
inline M8 where(F f) {
    M8 r{0};
    for (int i = 0; i < 8; ++i) r.bits |= (f(i) ? 1U : 0U) << static_cast<unsigned>(i);
    return r;
}

inline F8 all(float x) {
    return each([=](int) { return x; });
}
inline I8 all(std::int32_t x) {
    return each_int([=](int) { return x; });
}
inline F8 load(float const* p) {
    return each([=](int i) { return p[i]; });
}
inline void store(float* p, F8 const& a) {
    for (int i = 0; i < 8; ++i) p[i] = a.v[i];
}
inline void store(std::int32_t* p, I8 const& a) {
    for (int i = 0; i < 8; ++i) p[i] = a.v[i];
}
inline F8 operator+(F8 const& a, F8 const& b) {
    return each([&](int i) { return a.v[i] + b.v[i]; });
}
inline F8 operator-(F8 const& a, F8 const& b) {
    return each([&](int i) { return a.v[i] - b.v[i]; });
}
inline F8 operator*(F8 const& a, F8 const& b) {
    return each([&](int i) { return a.v[i] * b.v[i]; });
}
inline F8 operator/(F8 const& a, F8 const& b) {
    return each([&](int i) { return a.v[i] / b.v[i]; });
}
inline F8 lesser(F8 const& a, F8 const& b) {
    return each([&](int i) { return a.v[i] < b.v[i] ? a.v[i] : b.v[i]; });
}
inline F8 greater(F8 const& a, F8 const& b) {
    return each([&](int i) { return a.v[i] > b.v[i] ? a.v[i] : b.v[i]; });
}
inline F8 magnitude(F8 const& a) {
    return each([&](int i) { return a.v[i] < 0.0F ? -a.v[i] : a.v[i]; });
}
inline M8 operator<(F8 const& a, F8 const& b) {
    return where([&](int i) { return a.v[i] < b.v[i]; });
}
inline M8 operator<=(F8 const& a, F8 const& b) {
    return where([&](int i) { return a.v[i] <= b.v[i]; });
}
inline M8 operator&(M8 a, M8 b) { return {a.bits & b.bits}; }
inline M8 operator|(M8 a, M8 b) { return {a.bits | b.bits}; }
inline M8 without(M8 a, M8 b) { return {a.bits & ~b.bits}; }
inline std::uint32_t bits_of(M8 m) { return m.bits; }
inline F8 choose(M8 m, F8 const& yes, F8 const& no) {
    return each([&](int i) { return (m.bits >> static_cast<unsigned>(i) & 1U) != 0 ? yes.v[i] : no.v[i]; });
}

inline I8 operator+(I8 const& a, I8 const& b) {
    return each_int([&](int i) {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(a.v[i]) + static_cast<std::uint32_t>(b.v[i]));
    });
}
inline I8 operator-(I8 const& a, I8 const& b) {
    return each_int([&](int i) {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(a.v[i]) - static_cast<std::uint32_t>(b.v[i]));
    });
}
inline I8 lesser(I8 const& a, I8 const& b) {
    return each_int([&](int i) { return a.v[i] < b.v[i] ? a.v[i] : b.v[i]; });
}
inline I8 greater(I8 const& a, I8 const& b) {
    return each_int([&](int i) { return a.v[i] > b.v[i] ? a.v[i] : b.v[i]; });
}
inline I8 shifted_down(I8 const& a, int bits) {
    return each_int([&](int i) { return a.v[i] >> bits; });
}
inline I8 shifted_up(I8 const& a, int bits) {
    return each_int([&](int i) { return static_cast<std::int32_t>(static_cast<std::uint32_t>(a.v[i]) << bits); });
}
inline M8 operator<(I8 const& a, I8 const& b) {
    return where([&](int i) { return a.v[i] < b.v[i]; });
}
inline F8 to_float(I8 const& a) {
    return each([&](int i) { return static_cast<float>(a.v[i]); });
}
/// Beyond the integers: the least, as the instruction does.
inline I8 to_nearest(F8 const& a) {
    return each_int([&](int i) {
        bool const fits = a.v[i] > -2147483648.0F && a.v[i] < 2147483648.0F;
        return fits ? round_even(static_cast<double>(a.v[i])) : INT32_MIN;
    });
}
inline I8 lane_numbers() {
    return each_int([](int i) { return i; });
}
inline F8 load_codes(std::uint16_t const* p) {
    return each([&](int i) { return static_cast<float>(p[i]); });
}

/// Eight boxes of six floats: element c of each.
inline void load_boxes(float const* const (&box)[8], F8 (&element)[6]) {
    for (int c = 0; c < 6; ++c) element[c] = each([&](int i) { return box[i][c]; });
}

}  // namespace gnomon::raster::detail::scalar_lanes
