#pragma once
// The city that depth passes are compared on: a ground of 32 x 32 quads, 36 x 35 boxes of 5 faces, 8 to 78 m high. Only
// the faces' subdivision changes: 2x2, 4x5 or 8x10 quads give 52k, 254k or 1.01M triangles.

#include <gnomon/math/bounds.hpp>
#include <gnomon/math/view.hpp>

#include <cstdint>
#include <vector>

namespace bench {

namespace math = gnomon::math;

struct City {
    std::vector<math::vec3> positions;
    std::vector<std::uint32_t> indices;
    std::vector<math::Aabb> boxes;  ///< The buildings, in draw order after the ground.

    /// A grid of n x m quads on the parallelogram o, o + u, o + v.
    void add_face(math::vec3 o, math::vec3 u, math::vec3 v, int n, int m) {
        auto const first = static_cast<std::uint32_t>(positions.size());
        for (int j = 0; j <= m; ++j)
            for (int i = 0; i <= n; ++i)
                positions.push_back(o + u * (static_cast<float>(i) / static_cast<float>(n)) +
                                    v * (static_cast<float>(j) / static_cast<float>(m)));
        auto const row = static_cast<std::uint32_t>(n + 1);
        for (int j = 0; j < m; ++j)
            for (int i = 0; i < n; ++i) {
                std::uint32_t const a = first + static_cast<std::uint32_t>(j) * row + static_cast<std::uint32_t>(i);
                indices.insert(indices.end(), {a, a + 1, a + row, a + 1, a + row + 1, a + row});
            }
    }

    void add_box(math::vec3 lo, math::vec3 hi, int n, int m) {
        boxes.push_back({lo, hi});
        math::vec3 const d = hi - lo;
        math::vec3 const x(d.x, 0, 0);
        math::vec3 const y(0, d.y, 0);
        math::vec3 const z(0, 0, d.z);
        add_face(lo + y, z, x, n, m);
        add_face(lo, y, x, n, m);
        add_face(lo + z, x, y, n, m);
        add_face(lo, z, y, n, m);
        add_face(lo + x, y, z, n, m);
    }
};

/// `size` 0, 1, 2: 52k, 254k, 1.01M triangles.
inline City make_city(int size) {
    int const n = size == 0 ? 2 : size == 1 ? 4 : 8;
    int const m = size == 0 ? 2 : size == 1 ? 5 : 10;
    City city;
    city.add_face({-500, 0, -500}, {0, 0, 1000}, {1000, 0, 0}, 32, 32);
    std::uint64_t state = 12345;
    auto const random = [&] {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<float>(state >> 40U) * 0x1p-24F;
    };
    for (int j = 0; j < 35; ++j)
        for (int i = 0; i < 36; ++i) {
            float const pitch_x = 1000.0F / 36.0F;
            float const pitch_z = 1000.0F / 35.0F;
            math::vec3 const middle(-500.0F + (static_cast<float>(i) + 0.5F) * pitch_x, 0,
                                    -500.0F + (static_cast<float>(j) + 0.5F) * pitch_z);
            math::vec3 const half{6.0F + 4.0F * random(), 0.0F, 6.0F + 4.0F * random()};
            city.add_box(middle - half, middle + half + math::vec3(0, 8.0F + 70.0F * random(), 0), n, m);
        }
    return city;
}

/// The sun's view, fitted to the city's box, or the view along a street.
inline math::View make_view(bool ortho, int size_px) {
    if (!ortho)
        return math::make_perspective({.eye_m = {-222.2, 1.7, -414.3},
                                       .target_m = math::dvec3(-222.2 + 0.35, 1.7 + 0.06, -413.3),
                                       .near_m = 0.5,
                                       .far_m = 2000.0,
                                       .size_px = {size_px, size_px},
                                       .depth = math::Depth::forward})
            .value();
    math::View view;
    view = math::looking_along(view, math::dvec3(-0.45, -0.80, -0.40), math::dvec3(0, 1, 0));
    math::dvec3 lo(1e9);
    math::dvec3 hi(-1e9);
    for (int i = 0; i < 8; ++i) {
        math::dvec3 const p((i & 1) != 0 ? 500 : -500, (i & 2) != 0 ? 78 : 0, (i & 4) != 0 ? 500 : -500);
        math::dvec3 const q(glm::dot(view.right, p), glm::dot(view.up, p), -glm::dot(view.back, p));
        lo = glm::min(lo, q);
        hi = glm::max(hi, q);
    }
    view.window = {lo.x, hi.x, lo.y, hi.y};
    view.near_m = lo.z - 1.0;
    view.far_m = hi.z + 1.0;
    view.size_px = {size_px, size_px};
    view.lens = math::Lens::orthographic;
    view.depth = math::Depth::forward;
    return view;
}

}  // namespace bench
