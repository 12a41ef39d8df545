#pragma once
// Closed solids out of flat polygons: boxes, prisms, turned shapes, tapered tubes. Neighbouring polygons compute a shared
// corner by the same operations on the same numbers, so that it is the same float in both and every edge is used once each
// way. Solids of one mesh overlap a little rather than touch, so that none of their edges coincide.

#include "pcg32.hpp"
#include "turn.hpp"

#include <gnomon/scene/scene.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::scene::detail {

/// Where the solids that follow stand: scaled, turned about the vertical axis, then moved.
struct Stand {
    math::dvec3 at{0.0, 0.0, 0.0};
    double turns = 0.0;
    double scale = 1.0;
};

/// A point of a turned shape's outline.
struct Outline {
    double radius = 0.0;
    double height = 0.0;
};

/// A tapered tube from `a` to `b`; a radius of 0 makes a tip.
struct Tube {
    math::dvec3 a;
    math::dvec3 b;
    double radius_a = 0.1;
    double radius_b = 0.1;
    int sides = 6;
};

/// Two axes of a plane; a prism extends along u x v.
enum class Plane : std::uint8_t {
    xy,  ///< Along z.
    zy,  ///< Along -x.
    xz,  ///< Along -y.
};

class SolidBuilder {
public:
    /// Turns and scales are relative to the mesh, not to the placement before.
    void place(Stand const& stand) noexcept;

    /// A flat convex polygon, counter-clockwise from outside.
    void polygon(std::span<math::dvec3 const> corners, std::uint32_t material);
    void triangle(math::dvec3 const& a, math::dvec3 const& b, math::dvec3 const& c, std::uint32_t material);
    void quad(math::dvec3 const& a, math::dvec3 const& b, math::dvec3 const& c, math::dvec3 const& d, std::uint32_t material);

    void box(math::dvec3 const& lo, math::dvec3 const& hi, std::uint32_t material);

    /// A box whose top is scaled by `taper` about its middle.
    void tapered_box(math::dvec3 const& lo, math::dvec3 const& hi, double taper, std::uint32_t material);

    /// The profile, counter-clockwise in (u, v) and without crossings, swept from `from` to `to` along u x v.
    void prism(Plane plane, std::span<math::dvec2 const> profile, std::array<double, 2> from_to, std::uint32_t material);

    /// An outline turned about the vertical axis through `base`, from its lowest point up; open ends get a cap.
    void lathe(math::dvec3 const& base, std::span<Outline const> outline, int sides, std::uint32_t material);

    void tube(Tube const& tube, std::uint32_t material);

    /// A ball of two caps and `rings` rows between.
    void ball(math::dvec3 const& middle, double radius, int rings, std::uint32_t material);

    [[nodiscard]] std::uint64_t triangles() const noexcept { return triangles_; }

    /// The mesh so far; the builder is empty after it.
    [[nodiscard]] Mesh take();

private:
    [[nodiscard]] math::dvec3 placed(math::dvec3 const& p) const noexcept;
    Primitive& room_for(std::size_t triangles, std::uint32_t material);
    void caps(Plane plane, std::span<math::dvec2 const> profile, std::array<double, 2> from_to, std::uint32_t material);

    Stand stand_;
    SinCos turn_;
    Mesh mesh_;
    std::vector<std::uint32_t> open_;  ///< The primitive that each material still grows in, or `none`.
    std::uint64_t triangles_ = 0;
};

/// An instance of `mesh` that stands as `stand` says.
Instance placed_instance(std::string name, std::uint32_t mesh, Stand const& stand);

/// Splits a simple polygon, counter-clockwise, into triangles of its corners by clipping ears.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<math::dvec2 const> polygon);

}  // namespace gnomon::scene::detail
