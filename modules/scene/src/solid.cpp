#include "detail/solid.hpp"

#include "detail/generators.hpp"
#include "detail/grid_mesh.hpp"
#include "detail/turn.hpp"

#include <gnomon/core/contract.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;
using Triangle = std::array<std::uint32_t, 3>;

/// Where each ring of a loft starts in the solid's points.
struct Placed {
    std::uint32_t first;
    std::uint32_t count;
};

/// The band between two rings of the same size, or between a ring and a tip.
void add_band(Solid& out, Placed low, Placed high) {
    std::uint32_t const count = std::max(low.count, high.count);
    for (std::uint32_t j = 0; j < count; ++j) {
        std::uint32_t const next = (j + 1) % count;
        if (high.count == 1)
            out.triangles.push_back({low.first + j, low.first + next, high.first});
        else if (low.count == 1)
            out.triangles.push_back({low.first, high.first + next, high.first + j});
        else {
            out.triangles.push_back({low.first + j, low.first + next, high.first + next});
            out.triangles.push_back({low.first + j, high.first + next, high.first + j});
        }
    }
}

void add_cap(Solid& out, Placed ring, bool faces_forward) {
    for (std::uint32_t j = 1; j + 1 < ring.count; ++j) {
        std::uint32_t const b = ring.first + j;
        out.triangles.push_back(faces_forward ? Triangle{ring.first, b, b + 1} : Triangle{ring.first, b + 1, b});
    }
}

/// Some direction across `d`.
dvec3 across(dvec3 const& d) noexcept {
    dvec3 const aside = std::abs(d.y) < 0.9 * glm::length(d) ? dvec3(0.0, 1.0, 0.0) : dvec3(1.0, 0.0, 0.0);
    return glm::normalize(glm::cross(aside, d));
}

}  // namespace

void add_loft(Solid& out, std::span<Ring const> rings, Ends ends) {
    GNOMON_EXPECT(rings.size() >= 2);
    std::vector<Placed> placed;
    for (Ring const& ring : rings) {
        placed.push_back({static_cast<std::uint32_t>(out.points.size()), static_cast<std::uint32_t>(ring.size())});
        out.points.insert(out.points.end(), ring.begin(), ring.end());
    }
    if (ends == Ends::capped) add_cap(out, placed.front(), false);
    for (std::size_t i = 0; i + 1 < placed.size(); ++i) add_band(out, placed[i], placed[i + 1]);
    if (ends == Ends::loop) add_band(out, placed.back(), placed.front());
    if (ends == Ends::capped || ends == Ends::capped_above) add_cap(out, placed.back(), true);
}

Ring circle(dvec3 const& centre, dvec3 const& u, dvec3 const& v, std::uint32_t sides) {
    Ring ring;
    for (std::uint32_t j = 0; j < sides; ++j) {
        SinCos const a = sin_cos(static_cast<double>(j) / sides);
        ring.push_back(centre + u * a.cos + v * a.sin);
    }
    return ring;
}

void add_tube(Solid& out, std::span<dvec3 const> line, std::span<double const> radii_m, std::uint32_t sides) {
    GNOMON_EXPECT(line.size() >= 2 && line.size() == radii_m.size());
    std::vector<Ring> rings;
    dvec3 u = across(line[1] - line[0]);
    for (std::size_t i = 0; i < line.size(); ++i) {
        std::size_t const before = i == 0 ? 0 : i - 1;
        std::size_t const after = i + 1 == line.size() ? i : i + 1;
        dvec3 const forward = glm::normalize(line[after] - line[before]);
        u = glm::normalize(u - forward * glm::dot(u, forward));  // carried along, so that the pipe does not twist
        dvec3 const v = glm::cross(forward, u);
        rings.push_back(radii_m[i] == 0.0 ? Ring{line[i]} : circle(line[i], u * radii_m[i], v * radii_m[i], sides));
    }
    add_loft(out, rings);
}

void add_lathe(Solid& out, dvec3 const& foot_m, std::span<Level const> profile, std::uint32_t sides, Ends ends) {
    std::vector<Ring> rings;
    for (Level const& level : profile) {
        dvec3 const centre = foot_m + dvec3(0.0, level.y_m, 0.0);
        rings.push_back(level.radius_m == 0.0 ? Ring{centre}
                                              : circle(centre, dvec3(level.radius_m, 0.0, 0.0),
                                                       dvec3(0.0, 0.0, -level.radius_m), sides));
    }
    add_loft(out, rings, ends);
}

