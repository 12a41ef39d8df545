#pragma once
// Triangles and segments for the tests of trace, and slow exact answers that share no code with it.

#include <gnomon/math/vec.hpp>
#include <gnomon/predicates/triangle_list.hpp>
#include <gnomon/trace/segment.hpp>

#include "../../predicates/tests/exact_oracle.hpp"
#include "../../predicates/tests/hard_floats.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace scenes {

using gnomon::core::TriangleId;
using gnomon::math::uvec3;
using gnomon::math::vec3;
using gnomon::trace::Light;
using gnomon::trace::Segment;
using gnomon::trace::Triangle;
using hard::Random;

struct Mesh {
    std::vector<vec3> positions;
    std::vector<uvec3> corners;

    [[nodiscard]] gnomon::predicates::TriangleList list() const { return {positions, corners}; }
    void add(vec3 const& a, vec3 const& b, vec3 const& c) {
        auto const n = static_cast<std::uint32_t>(positions.size());
        positions.insert(positions.end(), {a, b, c});
        corners.emplace_back(n, n + 1, n + 2);
    }
};

/// A multiple of 1/step in [-range, range].
inline float dyadic(Random& random, int range, int step) {
    return static_cast<float>(random.below(2 * range * step + 1) - range * step) / static_cast<float>(step);
}

inline vec3 dyadic_point(Random& random, int range, int step) {
    return vec3{dyadic(random, range, step), dyadic(random, range, step), dyadic(random, range, step)};
}

/// Random triangles with corners on a grid of 1/64 m within 8 m: all arithmetic on them fits 113 bits.
inline Mesh soup(Random& random, std::size_t count) {
    Mesh mesh;
    for (std::size_t i = 0; i < count; ++i) {
        vec3 const a = dyadic_point(random, 8, 32);
        int const size = i % 5 == 0 ? 8 : 1;  // some large, many small
        mesh.add(a, a + dyadic_point(random, size, 32), a + dyadic_point(random, size, 32));
    }
    return mesh;
}

/// A watertight sheet of n x n quads of 1 m in x and z, with dyadic heights; every coordinate plus `offset` is exact.
inline Mesh sheet(Random& random, int n, float offset) {
    Mesh mesh;
    for (int z = 0; z <= n; ++z)
        for (int x = 0; x <= n; ++x)
            mesh.positions.emplace_back(static_cast<float>(x) + offset, dyadic(random, 1, 16) + offset,
                                        static_cast<float>(z) + offset);
    auto const stride = static_cast<std::uint32_t>(n + 1);
    for (std::uint32_t z = 0; z + 1 < stride; ++z)
        for (std::uint32_t x = 0; x + 1 < stride; ++x) {
            std::uint32_t const i = z * stride + x;
            mesh.corners.emplace_back(i, i + stride, i + 1);
            mesh.corners.emplace_back(i + 1, i + stride, i + stride + 1);
        }
    return mesh;
}

/// A plane of blocks like a city: ground quads and boxes of five faces, each face subdivided.
class Yard {
public:
    Mesh mesh;

    explicit Yard(int subdivision, int boxes = 32, std::uint64_t seed = 12345) {
        Random random{seed};
        float const half = 10.0F * static_cast<float>(boxes) + 10.0F;
        face(vec3(-half, 0.0F, -half), vec3(0.0F, 0.0F, 2.0F * half), vec3(2.0F * half, 0.0F, 0.0F), 3 * boxes);
        for (int j = 0; j < boxes; ++j)
            for (int i = 0; i < boxes; ++i) {
                vec3 const at{20.0F * static_cast<float>(i) - half + 12.0F + random.uniform(0.0F, 3.0F), 0.0F,
                              20.0F * static_cast<float>(j) - half + 12.0F + random.uniform(0.0F, 3.0F)};
                float const u = random.uniform(0.0F, 1.0F);
                box(at, vec3{random.uniform(8.0F, 13.0F), 1.0F + 59.0F * u * u * u, random.uniform(8.0F, 13.0F)},
                    subdivision);
            }
    }

private:
    void face(vec3 const& from, vec3 const& u, vec3 const& v, int n) {
        auto const first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i)
                mesh.positions.push_back(from + u * (static_cast<float>(i) / static_cast<float>(n)) +
                                         v * (static_cast<float>(j) / static_cast<float>(n)));
        auto const stride = static_cast<std::uint32_t>(n + 1);
        for (std::uint32_t j = 0; j + 1 < stride; ++j)
            for (std::uint32_t i = 0; i + 1 < stride; ++i) {
                std::uint32_t const k = first + j * stride + i;
                mesh.corners.emplace_back(k, k + 1, k + stride + 1);
                mesh.corners.emplace_back(k, k + stride + 1, k + stride);
            }
    }
    void box(vec3 const& at, vec3 const& size, int n) {
        vec3 const x(size.x, 0.0F, 0.0F);
        vec3 const y(0.0F, size.y, 0.0F);
        vec3 const z(0.0F, 0.0F, size.z);
        face(at + y, z, x, n);
        face(at, z, y, n);
        face(at + x, y, z, n);
        face(at, y, x, n);
        face(at + z, x, y, n);
    }
};

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Quad;
#else
typedef long double Quad;
#endif

