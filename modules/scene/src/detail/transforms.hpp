#pragma once
// Matrices of nodes, in double and in one order of operations: the loader, the poses and the writer agree to the last bit.

#include <gnomon/math/scalar.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/scene/pose.hpp>

#include <cmath>

namespace gnomon::scene::detail {

/// a * b for matrices whose last row is 0 0 0 1, in one order of operations.
inline math::dmat4 multiplied(math::dmat4 const& a, math::dmat4 const& b) noexcept {
    math::dmat4 out(1.0);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row) {
            double const linear = (a[0][row] * b[column][0] + a[1][row] * b[column][1]) + a[2][row] * b[column][2];
            out[column][row] = column == 3 ? linear + a[3][row] : linear;
        }
    return out;
}

/// Translation, rotation (x y z w, scaled to length 1; nothing where it has none) and scale as a matrix.
inline math::dmat4 from_trs(NodeTransform const& trs) noexcept {
    math::dvec3 const& t = trs.translation;
    math::dvec4 const& r = trs.rotation;
    math::dvec3 const& s = trs.scale;
    double const length = std::sqrt(((r.x * r.x + r.y * r.y) + r.z * r.z) + r.w * r.w);
    bool const turns = length > 0.0 && math::is_finite(length);
    double const x = turns ? r.x / length : 0.0;
    double const y = turns ? r.y / length : 0.0;
    double const z = turns ? r.z / length : 0.0;
    double const w = turns ? r.w / length : 1.0;
    math::dmat4 m(1.0);
    m[0] = math::dvec4(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y), 0.0) * s.x;
    m[1] = math::dvec4(2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x), 0.0) * s.y;
    m[2] = math::dvec4(2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y), 0.0) * s.z;
    m[3] = math::dvec4(t.x, t.y, t.z, 1.0);
    return m;
}

inline math::dmat4 local_of(Node const& node) noexcept {
    return node.matrix ? *node.matrix : from_trs({node.translation, node.rotation, node.scale});
}

inline bool all_finite(math::dmat4 const& m) noexcept {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!math::is_finite(m[column][row])) return false;
    return true;
}

/// `v` with length 1. What has it already, to a part in 1e12, stays as it is: a second reading changes nothing.
inline math::dvec3 kept_unit(math::dvec3 const& v, math::dvec3 const& fallback) noexcept {
    double const length_sq = (v.x * v.x + v.y * v.y) + v.z * v.z;
    if (std::abs(length_sq - 1.0) < 1e-12) return v;
    return length_sq > 0.0 && math::is_finite(length_sq) ? v / std::sqrt(length_sq) : fallback;
}

inline math::dvec3 column(math::dmat4 const& m, int i) noexcept { return {m[i][0], m[i][1], m[i][2]}; }

/// A camera that a matrix places: orthonormal axes, whatever the matrix scales and shears.
inline CameraPose camera_placed_by(math::dmat4 const& world) noexcept {
    CameraPose out;
    out.eye_m = column(world, 3);
    out.back = kept_unit(column(world, 2), {0.0, 0.0, 1.0});
    math::dvec3 const side = column(world, 0);
    double const lean = glm::dot(side, out.back);
    out.right = kept_unit(std::abs(lean) < 1e-12 ? side : side - out.back * lean, {1.0, 0.0, 0.0});
    out.up = column(world, 1);
    math::dvec3 const upright = glm::cross(out.back, out.right);
    math::dvec3 const off = out.up - upright;
    if (!(glm::dot(off, off) < 1e-24)) out.up = upright;
    return out;
}

inline LightPose light_placed_by(math::dmat4 const& world) noexcept {
    return {column(world, 3), -kept_unit(column(world, 2), {0.0, 0.0, 1.0})};
}

template <class T>
void place(T& out, CameraPose const& pose) {
    out.eye_m = pose.eye_m;
    out.right = pose.right;
    out.up = pose.up;
    out.back = pose.back;
}

template <class T>
void place(T& out, LightPose const& pose) {
    out.position_m = pose.position_m;
    out.direction = pose.direction;
}

}  // namespace gnomon::scene::detail