void add_stack(Solid& out, dvec3 const& foot_m, std::span<Storey const> storeys, Ends ends) {
    std::vector<Ring> rings;
    for (Storey const& s : storeys)
        rings.push_back({foot_m + dvec3(s.half_x_m, s.y_m, s.half_z_m), foot_m + dvec3(s.half_x_m, s.y_m, -s.half_z_m),
                         foot_m + dvec3(-s.half_x_m, s.y_m, -s.half_z_m), foot_m + dvec3(-s.half_x_m, s.y_m, s.half_z_m)});
    add_loft(out, rings, ends);
}

void add_box(Solid& out, dvec3 const& lo, dvec3 const& hi, Ends ends) {
    dvec3 const half = (hi - lo) * 0.5;
    dvec3 const foot(lo.x + half.x, lo.y, lo.z + half.z);
    std::array<Storey, 2> const storeys{{{half.x, half.z, 0.0}, {half.x, half.z, hi.y - lo.y}}};
    add_stack(out, foot, storeys, ends);
}

void add_arch(Solid& out, Arch const& arch) {
    std::vector<Ring> rings;
    for (std::uint32_t i = 0; i <= arch.steps; ++i) {
        SinCos const a = sin_cos(0.5 * i / arch.steps);  // from the right foot over the top to the left one
        dvec3 const spoke(a.cos, a.sin, 0.0);
        dvec3 const half(0.0, 0.0, arch.depth_m * 0.5);
        dvec3 const inner = arch.springing_m + spoke * arch.inner_m;
        dvec3 const outer = arch.springing_m + spoke * arch.outer_m;
        rings.push_back({inner + half, outer + half, outer - half, inner - half});
    }
    add_loft(out, rings);
}

void add_spandrel(Solid& out, Arch const& arch, double half_width_m, double top_m) {
    GNOMON_EXPECT(arch.steps % 4 == 0);
    double const height_m = top_m - arch.springing_m.y;
    std::vector<Ring> rings;
    for (std::uint32_t i = 0; i <= arch.steps; ++i) {
        SinCos const a = sin_cos(0.5 * i / arch.steps);
        dvec3 const half(0.0, 0.0, arch.depth_m * 0.5);
        dvec3 const low = arch.springing_m + dvec3(a.cos, a.sin, 0.0) * arch.inner_m;
        // A quarter of the steps up the right side, two over the top, one down the left side.
        double const way = 4.0 * i / arch.steps;
        double const x = way <= 1.0 ? 1.0 : way >= 3.0 ? -1.0 : 2.0 - way;
        double const y = way <= 1.0 ? way : way >= 3.0 ? 4.0 - way : 1.0;
        dvec3 const high = arch.springing_m + dvec3(x * half_width_m, y * height_m, 0.0);
        rings.push_back({low + half, high + half, high - half, low - half});
    }
    add_loft(out, rings);
}

void add_frame(Solid& out, dvec3 const& middle_m, std::span<Storey const> section, std::uint32_t steps) {
    constexpr std::array<math::ivec2, 4> corners{{{1, 1}, {1, -1}, {-1, -1}, {-1, 1}}};
    std::vector<Ring> rings;
    for (std::size_t side = 0; side < 4; ++side)
        for (std::uint32_t i = 0; i < steps; ++i) {
            double const t = static_cast<double>(i) / steps;
            math::ivec2 const from = corners[side];
            math::ivec2 const to = corners[(side + 1) % 4];
            double const x = from.x + (to.x - from.x) * t;
            double const z = from.y + (to.y - from.y) * t;
            Ring ring;
            for (std::size_t k = section.size(); k-- > 0;)
                ring.push_back(middle_m + dvec3(x * section[k].half_x_m, section[k].y_m, z * section[k].half_z_m));
            rings.push_back(std::move(ring));
        }
    add_loft(out, rings, Ends::loop);
}

Placement turned_by(double turns, dvec3 const& origin, double scale) noexcept {
    SinCos const a = sin_cos(turns);
    return {origin, dvec3(a.cos, 0.0, -a.sin) * scale, dvec3(0.0, scale, 0.0), dvec3(a.sin, 0.0, a.cos) * scale};
}

void add_placed(Solid& out, Solid const& part, Placement const& placement) {
    auto const base = static_cast<std::uint32_t>(out.points.size());
    for (dvec3 const& p : part.points)
        out.points.push_back(((placement.origin + placement.right * p.x) + placement.up * p.y) + placement.back * p.z);
    for (Triangle const& t : part.triangles) out.triangles.push_back({base + t[0], base + t[1], base + t[2]});
}

void add_placed_instance(Scene& scene, std::string name, std::uint32_t mesh, Placement const& placement) {
    Instance instance;
    instance.name = std::move(name);
    instance.mesh = mesh;
    std::array<dvec3, 4> const columns{placement.right, placement.up, placement.back, placement.origin};
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row) instance.world_from_mesh[column][row] = columns[static_cast<std::size_t>(column)][row];
    scene.instances.push_back(std::move(instance));
}

