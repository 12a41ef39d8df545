#pragma once
// Triangles for the tests and benchmarks of batch: soups, sheets, a town of boxes.

#include <gnomon/batch/batches.hpp>
#include <gnomon/math/vec.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace shapes {

using gnomon::math::vec3;

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
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(bits() % n); }
    float uniform(float lo, float hi) {
        return lo + (hi - lo) * static_cast<float>(static_cast<double>(bits() >> 40U) * 0x1p-24);
    }
    vec3 point(float lo, float hi) {
        float const x = uniform(lo, hi);
        float const y = uniform(lo, hi);
        return vec3(x, y, uniform(lo, hi));
    }
};

struct Mesh {
    std::vector<vec3> positions;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> groups;

    [[nodiscard]] gnomon::batch::Triangles list() const { return {positions, indices, groups}; }
    void add(vec3 const& a, vec3 const& b, vec3 const& c, std::uint32_t group = 0) {
        auto const n = static_cast<std::uint32_t>(positions.size());
        positions.insert(positions.end(), {a, b, c});
        indices.insert(indices.end(), {n, n + 1, n + 2});
        groups.push_back(group);
    }
};

/// How a property test prints one.
[[nodiscard]] inline std::string check_string(Mesh const& mesh) {
    std::string text;
    char corner[96];
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        vec3 const& p = mesh.positions[mesh.indices[i]];
        std::snprintf(corner, sizeof corner, "%s(%.9g, %.9g, %.9g)", i % 3 == 0 ? "\n  " : " ", static_cast<double>(p.x),
                      static_cast<double>(p.y), static_cast<double>(p.z));
        text += corner;
        if (i % 3 == 2) text += " of group " + std::to_string(mesh.groups[i / 3]);
    }
    return text;
}

/// Small triangles anywhere in a cube of 100 m.
inline Mesh soup(std::size_t count, std::uint64_t seed = 1) {
    Random random{seed};
    Mesh mesh;
    for (std::size_t i = 0; i < count; ++i) {
        vec3 const a = random.point(-50.0F, 50.0F);
        vec3 const b = a + random.point(-1.0F, 1.0F);
        vec3 const c = a + random.point(-1.0F, 1.0F);
        mesh.add(a, b, c, random.below(2));
    }
    return mesh;
}

/// n x n quads of u and v from `from`, shared vertices.
inline void add_face(Mesh& mesh, vec3 const& from, vec3 const& u, vec3 const& v, std::uint32_t n) {
    auto const first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i)
            mesh.positions.push_back(from + u * (static_cast<float>(i) / static_cast<float>(n)) +
                                     v * (static_cast<float>(j) / static_cast<float>(n)));
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            std::uint32_t const k = first + j * (n + 1) + i;
            mesh.indices.insert(mesh.indices.end(), {k, k + 1, k + n + 2, k, k + n + 2, k + n + 1});
            mesh.groups.insert(mesh.groups.end(), 2, 0);
        }
}

/// 64 houses of five faces on a field, all in one group: about `triangles` triangles of many sizes.
inline Mesh town(std::size_t triangles) {
    Random random{12345};
    Mesh mesh;
    auto const n = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / (2.0 * (64.0 * 5.0 + 64.0))) + 0.5);
    std::uint32_t const cuts = n > 0 ? n : 1;
    add_face(mesh, vec3(-100.0F, 0.0F, -100.0F), vec3(0.0F, 0.0F, 200.0F), vec3(200.0F, 0.0F, 0.0F), 8 * cuts);
    for (std::uint32_t house = 0; house < 64; ++house) {
        vec3 const at{25.0F * static_cast<float>(house % 8) - 90.0F + random.uniform(0.0F, 3.0F), 0.0F,
                      25.0F * static_cast<float>(house / 8) - 90.0F + random.uniform(0.0F, 3.0F)};
        vec3 const x(random.uniform(8.0F, 13.0F), 0.0F, 0.0F);
        vec3 const y(0.0F, random.uniform(4.0F, 40.0F), 0.0F);
        vec3 const z(0.0F, 0.0F, random.uniform(8.0F, 13.0F));
        add_face(mesh, at + y, z, x, cuts);
        add_face(mesh, at, z, y, cuts);
        add_face(mesh, at + x, y, z, cuts);
        add_face(mesh, at, y, x, cuts);
        add_face(mesh, at + z, x, y, cuts);
    }
    return mesh;
}

/// A heap of needles that all cross: no box tells anything.
inline Mesh needles(std::size_t count) {
    Random random{7};
    Mesh mesh;
    for (std::size_t i = 0; i < count; ++i) {
        vec3 const a = random.point(-50.0F, 50.0F);
        mesh.add(a, a * -1.0F, a + random.point(0.0F, 0.01F));
    }
    return mesh;
}

}  // namespace shapes
