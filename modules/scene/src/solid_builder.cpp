#include "detail/solid_builder.hpp"

#include "detail/grid_mesh.hpp"

#include <cmath>

namespace gnomon::scene::detail {

namespace {

using math::dvec2;
using math::dvec3;

dvec3 polygon_normal(std::span<dvec3 const> corners) {
    dvec3 sum(0.0);
    for (std::size_t i = 2; i < corners.size(); ++i)
        sum += glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
    double const length = std::sqrt((sum.x * sum.x + sum.y * sum.y) + sum.z * sum.z);
    return length > 0.0 ? sum / length : dvec3(0.0, 1.0, 0.0);
}

dvec3 in_plane(Plane plane, dvec2 const& p, double along) noexcept {
    switch (plane) {
        case Plane::xy: return {p.x, p.y, along};
        case Plane::zy: return {-along, p.y, p.x};
        case Plane::xz: return {p.x, -along, p.y};
    }
    return {};
}

double corner_area(dvec2 const& a, dvec2 const& b, dvec2 const& c) noexcept {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

dvec3 on_ring(dvec3 const& middle, double radius, int i, int sides) noexcept {
    SinCos const t = sin_cos(static_cast<double>(i % sides) / sides);
    return middle + dvec3(radius * t.cos, 0.0, -radius * t.sin);
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<dvec2 const> polygon) {
    std::vector<std::uint32_t> left;
    for (std::uint32_t i = 0; i < polygon.size(); ++i) left.push_back(i);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    auto const is_ear = [&](std::size_t i) {
        std::size_t const n = left.size();
        std::array<std::uint32_t, 3> const ear{left[(i + n - 1) % n], left[i], left[(i + 1) % n]};
        dvec2 const a = polygon[ear[0]];
        dvec2 const b = polygon[ear[1]];
        dvec2 const c = polygon[ear[2]];
        if (!(corner_area(a, b, c) > 0.0)) return false;
        for (std::uint32_t const other : left) {
            if (other == ear[0] || other == ear[1] || other == ear[2]) continue;
            dvec2 const p = polygon[other];
            if (corner_area(a, b, p) >= 0.0 && corner_area(b, c, p) >= 0.0 && corner_area(c, a, p) >= 0.0) return false;
        }
        return true;
    };
    while (left.size() >= 3) {
        std::size_t ear = 0;
        while (ear + 1 < left.size() && !is_ear(ear)) ++ear;
        std::size_t const n = left.size();
        triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    return triangles;
}

void SolidBuilder::place(Stand const& stand) noexcept {
    stand_ = stand;
    turn_ = sin_cos(stand.turns);
}

dvec3 SolidBuilder::placed(dvec3 const& p) const noexcept {
    dvec3 const s = p * stand_.scale;
    return stand_.at + dvec3(s.x * turn_.cos + s.z * turn_.sin, s.y, s.z * turn_.cos - s.x * turn_.sin);
}

Primitive& SolidBuilder::room_for(std::size_t triangles, std::uint32_t material) {
    if (open_.size() <= material) open_.resize(material + 1, none);
    std::uint32_t& open = open_[material];
    if (open == none || mesh_.primitives[open].indices.size() / 3 + triangles > chunk_triangles) {
        open = static_cast<std::uint32_t>(mesh_.primitives.size());
        mesh_.primitives.emplace_back().material = material;
    }
    triangles_ += triangles;
    return mesh_.primitives[open];
}

void SolidBuilder::polygon(std::span<dvec3 const> corners, std::uint32_t material) {
    Primitive& out = room_for(corners.size() - 2, material);
    std::vector<dvec3> points;
    for (dvec3 const& corner : corners) points.push_back(placed(corner));
    math::vec3 const normal = math::to_float(polygon_normal(points));
    auto const base = static_cast<std::uint32_t>(out.positions.size());
    for (dvec3 const& point : points) {
        out.positions.push_back(math::to_float(point));
        out.normals.push_back(normal);
    }
    for (std::uint32_t i = 2; i < corners.size(); ++i)
        for (std::uint32_t const index : {base, base + i - 1, base + i}) out.indices.push_back(index);
}

void SolidBuilder::triangle(dvec3 const& a, dvec3 const& b, dvec3 const& c, std::uint32_t material) {
    polygon(std::array{a, b, c}, material);
}

void SolidBuilder::quad(dvec3 const& a, dvec3 const& b, dvec3 const& c, dvec3 const& d, std::uint32_t material) {
    polygon(std::array{a, b, c, d}, material);
}

void SolidBuilder::box(dvec3 const& lo, dvec3 const& hi, std::uint32_t material) { tapered_box(lo, hi, 1.0, material); }

void SolidBuilder::tapered_box(dvec3 const& lo, dvec3 const& hi, double taper, std::uint32_t material) {
    double const mid_x = (lo.x + hi.x) * 0.5;
    double const mid_z = (lo.z + hi.z) * 0.5;
    auto const corner = [&](bool right, bool top, bool near) {
        double const x = right ? hi.x : lo.x;
        double const z = near ? hi.z : lo.z;
        bool const narrow = top && taper != 1.0;
        return dvec3(narrow ? mid_x + (x - mid_x) * taper : x, top ? hi.y : lo.y, narrow ? mid_z + (z - mid_z) * taper : z);
    };
    std::array<dvec3, 8> c;
    for (unsigned i = 0; i < 8; ++i) c[i] = corner((i & 1U) != 0, (i & 2U) != 0, (i & 4U) != 0);
    quad(c[4], c[5], c[7], c[6], material);
    quad(c[5], c[1], c[3], c[7], material);
    quad(c[1], c[0], c[2], c[3], material);
    quad(c[0], c[4], c[6], c[2], material);
    quad(c[6], c[7], c[3], c[2], material);
    quad(c[0], c[1], c[5], c[4], material);
}

void SolidBuilder::prism(Plane plane, std::span<dvec2 const> profile, std::array<double, 2> from_to, std::uint32_t material) {
    for (std::size_t i = 0; i < profile.size(); ++i) {
        dvec2 const& a = profile[i];
        dvec2 const& b = profile[(i + 1) % profile.size()];
        quad(in_plane(plane, a, from_to[0]), in_plane(plane, b, from_to[0]), in_plane(plane, b, from_to[1]),
             in_plane(plane, a, from_to[1]), material);
    }
    caps(plane, profile, from_to, material);
}

void SolidBuilder::caps(Plane plane, std::span<dvec2 const> profile, std::array<double, 2> from_to, std::uint32_t material) {
    for (auto const& t : triangulate(profile)) {
        triangle(in_plane(plane, profile[t[0]], from_to[1]), in_plane(plane, profile[t[1]], from_to[1]),
                 in_plane(plane, profile[t[2]], from_to[1]), material);
        triangle(in_plane(plane, profile[t[0]], from_to[0]), in_plane(plane, profile[t[2]], from_to[0]),
                 in_plane(plane, profile[t[1]], from_to[0]), material);
    }
}

void SolidBuilder::lathe(dvec3 const& base, std::span<Outline const> outline, int sides, std::uint32_t material) {
    auto const at = [&](std::size_t row, int i) {
        return on_ring(base + dvec3(0.0, outline[row].height, 0.0), outline[row].radius, i, sides);
    };
    for (std::size_t row = 0; row + 1 < outline.size(); ++row)
        for (int i = 0; i < sides; ++i) {
            if (outline[row].radius == 0.0)
                triangle(at(row, 0), at(row + 1, i + 1), at(row + 1, i), material);
            else if (outline[row + 1].radius == 0.0)
                triangle(at(row, i), at(row, i + 1), at(row + 1, 0), material);
            else
                quad(at(row, i), at(row, i + 1), at(row + 1, i + 1), at(row + 1, i), material);
        }
    std::vector<dvec3> cap;
    std::size_t const last = outline.size() - 1;
    for (int i = 0; i < sides; ++i) cap.push_back(at(last, i));
    if (outline[last].radius > 0.0) polygon(cap, material);
    for (int i = 0; i < sides; ++i) cap[static_cast<std::size_t>(i)] = at(0, sides - i);
    if (outline[0].radius > 0.0) polygon(cap, material);
}

void SolidBuilder::tube(Tube const& t, std::uint32_t material) {
    dvec3 const along = glm::normalize(t.b - t.a);
    dvec3 const side = std::abs(along.y) < 0.9 ? dvec3(0.0, 1.0, 0.0) : dvec3(1.0, 0.0, 0.0);
    dvec3 const u = glm::normalize(glm::cross(side, along));
    dvec3 const v = glm::cross(along, u);
    auto const ring = [&](dvec3 const& middle, double radius, int i) {
        SinCos const s = sin_cos(static_cast<double>(i % t.sides) / t.sides);
        return middle + u * (radius * s.cos) + v * (radius * s.sin);
    };
    std::vector<dvec3> cap_a;
    std::vector<dvec3> cap_b;
    for (int i = 0; i < t.sides; ++i) {
        dvec3 const a0 = ring(t.a, t.radius_a, i);
        dvec3 const a1 = ring(t.a, t.radius_a, i + 1);
        cap_a.push_back(ring(t.a, t.radius_a, t.sides - i));
        cap_b.push_back(ring(t.b, t.radius_b, i));
        if (t.radius_b == 0.0)
            triangle(a0, a1, t.b, material);
        else
            quad(a0, a1, ring(t.b, t.radius_b, i + 1), ring(t.b, t.radius_b, i), material);
    }
    polygon(cap_a, material);
    if (t.radius_b > 0.0) polygon(cap_b, material);
}

void SolidBuilder::ball(dvec3 const& middle, double radius, int rings, std::uint32_t material) {
    std::vector<Outline> outline{{0.0, -radius}};
    for (int i = 1; i <= rings; ++i) {
        SinCos const t = sin_cos(0.5 * i / (rings + 1) - 0.25);
        outline.push_back({radius * t.cos, radius * t.sin});
    }
    outline.push_back({0.0, radius});
    lathe(middle, outline, 2 * rings + 2, material);
}

Mesh SolidBuilder::take() {
    Mesh mesh = std::move(mesh_);
    *this = SolidBuilder();
    return mesh;
}

Instance placed_instance(std::string name, std::uint32_t mesh, Stand const& stand) {
    Instance instance;
    instance.name = std::move(name);
    instance.mesh = mesh;
    SinCos const t = sin_cos(stand.turns);
    math::dmat4& m = instance.world_from_mesh;
    m[0][0] = t.cos * stand.scale;
    m[0][2] = -t.sin * stand.scale;
    m[1][1] = stand.scale;
    m[2][0] = t.sin * stand.scale;
    m[2][2] = t.cos * stand.scale;
    for (math::axis_t axis = 0; axis < 3; ++axis) m[3][axis] = stand.at[axis];
    return instance;
}

}  // namespace gnomon::scene::detail
