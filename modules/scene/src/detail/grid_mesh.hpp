#pragma once
// Boxes and planes out of quads, on one lattice: faces that meet share their borders to the last bit, without T-junctions.

#include <gnomon/scene/scene.hpp>

#include <algorithm>
#include <cstdint>

namespace gnomon::scene::detail {

/// An object is at most about this many triangles, or is split into primitives that are.
inline constexpr std::uint32_t chunk_triangles = 512;

/// A lattice over [lo, hi] with `cells` cells per axis.
struct Lattice {
    math::ivec3 cells{1, 1, 1};
    math::dvec3 lo{-0.5, 0.0, -0.5};
    math::dvec3 hi{0.5, 1.0, 0.5};
};

/// The lattice point's position, rounded once, by one formula whatever face asks.
inline math::vec3 at(Lattice const& lattice, math::ivec3 const& point) noexcept {
    math::dvec3 p;
    for (int axis = 0; axis < 3; ++axis) {
        double const t = static_cast<double>(point[axis]) / lattice.cells[axis];
        p[axis] = point[axis] == lattice.cells[axis] ? lattice.hi[axis]
                                                     : lattice.lo[axis] + (lattice.hi[axis] - lattice.lo[axis]) * t;
    }
    return math::to_float(p);
}

/// A rectangle of lattice points: `start`, then `columns` steps of `along` and `rows` steps of `across`.
/// Its front is on the side of along x across.
struct Face {
    math::ivec3 start;
    math::ivec3 along;
    math::ivec3 across;
    int columns;
    int rows;
    math::vec3 normal;
};

inline void add_rows(Primitive& out, Lattice const& lattice, Face const& face, int first_row, int rows) {
    auto const base = static_cast<std::uint32_t>(out.positions.size());
    auto const stride = static_cast<std::uint32_t>(face.columns + 1);
    for (int row = first_row; row <= first_row + rows; ++row)
        for (int column = 0; column <= face.columns; ++column) {
            out.positions.push_back(at(lattice, face.start + face.along * column + face.across * row));
            out.normals.push_back(face.normal);
        }
    for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row)
        for (std::uint32_t column = 0; column + 1 < stride; ++column) {
            std::uint32_t const a = base + row * stride + column;
            for (std::uint32_t index : {a, a + 1, a + 1 + stride, a, a + 1 + stride, a + stride})
                out.indices.push_back(index);
        }
}

/// Appends the face to the mesh's last primitive, and starts new ones of the same material where that grows too large.
inline void add_face(Mesh& mesh, Lattice const& lattice, Face const& face, std::uint32_t material) {
    auto const row_triangles = static_cast<std::uint32_t>(face.columns) * 2;
    int row = 0;
    while (row < face.rows) {
        bool const fits = !mesh.primitives.empty() && mesh.primitives.back().material == material &&
                          mesh.primitives.back().indices.size() / 3 + row_triangles <= chunk_triangles;
        if (!fits) mesh.primitives.emplace_back().material = material;
        Primitive& out = mesh.primitives.back();
        auto const room = (chunk_triangles - static_cast<std::uint32_t>(out.indices.size() / 3)) / row_triangles;
        int const rows = std::min(face.rows - row, std::max(1, static_cast<int>(room)));
        add_rows(out, lattice, face, row, rows);
        row += rows;
    }
}

/// The four walls of a box, then, with another material, its top and, if asked for, its bottom.
inline Mesh box_mesh(Lattice const& lattice, std::uint32_t walls, std::uint32_t top, bool closed) {
    int const x = lattice.cells.x;
    int const y = lattice.cells.y;
    int const z = lattice.cells.z;
    Mesh mesh;
    add_face(mesh, lattice, {{0, 0, z}, {1, 0, 0}, {0, 1, 0}, x, y, {0.0F, 0.0F, 1.0F}}, walls);
    add_face(mesh, lattice, {{x, 0, z}, {0, 0, -1}, {0, 1, 0}, z, y, {1.0F, 0.0F, 0.0F}}, walls);
    add_face(mesh, lattice, {{x, 0, 0}, {-1, 0, 0}, {0, 1, 0}, x, y, {0.0F, 0.0F, -1.0F}}, walls);
    add_face(mesh, lattice, {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, z, y, {-1.0F, 0.0F, 0.0F}}, walls);
    add_face(mesh, lattice, {{0, y, z}, {1, 0, 0}, {0, 0, -1}, x, z, {0.0F, 1.0F, 0.0F}}, top);
    if (closed) add_face(mesh, lattice, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, x, z, {0.0F, -1.0F, 0.0F}}, walls);
    return mesh;
}

/// A horizontal rectangle at y = lo.y that faces up.
inline Mesh plane_mesh(Lattice const& lattice, std::uint32_t material) {
    Mesh mesh;
    auto const x = lattice.cells.x;
    auto const z = lattice.cells.z;
    add_face(mesh, lattice, {{0, 0, z}, {1, 0, 0}, {0, 0, -1}, x, z, {0.0F, 1.0F, 0.0F}}, material);
    return mesh;
}

}  // namespace gnomon::scene::detail
