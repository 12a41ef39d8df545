#pragma once
// What a mesh's edges say about it: closed, open, or joined where it should not be. Corners count as one where they have the
// same position, whatever their normals and primitives.

#include <gnomon/scene/scene.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace gnomon::test {

struct EdgeFacts {
    std::size_t edges = 0;
    std::size_t closed = 0;      ///< Used once each way.
    std::size_t open = 0;        ///< Used once.
    std::size_t degenerate = 0;  ///< Triangles that have two corners in one place, or no area.
};

namespace detail {

/// A number for each vertex of the mesh, primitive after primitive: the same where the positions are.
inline std::vector<std::uint32_t> place_ids(std::vector<math::vec3> const& positions) {
    std::vector<std::uint32_t> order(positions.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    auto const key = [&](std::uint32_t i) { return std::array<float, 3>{positions[i].x, positions[i].y, positions[i].z}; };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    std::vector<std::uint32_t> ids(positions.size());
    std::uint32_t id = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && key(order[i]) != key(order[i - 1])) ++id;
        ids[order[i]] = id;
    }
    return ids;
}

inline bool has_no_area(math::vec3 const& a, math::vec3 const& b, math::vec3 const& c) {
    math::dvec3 const normal =
        glm::cross(math::to_double(b) - math::to_double(a), math::to_double(c) - math::to_double(a));
    return !(glm::dot(normal, normal) > 0.0);
}

}  // namespace detail

/// Of the primitives whose material is opaque.
inline EdgeFacts edge_facts(scene::Scene const& scene, scene::Mesh const& mesh) {
    std::vector<math::vec3> positions;
    std::vector<std::uint32_t> corners;
    for (scene::Primitive const& p : mesh.primitives) {
        if (scene.materials[p.material].alpha_mode != scene::AlphaMode::opaque) continue;
        auto const base = static_cast<std::uint32_t>(positions.size());
        positions.insert(positions.end(), p.positions.begin(), p.positions.end());
        for (std::uint32_t index : p.indices) corners.push_back(base + index);
    }
    std::vector<std::uint32_t> const ids = detail::place_ids(positions);
    EdgeFacts facts;
    std::vector<std::array<std::uint32_t, 3>> edges;  // both ends, then which way
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        std::array<std::uint32_t, 3> const t{ids[corners[i]], ids[corners[i + 1]], ids[corners[i + 2]]};
        bool const flat = detail::has_no_area(positions[corners[i]], positions[corners[i + 1]], positions[corners[i + 2]]);
        facts.degenerate += flat || t[0] == t[1] || t[1] == t[2] || t[2] == t[0] ? 1U : 0U;
        for (std::size_t e = 0; e < 3; ++e) {
            std::uint32_t const a = t[e];
            std::uint32_t const b = t[(e + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), a < b ? 0U : 1U});
        }
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i;
        std::size_t forward = 0;
        for (; end < edges.size() && edges[end][0] == edges[i][0] && edges[end][1] == edges[i][1]; ++end)
            forward += edges[end][2] == 0 ? 1U : 0U;
        ++facts.edges;
        facts.closed += end - i == 2 && forward == 1 ? 1U : 0U;
        facts.open += end - i == 1 ? 1U : 0U;
        i = end;
    }
    return facts;
}

inline std::uint64_t fnv_of(std::uint64_t hash, void const* data, std::size_t size) {
    auto const* bytes = static_cast<unsigned char const*>(data);
    for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211U;
    return hash;
}

/// One number for all that is drawn: meshes, where they stand, images; lights and cameras too.
inline std::uint64_t fingerprint(scene::Scene const& scene) {
    std::uint64_t hash = 14695981039346656037U;
    auto const add = [&](auto const& values) { hash = fnv_of(hash, values.data(), values.size() * sizeof(values[0])); };
    for (scene::Mesh const& mesh : scene.meshes)
        for (scene::Primitive const& p : mesh.primitives) {
            add(p.positions);
            add(p.normals);
            add(p.uv0);
            add(p.indices);
        }
    for (scene::Instance const& i : scene.instances) hash = fnv_of(hash, &i.world_from_mesh, sizeof(i.world_from_mesh));
    for (scene::Image const& image : scene.images) add(image.rgba);
    for (scene::Light const& l : scene.lights) {
        hash = fnv_of(hash, &l.position_m, sizeof(l.position_m));
        hash = fnv_of(hash, &l.range_m, sizeof(l.range_m));
    }
    for (scene::Camera const& c : scene.cameras) {
        hash = fnv_of(hash, &c.eye_m, sizeof(c.eye_m));
        hash = fnv_of(hash, &c.back, sizeof(c.back));
    }
    return hash;
}

}  // namespace gnomon::test
