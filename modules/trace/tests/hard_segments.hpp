#pragma once
// Triangles and segments aimed at their corners, edges and planes, at every scale, for the tests of the filter and of
// the shaders that it stands for.

#include <gnomon/math/vec.hpp>
#include <gnomon/trace/segment.hpp>

#include "../../predicates/tests/hard_floats.hpp"

#include <cmath>

namespace segments {

namespace math = gnomon::math;
namespace trace = gnomon::trace;
using hard::Random;
using trace::Light;
using trace::Segment;

/// How far apart things are: millimetres to a thousand kilometres, from the origin or 10,000 km away.
struct Scale {
    float size;
    math::vec3 offset;
};

inline Scale any_scale(Random& random) {
    float const size = std::ldexp(1.0F, random.below(30) - 10);
    float const away = random.below(3) == 0 ? 1e7F : random.below(3) == 0 ? 8192.0F : 0.0F;
    return {size, math::vec3{away * random.uniform(-1.0F, 1.0F), away * random.uniform(-1.0F, 1.0F),
                             random.uniform(-1.0F, 1.0F)}};
}

inline math::vec3 point_of(Random& random, Scale const& scale) {
    return scale.offset +
           math::vec3{random.uniform(-1.0F, 1.0F), random.uniform(-1.0F, 1.0F), random.uniform(-1.0F, 1.0F)} *
               scale.size;
}

inline trace::Triangle triangle_of(Random& random, Scale const& scale) {
    math::vec3 const a = point_of(random, scale);
    float const share = random.below(2) == 0 ? 1.0F : std::ldexp(1.0F, -random.below(16));
    math::vec3 b = a + (point_of(random, scale) - scale.offset) * share;
    math::vec3 c = a + (point_of(random, scale) - scale.offset) * share;
    switch (random.below(6)) {
        case 0: c = a + (b - a) * random.uniform(0.0F, 1.0F); break;  // a sliver, or nearly no triangle
        case 1: b.y = c.y = a.y; break;                               // in an axis plane
        case 2: b.x = a.x; break;                                     // an edge along an axis plane
        default: break;
    }
    return {a, b, c};
}

/// A point of the triangle: a corner, on an edge, in the middle, or a bit beside.
inline math::vec3 aim_of(Random& random, trace::Triangle const& t) {
    float const u = random.uniform(0.0F, 1.0F);
    float const v = random.uniform(0.0F, 1.0F - u);
    switch (random.below(5)) {
        case 0: return t[0];
        case 1: return t[0] + (t[1] - t[0]) * u;
        case 2: return t[1] + (t[2] - t[1]) * u;
        case 3: return t[0] + (t[1] - t[0]) * (u * 1.01F) + (t[2] - t[0]) * -0.001F * v;
        default: return t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v;
    }
}

/// A segment that makes a decision about the triangle hard, most of the time.
inline Segment segment_at(Random& random, trace::Triangle const& t, Scale const& scale) {
    math::vec3 const aim = aim_of(random, t);
    math::vec3 d = (point_of(random, scale) - scale.offset) * std::ldexp(1.0F, random.below(12) - 6);
    int const kind = random.below(8);
    if (kind == 0)
        d = (t[1] - t[0]) * random.uniform(-3.0F, 3.0F) + (t[2] - t[0]) * random.uniform(-3.0F, 3.0F);  // grazing
    if (kind == 1) d = math::vec3(0.0F, d.y, 0.0F);
    if (kind == 2) d.x = 0.0F;
    bool const sun = random.below(2) == 0;
    float const back = kind == 3 ? 0.0F : kind == 4 ? std::ldexp(1.0F, -random.below(40)) : random.uniform(0.0F, 2.0F);
    float const on = kind == 5 ? std::ldexp(1.0F, -random.below(40)) : kind == 6 ? 0.0F : random.uniform(0.0F, 2.0F);
    math::vec3 const start = aim - d * back;
    if (kind == 7) return {point_of(random, scale), Light::point(point_of(random, scale))};
    return {start, sun ? Light::direction(d) : Light::point(aim + d * on)};
}

}  // namespace segments
