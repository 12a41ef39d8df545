#pragma once
// The vertices of one primitive of one instance in a pose: morphed, then placed by a matrix or by joints, all in double.

#include "transforms.hpp"

#include <gnomon/scene/flatten.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace gnomon::scene::detail {

/// Where a point stands in the world: M p, in double, in a fixed order of operations.
inline math::dvec3 to_world(math::dmat4 const& m, math::dvec3 const& p) noexcept {
    math::dvec3 w;
    for (int row = 0; row < 3; ++row) w[row] = ((m[0][row] * p.x + m[1][row] * p.y) + m[2][row] * p.z) + m[3][row];
    return w;
}

inline double determinant(math::dmat4 const& m) noexcept {
    return m[0][0] * (m[1][1] * m[2][2] - m[2][1] * m[1][2]) - m[1][0] * (m[0][1] * m[2][2] - m[2][1] * m[0][2]) +
           m[2][0] * (m[0][1] * m[1][2] - m[1][1] * m[0][2]);
}

/// Turns normals as the matrix turns planes: its cofactors, whose sign a mirroring matrix changes, so that is undone.
inline math::dmat3 normal_matrix(math::dmat4 const& m, bool mirrors) noexcept {
    double const sign = mirrors ? -1.0 : 1.0;
    math::dmat3 n(0.0);
    n[0] = glm::cross(column(m, 1), column(m, 2)) * sign;
    n[1] = glm::cross(column(m, 2), column(m, 0)) * sign;
    n[2] = glm::cross(column(m, 0), column(m, 1)) * sign;
    return n;
}

/// `v` with length 1; where it has none to scale, `fallback`.
inline math::vec3 unit_or(math::dvec3 v, math::vec3 const& fallback) noexcept {
    double const largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0.0) || !math::is_finite(largest)) return fallback;
    v = v / largest;
    return math::to_float(v / std::sqrt((v.x * v.x + v.y * v.y) + v.z * v.z));
}

class PosedPart {
public:
    PosedPart(Scene const& scene, Pose const& pose, std::uint32_t instance, std::uint32_t primitive)
        : primitive_(scene.meshes[scene.instances[instance].mesh].primitives[primitive]),
          world_from_mesh_(pose.world_from_mesh[instance]),
          weights_(std::span(pose.morph_weights)
                       .subspan(pose.first_morph_weight[instance],
                                pose.first_morph_weight[instance + 1] - pose.first_morph_weight[instance])) {
        std::uint32_t const skin = scene.instances[instance].skin;
        if (skin != none && primitive_.influences != 0)
            joints_ = std::span(pose.world_from_bind)
                          .subspan(pose.first_joint[skin], pose.first_joint[skin + 1] - pose.first_joint[skin]);
        // A skin mirrors where most of its joints do: a single part that is folded over does not turn all triangles.
        auto const mirroring = std::count_if(joints_.begin(), joints_.end(), [](math::dmat4 const& m) { return determinant(m) < 0.0; });
        mirrors_ = joints_.empty() ? determinant(world_from_mesh_) < 0.0 : 2 * static_cast<std::size_t>(mirroring) > joints_.size();
        turn_ = normal_matrix(world_from_mesh_, mirrors_);
    }

    [[nodiscard]] bool mirrors() const noexcept { return mirrors_; }

    struct Vertex {
        math::dvec3 world_m;
        math::vec3 normal;
    };

    [[nodiscard]] Vertex vertex(std::size_t v) const noexcept {
        math::dvec3 p = math::to_double(primitive_.positions[v]);
        math::dvec3 n = math::to_double(primitive_.normals[v]);
        for (std::size_t t = 0; t < weights_.size(); ++t) {
            if (weights_[t] == 0.0) continue;
            MorphTarget const& target = primitive_.morph_targets[t];
            if (!target.positions.empty()) p = p + math::to_double(target.positions[v]) * weights_[t];
            if (!target.normals.empty()) n = n + math::to_double(target.normals[v]) * weights_[t];
        }
        if (joints_.empty()) return placed(world_from_mesh_, turn_, p, n);
        math::dmat4 const bent = blended(v);
        return placed(bent, normal_matrix(bent, mirrors_), p, n);
    }

private:
    static Vertex placed(math::dmat4 const& m, math::dmat3 const& turn, math::dvec3 const& p, math::dvec3 const& n) noexcept {
        return {to_world(m, p), unit_or(turn[0] * n.x + turn[1] * n.y + turn[2] * n.z, math::vec3(0.0F, 1.0F, 0.0F))};
    }

    /// The weighted mean of the joints' matrices. Divided by the weights' sum: floats that sum to 1 only nearly would else
    /// pull a vertex far from the world's origin toward it.
    [[nodiscard]] math::dmat4 blended(std::size_t v) const noexcept {
        math::dmat4 sum(0.0);
        double total = 0.0;
        for (std::size_t k = v * primitive_.influences; k < (v + 1) * primitive_.influences; ++k) {
            auto const weight = static_cast<double>(primitive_.joint_weights[k]);
            if (weight == 0.0) continue;
            math::dmat4 const& joint = joints_[primitive_.joints[k]];
            for (int column = 0; column < 4; ++column)
                for (int row = 0; row < 3; ++row) sum[column][row] += joint[column][row] * weight;
            total += weight;
        }
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 3; ++row) sum[column][row] /= total;
        sum[3][3] = 1.0;
        return sum;
    }

    Primitive const& primitive_;
    math::dmat4 const& world_from_mesh_;
    std::span<double const> weights_;
    std::span<math::dmat4 const> joints_;  ///< Empty: the matrix places the vertices.
    bool mirrors_ = false;
    math::dmat3 turn_{1.0};
};

}  // namespace gnomon::scene::detail
