#pragma once
// Small meshes for the tests of mesh.

#include <gnomon/mesh/half_edges.hpp>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <string>
#include <vector>

namespace meshes {

using gnomon::math::vec3;

struct Mesh {
    std::vector<vec3> positions;
    std::vector<std::uint32_t> indices;

    [[nodiscard]] gnomon::mesh::Triangles list() const { return {positions, indices}; }
    void add(std::initializer_list<std::uint32_t> more) { indices.insert(indices.end(), more); }
    /// Appends another one, with positions of its own.
    void append(Mesh const& other, vec3 const& by = vec3(0.0F, 0.0F, 0.0F)) {
        auto const n = static_cast<std::uint32_t>(positions.size());
        for (vec3 const& p : other.positions) positions.push_back(p + by);
        for (std::uint32_t const i : other.indices) indices.push_back(i + n);
    }
    /// Each corner a position of its own, as files with normals per face have it.
    [[nodiscard]] Mesh exploded() const {
        Mesh mesh;
        for (std::uint32_t const i : indices) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(positions[i]);
        }
        return mesh;
    }
};

/// How a property test prints one.
[[nodiscard]] inline std::string check_string(Mesh const& mesh) {
    std::string text = "positions";
    char number[64];
    for (vec3 const& p : mesh.positions) {
        std::snprintf(number, sizeof number, " (%.9g, %.9g, %.9g)", static_cast<double>(p.x), static_cast<double>(p.y),
                      static_cast<double>(p.z));
        text += number;
    }
    text += ", triangles";
    for (std::uint32_t const i : mesh.indices) text += " " + std::to_string(i);
    return text;
}

inline Mesh tetrahedron() {
    return {{vec3(0.0F, 0.0F, 0.0F), vec3(1.0F, 0.0F, 0.0F), vec3(0.0F, 1.0F, 0.0F), vec3(0.0F, 0.0F, 1.0F)},
            {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}};
}

/// From -1 to 1, outward triangles.
inline Mesh cube() {
    Mesh mesh;
    for (unsigned i = 0; i < 8; ++i)
        mesh.positions.emplace_back((i & 1U) != 0 ? 1.0F : -1.0F, (i & 2U) != 0 ? 1.0F : -1.0F, (i & 4U) != 0 ? 1.0F : -1.0F);
    mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    return mesh;
}

/// A sphere of radius 1 from a cube's faces cut n x n, welded along the seams only by place.
inline Mesh sphere(std::uint32_t n) {
    Mesh const corners = cube();
    Mesh mesh;
    for (std::size_t face = 0; face < 6; ++face) {
        vec3 const a = corners.positions[corners.indices[6 * face]];
        vec3 const b = corners.positions[corners.indices[6 * face + 1]];
        vec3 const d = corners.positions[corners.indices[6 * face + 5]];
        auto const first = static_cast<std::uint32_t>(mesh.positions.size());
        for (std::uint32_t j = 0; j <= n; ++j)
            for (std::uint32_t i = 0; i <= n; ++i) {
                // Whole numbers until the end, so that both sides of a seam round alike.
                vec3 const p = a * static_cast<float>(n) + (b - a) * static_cast<float>(i) + (d - a) * static_cast<float>(j);
                float const x = p.x * p.x;
                float const y = p.y * p.y;
                float const z = p.z * p.z;
                double const length = std::sqrt(static_cast<double>(x) + static_cast<double>(y) + static_cast<double>(z));
                mesh.positions.push_back(gnomon::math::to_float(gnomon::math::to_double(p) / length));
            }
        for (std::uint32_t j = 0; j < n; ++j)
            for (std::uint32_t i = 0; i < n; ++i) {
                std::uint32_t const k = first + j * (n + 1) + i;
                mesh.add({k, k + 1, k + n + 2, k, k + n + 2, k + n + 1});
            }
    }
    return mesh;
}

/// n x n quads in the plane y = 0 with a bump, open all round.
inline Mesh sheet(std::uint32_t n) {
    Mesh mesh;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i) {
            float const x = static_cast<float>(i) / static_cast<float>(n) * 2.0F - 1.0F;
            float const z = static_cast<float>(j) / static_cast<float>(n) * 2.0F - 1.0F;
            mesh.positions.emplace_back(x, (1.0F - x * x) * (1.0F - z * z), z);
        }
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            std::uint32_t const k = j * (n + 1) + i;
            mesh.add({k, k + n + 1, k + 1, k + 1, k + n + 1, k + n + 2});
        }
    return mesh;
}

}  // namespace meshes