namespace {

/// Which triangles use each point.
struct Fans {
    std::vector<std::uint32_t> first;  ///< One more than points.
    std::vector<std::uint32_t> triangles;
};

Fans fans_of(Solid const& solid) {
    Fans fans;
    fans.first.assign(solid.points.size() + 1, 0);
    for (Triangle const& t : solid.triangles)
        for (std::uint32_t point : t) ++fans.first[point + 1];
    for (std::size_t i = 1; i < fans.first.size(); ++i) fans.first[i] += fans.first[i - 1];
    fans.triangles.resize(solid.triangles.size() * 3);
    std::vector<std::uint32_t> next(fans.first.begin(), fans.first.end() - 1);
    for (std::uint32_t i = 0; i < solid.triangles.size(); ++i)
        for (std::uint32_t point : solid.triangles[i]) fans.triangles[next[point]++] = i;
    return fans;
}

/// The faces' normals, as long as twice their areas.
std::vector<dvec3> face_normals(Solid const& solid) {
    std::vector<dvec3> normals;
    for (Triangle const& t : solid.triangles)
        normals.push_back(glm::cross(solid.points[t[1]] - solid.points[t[0]], solid.points[t[2]] - solid.points[t[0]]));
    return normals;
}

dvec3 unit_or_up(dvec3 const& v) noexcept {
    double const length = glm::length(v);
    return length > 0.0 ? v / length : dvec3(0.0, 1.0, 0.0);
}

/// Gives a primitive a vertex for each point and normal that comes up, once.
class VertexPool {
public:
    explicit VertexPool(Solid const& solid) : solid_(solid), newest_(solid.points.size(), none) {}

    std::uint32_t index_of(Primitive& out, std::uint32_t point, math::vec3 const& normal) {
        for (std::uint32_t v = newest_[point]; v != none; v = older_[v])
            if (out.normals[v] == normal) return v;
        auto const made = static_cast<std::uint32_t>(out.positions.size());
        out.positions.push_back(math::to_float(solid_.points[point]));
        out.normals.push_back(normal);
        older_.resize(made + 1, none);
        older_[made] = newest_[point];
        newest_[point] = made;
        used_.push_back(point);
        return made;
    }

    /// To be called before another primitive is filled.
    void forget() {
        for (std::uint32_t point : used_) newest_[point] = none;
        used_.clear();
    }

private:
    Solid const& solid_;
    std::vector<std::uint32_t> newest_;
    std::vector<std::uint32_t> older_;
    std::vector<std::uint32_t> used_;
};

}  // namespace

void add_solid(Mesh& mesh, Solid const& solid, std::uint32_t material, double crease_cos) {
    Fans const fans = fans_of(solid);
    std::vector<dvec3> const normals = face_normals(solid);
    std::vector<dvec3> units;
    for (dvec3 const& n : normals) units.push_back(unit_or_up(n));
    VertexPool pool(solid);
    bool const joins = !mesh.primitives.empty() && mesh.primitives.back().material == material &&
                       mesh.primitives.back().indices.size() / 3 + solid.triangles.size() <= chunk_triangles;
    if (!joins) mesh.primitives.emplace_back().material = material;
    for (std::uint32_t i = 0; i < solid.triangles.size(); ++i) {
        if (mesh.primitives.back().indices.size() == 3 * std::size_t{chunk_triangles}) {
            mesh.primitives.emplace_back().material = material;
            pool.forget();
        }
        Primitive& out = mesh.primitives.back();
        for (std::uint32_t const point : solid.triangles[i]) {
            dvec3 sum(0.0);
            for (std::uint32_t k = fans.first[point]; k < fans.first[point + 1]; ++k)
                if (std::uint32_t const other = fans.triangles[k]; other == i || glm::dot(units[other], units[i]) >= crease_cos)
                    sum += normals[other];
            out.indices.push_back(pool.index_of(out, point, math::to_float(unit_or_up(sum))));
        }
    }
}

std::uint32_t add_solid_mesh(Scene& scene, std::string name, Solid const& solid, std::uint32_t material) {
    Mesh mesh;
    add_solid(mesh, solid, material);
    return add_mesh(scene, std::move(name), std::move(mesh));
}

void add_solid_object(Scene& scene, std::string const& name, Solid const& solid, std::uint32_t material) {
    add_instance(scene, name, add_solid_mesh(scene, name, solid, material), dvec3(1.0), dvec3(0.0));
}

}  // namespace gnomon::scene::detail
