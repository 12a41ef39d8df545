#pragma once
// The slow truth of the orientation tests: integer arithmetic of any length. Shares no code with the library.
//
// A finite float is an integer times 2^-149. Scaled by 2^149 all coordinates are integers below 2^277, and the sign of
// a determinant is the sign of an integer below 2^840.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace oracle {

/// Sign and magnitude, 32 limbs of 32 bits: 1024 bits.
class BigInt {
public:
    BigInt() = default;

    /// x * 2^149.
    explicit BigInt(float x) {
        auto const bits = std::bit_cast<std::uint32_t>(x);
        std::uint32_t const exponent = (bits >> 23U) & 0xFFU;
        std::uint32_t mantissa = bits & 0x7F'FFFFU;
        if (exponent != 0) mantissa |= 0x80'0000U;
        std::uint32_t const shift = exponent == 0 ? 0 : exponent - 1;
        std::uint64_t const wide = std::uint64_t{mantissa} << (shift % 32U);
        limb_[shift / 32U] = static_cast<std::uint32_t>(wide);
        limb_[shift / 32U + 1] = static_cast<std::uint32_t>(wide >> 32U);
        size_ = shift / 32U + 2;
        negative_ = (bits >> 31U) != 0;
        trim();
    }

    [[nodiscard]] int sign() const { return size_ == 0 ? 0 : negative_ ? -1 : 1; }

    friend BigInt operator-(BigInt x) {
        x.negative_ = !x.negative_;
        return x;
    }
    friend BigInt operator-(BigInt const& a, BigInt const& b) { return a + -b; }

    friend BigInt operator+(BigInt const& a, BigInt const& b) {
        if (a.negative_ == b.negative_) return added(a, b);
        return compare(a, b) >= 0 ? subtracted(a, b) : subtracted(b, a);
    }

    friend BigInt operator*(BigInt const& a, BigInt const& b) {
        BigInt out;
        for (std::size_t i = 0; i < a.size_; ++i) {
            std::uint64_t carry = 0;
            for (std::size_t j = 0; j < b.size_ || carry != 0; ++j) {
                std::uint64_t const other = j < b.size_ ? b.limb_[j] : 0;
                carry += std::uint64_t{a.limb_[i]} * other + out.limb_[i + j];
                out.limb_[i + j] = static_cast<std::uint32_t>(carry);
                carry >>= 32U;
            }
        }
        out.size_ = a.size_ + b.size_;
        out.negative_ = a.negative_ != b.negative_;
        out.trim();
        return out;
    }

private:
    static int compare(BigInt const& a, BigInt const& b) {
        if (a.size_ != b.size_) return a.size_ < b.size_ ? -1 : 1;
        for (std::size_t i = a.size_; i-- > 0;)
            if (a.limb_[i] != b.limb_[i]) return a.limb_[i] < b.limb_[i] ? -1 : 1;
        return 0;
    }
    static BigInt added(BigInt const& a, BigInt const& b) {
        BigInt out;
        out.negative_ = a.negative_;
        out.size_ = (a.size_ > b.size_ ? a.size_ : b.size_) + 1;
        std::uint64_t carry = 0;
        for (std::size_t i = 0; i < out.size_; ++i) {
            carry += std::uint64_t{a.limb_[i]} + b.limb_[i];
            out.limb_[i] = static_cast<std::uint32_t>(carry);
            carry >>= 32U;
        }
        out.trim();
        return out;
    }
    static BigInt subtracted(BigInt const& larger, BigInt const& smaller) {
        BigInt out = larger;
        std::int64_t borrow = 0;
        for (std::size_t i = 0; i < out.size_; ++i) {
            std::int64_t const digit = std::int64_t{out.limb_[i]} - smaller.limb_[i] - borrow;
            borrow = digit < 0 ? 1 : 0;
            out.limb_[i] = static_cast<std::uint32_t>(digit);
        }
        out.trim();
        return out;
    }
    void trim() {
        while (size_ > 0 && limb_[size_ - 1] == 0) --size_;
    }

    std::array<std::uint32_t, 32> limb_{};
    std::size_t size_ = 0;
    bool negative_ = false;
};

using Point = std::array<float, 3>;
using BigPoint = std::array<BigInt, 3>;

inline BigPoint difference(Point const& a, Point const& b) {
    return {BigInt(a[0]) - BigInt(b[0]), BigInt(a[1]) - BigInt(b[1]), BigInt(a[2]) - BigInt(b[2])};
}

inline int det3_sign(BigPoint const& p, BigPoint const& q, BigPoint const& r) {
    return (p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
            p[2] * (q[0] * r[1] - q[1] * r[0]))
        .sign();
}

/// Positive where the normal (b - a) x (c - a) points. `at_infinity`: d is a direction.
inline int orient3d(Point const& a, Point const& b, Point const& c, Point const& d, bool at_infinity = false) {
    Point const from = at_infinity ? Point{0.0F, 0.0F, 0.0F} : a;
    return det3_sign(difference(b, a), difference(c, a), difference(d, from));
}

inline int line_side(Point const& start, Point const& end, bool at_infinity, Point const& a, Point const& b) {
    Point const from = at_infinity ? Point{0.0F, 0.0F, 0.0F} : start;
    return det3_sign(difference(end, from), difference(a, start), difference(b, start));
}

inline int orient2d(float ax, float ay, float bx, float by, float cx, float cy) {
    return ((BigInt(bx) - BigInt(ax)) * (BigInt(cy) - BigInt(ay)) -
            (BigInt(by) - BigInt(ay)) * (BigInt(cx) - BigInt(ax)))
        .sign();
}

/// Whether the open segment (or ray) from `start` to `end` is blocked by the triangle abc.
inline bool blocks(Point const& start, Point const& end, bool at_infinity, std::array<Point, 3> const& t) {
    int const plane = orient3d(t[0], t[1], t[2], start) * orient3d(t[0], t[1], t[2], end, at_infinity);
    if (plane >= 0) return false;
    int const u = line_side(start, end, at_infinity, t[0], t[1]);
    int const v = line_side(start, end, at_infinity, t[1], t[2]);
    int const w = line_side(start, end, at_infinity, t[2], t[0]);
    bool const plus = u > 0 || v > 0 || w > 0;
    bool const minus = u < 0 || v < 0 || w < 0;
    return !(plus && minus);
}

}  // namespace oracle
