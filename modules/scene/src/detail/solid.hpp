#pragma once
// Solids out of lofts: rings of points, joined one to the next and capped, so that every edge is used once each way.
//
// A ring runs counter-clockwise seen from where the loft goes. Solids may pierce one another (a branch in its trunk); each
// is closed by itself. Points are double until `add_solid` rounds them once, so shared points stay shared.

#include <gnomon/scene/scene.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::scene::detail {

struct Solid {
    std::vector<math::dvec3> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< Counter-clockwise from outside.
};

using Ring = std::vector<math::dvec3>;

/// What closes a loft.
enum class Ends : std::uint8_t {
    capped,       ///< Both end rings get a face; they are convex.
    open,         ///< Nothing: a pipe. For what only looks closed.
    capped_above, ///< Only the last ring gets a face: for what stands on something and has no bottom.
    loop,         ///< The last ring is joined to the first.
};

/// Joins the rings in order. All have the same number of points, but an end ring may be one point: the tip of a cone.
///
/// expects: two rings or more, neighbours not both of one point; no two neighbouring points at the same place.
void add_loft(Solid& out, std::span<Ring const> rings, Ends ends = Ends::capped);

/// A circle of `sides` points round `centre`, from `u` towards `v`; both are scaled by the radius.
[[nodiscard]] Ring circle(math::dvec3 const& centre, math::dvec3 const& u, math::dvec3 const& v, std::uint32_t sides);

/// A pipe along `line` with a radius per point; `sides` corners round it. A last radius of 0 gives a pointed end.
void add_tube(Solid& out, std::span<math::dvec3 const> line, std::span<double const> radii_m, std::uint32_t sides);

/// A level ring round an upright axis: radius and height.
struct Level {
    double radius_m;
    double y_m;
};

/// A turned piece round the y axis through `foot_m`; the first and the last radius may be 0.
void add_lathe(Solid& out, math::dvec3 const& foot_m, std::span<Level const> profile, std::uint32_t sides,
               Ends ends = Ends::capped);

/// A level rectangle: half sizes along x and z, and height.
struct Storey {
    double half_x_m;
    double half_z_m;
    double y_m;
};

/// Rectangles one over the other, joined: plinths, steps, mouldings, hipped roofs.
void add_stack(Solid& out, math::dvec3 const& foot_m, std::span<Storey const> storeys, Ends ends = Ends::capped);

void add_box(Solid& out, math::dvec3 const& lo, math::dvec3 const& hi, Ends ends = Ends::capped);

/// A round arch of rectangular section, standing along x with its front to +z.
struct Arch {
    math::dvec3 springing_m{0.0, 0.0, 0.0};  ///< Middle of the level where the curve starts, in the middle of the depth.
    double inner_m = 1.0;                    ///< Radius of the opening.
    double outer_m = 1.3;                    ///< Radius of the extrados.
    double depth_m = 0.5;
    std::uint32_t steps = 16;
};

void add_arch(Solid& out, Arch const& arch);

/// The wall round an arch: from the opening's curve up to a level top, `half_width_m` to both sides of the middle.
///
/// expects: half_width_m > inner_m, the top above springing + inner_m, steps a multiple of 4.
void add_spandrel(Solid& out, Arch const& arch, double half_width_m, double top_m);

/// A closed frame round a level rectangle: the section's points run counter-clockwise where out of the rectangle is to the
/// right and y is up; each says at what half sizes it goes round. `steps` quads along each side.
void add_frame(Solid& out, math::dvec3 const& middle_m, std::span<Storey const> section, std::uint32_t steps);

/// Where a part goes: x' = origin + x * right + y * up + z * back. The axes are as long as the part is scaled.
struct Placement {
    math::dvec3 origin{0.0, 0.0, 0.0};
    math::dvec3 right{1.0, 0.0, 0.0};
    math::dvec3 up{0.0, 1.0, 0.0};
    math::dvec3 back{0.0, 0.0, 1.0};
};

/// Turned about the vertical by `turns` (counter-clockwise seen from above), scaled, moved.
[[nodiscard]] Placement turned_by(double turns, math::dvec3 const& origin, double scale = 1.0) noexcept;

void add_placed(Solid& out, Solid const& part, Placement const& placement);

void add_placed_instance(Scene& scene, std::string name, std::uint32_t mesh, Placement const& placement);

/// Adds a solid to the mesh in primitives of at most `chunk_triangles`, with normals: faces that meet at an angle whose
/// cosine is at least `crease_cos` are smooth across their edge. 2 keeps every face flat.
void add_solid(Mesh& mesh, Solid const& solid, std::uint32_t material, double crease_cos = 0.75);

/// A mesh of one solid.
std::uint32_t add_solid_mesh(Scene& scene, std::string name, Solid const& solid, std::uint32_t material);

/// An object of one solid that stands where its points say.
void add_solid_object(Scene& scene, std::string const& name, Solid const& solid, std::uint32_t material);

}  // namespace gnomon::scene::detail
