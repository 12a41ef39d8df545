#pragma once
// Whether meshes are closed, and hashes of scenes: shared by the tests of the procedural scenes.

#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/scene.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::scene::solidity {

/// Edges, as pairs of positions, that are not used exactly once each way. Degenerate triangles count as well.
inline std::uint64_t open_edges(Mesh const& mesh) {
    struct Use {
        std::array<float, 6> ends;
        bool forward;
    };
    std::vector<Use> uses;
    std::uint64_t bad = 0;
    for (Primitive const& p : mesh.primitives)
        for (std::size_t i = 0; i < p.indices.size(); i += 3)
            for (std::size_t e = 0; e < 3; ++e) {
                math::vec3 const a = p.positions[p.indices[i + e]];
                math::vec3 const b = p.positions[p.indices[i + (e + 1) % 3]];
                std::array<float, 3> const ka{a.x, a.y, a.z};
                std::array<float, 3> const kb{b.x, b.y, b.z};
                bad += ka == kb ? 1U : 0U;
                bool const forward = ka < kb;
                auto const& lo = forward ? ka : kb;
                auto const& hi = forward ? kb : ka;
                uses.push_back({{lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]}, forward});
            }
    std::sort(uses.begin(), uses.end(), [](Use const& a, Use const& b) { return a.ends < b.ends; });
    for (std::size_t i = 0; i < uses.size();) {
        std::size_t end = i;
        std::array<std::size_t, 2> count{};
        for (; end < uses.size() && uses[end].ends == uses[i].ends; ++end) ++count[uses[end].forward ? 1 : 0];
        bad += count == std::array<std::size_t, 2>{1, 1} ? 0U : 1U;
        i = end;
    }
    return bad;
}

/// Six times the volume that a closed mesh encloses: above 0 where its fronts face outward.
inline double signed_volume(Mesh const& mesh) {
    double sum = 0.0;
    for (Primitive const& p : mesh.primitives)
        for (std::size_t i = 0; i < p.indices.size(); i += 3) {
            math::dvec3 const a = math::to_double(p.positions[p.indices[i]]);
            math::dvec3 const b = math::to_double(p.positions[p.indices[i + 1]]);
            math::dvec3 const c = math::to_double(p.positions[p.indices[i + 2]]);
            sum += glm::dot(a, glm::cross(b, c));
        }
    return sum;
}

inline std::uint64_t fnv(std::uint64_t hash, void const* data, std::size_t size) {
    auto const* bytes = static_cast<unsigned char const*>(data);
    for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211U;
    return hash;
}

/// Of the positions, normals and indices at rest, of all keys, and of all lights' places and ranges.
inline std::uint64_t hash_of(Scene const& scene) {
    Geometry const g = flatten(scene);
    std::uint64_t hash = 14695981039346656037U;
    hash = fnv(hash, g.positions.data(), g.positions.size() * sizeof(g.positions[0]));
    hash = fnv(hash, g.normals.data(), g.normals.size() * sizeof(g.normals[0]));
    hash = fnv(hash, g.indices.data(), g.indices.size() * sizeof(g.indices[0]));
    for (Animation const& clip : scene.animations)
        for (AnimationChannel const& channel : clip.channels) {
            hash = fnv(hash, channel.times_s.data(), channel.times_s.size() * sizeof(float));
            hash = fnv(hash, channel.values.data(), channel.values.size() * sizeof(float));
        }
    for (Light const& light : scene.lights) {
        hash = fnv(hash, &light.position_m, sizeof(light.position_m));
        hash = fnv(hash, &light.range_m, sizeof(light.range_m));
    }
    return hash;
}

}  // namespace gnomon::scene::solidity
