#pragma once
// The question of this module, for one triangle: does it block the open segment from a sample to a light?
//
// Decided in exact arithmetic on the float coordinates, from the segment's two end points: there is no rounded
// direction, no epsilon and no offset along a normal.

#include <gnomon/math/vec.hpp>
#include <gnomon/predicates/orient.hpp>

#include <array>

namespace gnomon::trace {

/// A light as the truth sees it: a point, or the direction TOWARDS a light at infinity.
using Light = predicates::Target;

using Triangle = std::array<math::vec3, 3>;

/// The open segment from `start` to a lamp, or the ray from it to a sun.
struct Segment {
    math::vec3 start;
    Light end;
};

/// Where the truth can be asked for: finite ends, and a direction that is not zero.
[[nodiscard]] inline bool is_valid(Segment const& s) noexcept { return math::is_finite(s.start) && is_valid(s.end); }

/// Whether `t` blocks `s`: start and light lie strictly on opposite sides of its plane, and the line between them
/// passes its closed interior (a line through a shared edge or vertex is blocked by every triangle there).
///
/// returns: false for a triangle without area, an end point in the triangle's plane (sign 0 does not block), and
///          for NaN or infinity anywhere.
[[nodiscard]] inline bool blocks(Triangle const& t, Segment const& s) noexcept {
    if (!predicates::separates(t[0], t[1], t[2], Light::point(s.start), s.end)) return false;
    return none_opposite(line_side(s.start, s.end, t[0], t[1]), line_side(s.start, s.end, t[1], t[2]),
                         line_side(s.start, s.end, t[2], t[0]));
}

}  // namespace gnomon::trace