/// Brute force in 113-bit arithmetic, exact for points on a grid: a difference of such floats has at most 25 bits here,
/// a product of three 75.
class QuadOracle {
public:
    explicit QuadOracle(Mesh const& mesh) {
        for (uvec3 const& at : mesh.corners) {
            Face f{{to_quad(mesh.positions[at.x]), to_quad(mesh.positions[at.y]), to_quad(mesh.positions[at.z])}, {}, 0};
            f.normal = cross(minus(f.p[1], f.p[0]), minus(f.p[2], f.p[0]));
            f.offset = dot(f.normal, f.p[0]);
            faces_.push_back(f);
        }
    }

    [[nodiscard]] bool is_blocked(Segment const& s, TriangleId own) const {
        Q3 const start = to_quad(s.start);
        Q3 const end = to_quad(s.end.xyz);
        Q3 const extent = s.end.at_infinity ? end : minus(end, start);
        for (std::size_t i = 0; i < faces_.size(); ++i)
            if (i != own.value && blocks(faces_[i], start, end, extent, s.end.at_infinity)) return true;
        return false;
    }

private:
    using Q3 = std::array<Quad, 3>;
    struct Face {
        Q3 p[3];
        Q3 normal;
        Quad offset;
    };

    static Q3 to_quad(vec3 const& p) { return {p.x, p.y, p.z}; }
    static Q3 minus(Q3 const& a, Q3 const& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
    static Q3 cross(Q3 const& a, Q3 const& b) {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }
    static Quad dot(Q3 const& a, Q3 const& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

    static bool blocks(Face const& f, Q3 const& start, Q3 const& end, Q3 const& extent, bool at_infinity) {
        Quad const here = dot(f.normal, start) - f.offset;
        if (here == 0) return false;
        Quad const there = at_infinity ? dot(f.normal, end) : dot(f.normal, end) - f.offset;
        if (!((here > 0 && there < 0) || (here < 0 && there > 0))) return false;
        bool plus = false;
        bool minus_seen = false;
        for (int i = 0; i < 3; ++i) {
            Quad const side = dot(extent, cross(minus(f.p[i], start), minus(f.p[(i + 1) % 3], start)));
            plus = plus || side > 0;
            minus_seen = minus_seen || side < 0;
        }
        return !(plus && minus_seen);
    }

    std::vector<Face> faces_;
};

inline oracle::Point to_point(vec3 const& p) { return {p.x, p.y, p.z}; }

/// Brute force in integers of any length: exact for all floats, and slow.
inline bool blocked_by_any(Mesh const& mesh, Segment const& s, TriangleId own) {
    for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
        uvec3 const& at = mesh.corners[i];
        std::array<oracle::Point, 3> const t{to_point(mesh.positions[at.x]), to_point(mesh.positions[at.y]),
                                             to_point(mesh.positions[at.z])};
        if (i != own.value && oracle::blocks(to_point(s.start), to_point(s.end.xyz), s.end.at_infinity, t)) return true;
    }
    return false;
}

/// Segments of all kinds for a mesh on a grid of 1/64: random, aimed at corners, edges, and inner points, ending in
/// planes, along axes, to lamps and suns.
inline Segment grid_segment(Random& random, Mesh const& mesh) {
    vec3 const a = dyadic_point(random, 12, 64);
    vec3 const b = dyadic_point(random, 12, 64);
    uvec3 const& at = mesh.corners[static_cast<std::size_t>(random.below(static_cast<int>(mesh.corners.size())))];
    vec3 const p = mesh.positions[at.x];
    vec3 const q = mesh.positions[at.y];
    vec3 const r = mesh.positions[at.z];
    vec3 d = dyadic_point(random, 6, 16);
    int const axes = random.below(6);  // sometimes along an axis or in an axis plane
    if (axes == 1 || axes == 2) d.x = axes == 1 ? 0.0F : -0.0F;
    if (axes == 2 || axes == 3) d.z = 0.0F;
    bool const sun = random.below(3) == 0;
    auto const through = [&](vec3 const& point) {
        float const back = static_cast<float>(1 + random.below(2));
        return Segment{point + d * back, sun ? Light::direction(-d) : Light::point(point - d)};
    };
    switch (random.below(7)) {
        case 0: return through(p);
        case 1: return through((p + q) * 0.5F);
        case 2: return through((p + q + r + r) * 0.25F);
        case 3: return {p, Light::point(b)};                    // starts at a corner
        case 4: return {a, Light::point(q)};                    // ends at one
        case 5: return {p + (q - p) * 2.0F, Light::point(p)};   // along an edge
        default: return {a, sun ? Light::direction(b) : Light::point(b)};
    }
}

}  // namespace scenes
