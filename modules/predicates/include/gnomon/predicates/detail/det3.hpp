#pragma once
// The sign of a 3x3 determinant whose rows are differences of float points: filter in double, then exact.

#include <gnomon/math/scalar.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/predicates/detail/expansion.hpp>
#include <gnomon/predicates/sign.hpp>

#include <cmath>

#if defined(__GNUC__)
#define GNOMON_PREDICATES_OUT_OF_LINE __attribute__((noinline, cold))
#else
#define GNOMON_PREDICATES_OUT_OF_LINE
#endif

namespace gnomon::predicates::detail {

inline constexpr double half_ulp = 0x1p-53;  ///< u: one rounding multiplies by 1 + d, |d| <= u.

// Why 9u. Let P be the exact permanent of the absolute entries: the sum of six |products of three|. A computed entry
// holds one rounding. A computed product of three holds its three entries' roundings, those of its two
// multiplications, of the minor's subtraction and of the two final additions: at most 8. So
// |computed - exact| <= ((1+u)^8 - 1) P. The computed permanent holds at most 8 too: it is >= (1-u)^8 P. Together
//     |computed - exact| <= (8u + 100u^2) computed_permanent  <  fl(9u * computed_permanent).
// A fused multiply-add only leaves roundings out. Nothing underflows: entries are multiples of 2^-149 below 2^129,
// so products of three are 0 or in [2^-447, 2^390], and no rounding happens near either end of double.
inline constexpr double det3_bound = 9.0 * half_ulp;
inline constexpr double det2_bound = 5.0 * half_ulp;  ///< The same count for 2x2: three roundings, then the subtraction.

/// p - origin for each axis, or a direction as it is (origin null).
struct Row {
    math::vec3 p;
    math::vec3 const* origin;

    [[nodiscard]] math::dvec3 rounded() const noexcept {
        return origin == nullptr ? math::to_double(p) : math::to_double(p) - math::to_double(*origin);
    }
    [[nodiscard]] Expansion<2> exact(math::axis_t axis) const noexcept {
        auto const from = origin == nullptr ? 0.0 : static_cast<double>((*origin)[axis]);
        return expansion(two_diff(static_cast<double>(p[axis]), from));
    }
    [[nodiscard]] bool finite() const noexcept {
        return math::is_finite(p) && (origin == nullptr || math::is_finite(*origin));
    }
};

/// a * d - b * c.
[[nodiscard]] inline Expansion<16> minor(Expansion<2> const& a, Expansion<2> const& b, Expansion<2> const& c,
                                         Expansion<2> const& d) noexcept {
    return sum(product(a, d), negated(product(b, c)));
}

/// The sign of det[p; q; r], exactly. Out of line: it is rare, and large.
///
/// No overflow or underflow can occur for finite floats. Every entry is an integer times 2^-149, at most 2^129; every
/// term of every expansion here is an integer times 2^-447 (a rounding error of a sum or product of such numbers is
/// one too), hence 0 or at least 2^-447; and at most 6 * 2^387 * (1 + tiny). double reaches from 2^-1022 to 2^1023.
/// cost:    about 0.3 us for ordinary coordinates.
[[nodiscard]] GNOMON_PREDICATES_OUT_OF_LINE inline Sign det3_exact(Row const& p, Row const& q, Row const& r) noexcept {
    if (!(p.finite() && q.finite() && r.finite())) return Sign::zero;
    Expansion<2> const qx = q.exact(0);
    Expansion<2> const qy = q.exact(1);
    Expansion<2> const qz = q.exact(2);
    Expansion<2> const rx = r.exact(0);
    Expansion<2> const ry = r.exact(1);
    Expansion<2> const rz = r.exact(2);
    auto const x = product(minor(qy, qz, ry, rz), p.exact(0));
    auto const y = product(minor(qz, qx, rz, rx), p.exact(1));
    auto const z = product(minor(qx, qy, rx, ry), p.exact(2));
    auto const det = sum(sum(x, y), z);
    return det.size == 0 ? Sign::zero : sign_of(det.term[det.size - 1]);
}

[[nodiscard]] inline Estimate det3_estimate(math::dvec3 const& p, math::dvec3 const& q, math::dvec3 const& r) noexcept {
    double const yz = q.y * r.z;
    double const zy = q.z * r.y;
    double const zx = q.z * r.x;
    double const xz = q.x * r.z;
    double const xy = q.x * r.y;
    double const yx = q.y * r.x;
    double const value = p.x * (yz - zy) + p.y * (zx - xz) + p.z * (xy - yx);
    double const permanent = std::abs(p.x) * (std::abs(yz) + std::abs(zy)) +
                             std::abs(p.y) * (std::abs(zx) + std::abs(xz)) +
                             std::abs(p.z) * (std::abs(xy) + std::abs(yx));
    return {value, det3_bound * permanent};
}

[[nodiscard]] inline Sign det3_sign(Row const& p, Row const& q, Row const& r) noexcept {
    Estimate const estimate = det3_estimate(p.rounded(), q.rounded(), r.rounded());
    if (estimate.is_certain()) return sign_of(estimate.value);
    return det3_exact(p, q, r);
}

}  // namespace gnomon::predicates::detail
