// Shows: how often a determinant in float or double says the wrong side of a triangle's plane, and that the predicate never does.

#include <gnomon/math.hpp>
#include <gnomon/predicates.hpp>

#include <cstdio>

namespace math = gnomon::math;
namespace predicates = gnomon::predicates;

/// The textbook determinant, in one type.
template <class T>
static int naive_side(math::vec3 const& a, math::vec3 const& b, math::vec3 const& c, math::vec3 const& d) {
    auto const minus = [](float p, float q) { return static_cast<T>(p) - static_cast<T>(q); };
    T const ux = minus(b.x, a.x), uy = minus(b.y, a.y), uz = minus(b.z, a.z);
    T const vx = minus(c.x, a.x), vy = minus(c.y, a.y), vz = minus(c.z, a.z);
    T const wx = minus(d.x, a.x), wy = minus(d.y, a.y), wz = minus(d.z, a.z);
    T const det = (uy * vz - uz * vy) * wx + (uz * vx - ux * vz) * wy + (ux * vy - uy * vx) * wz;
    return det > 0 ? 1 : det < 0 ? -1 : 0;
}

int main() {
    // A triangle of the plane x + y + z = 0, and 4096 points on it and a hair beside it: all of them floats, exactly.
    math::vec3 const a(12.0F, 12.0F, -24.0F), b(-24.0F, 12.0F, 12.0F), c(12.0F, -24.0F, 12.0F);
    float const hair = 0x1p-53F;
    int wrong_float = 0, wrong_double = 0, wrong_exact = 0;
    for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 64; ++j) {
            math::vec3 const d(static_cast<float>(i) * hair, static_cast<float>(-j) * hair, 0.0F);
            int const truth = i > j ? 1 : i < j ? -1 : 0; // the sign of x + y + z; the normal is (1, 1, 1)
            wrong_float += naive_side<float>(a, b, c, d) != truth;
            wrong_double += naive_side<double>(a, b, c, d) != truth;
            wrong_exact += static_cast<int>(predicates::orient3d(a, b, c, d)) != truth;
        }
    std::printf("of 4096 points beside a plane, on the wrong side: float %d, double %d, predicate %d\n", wrong_float, wrong_double,
                wrong_exact);
    return wrong_exact == 0 && wrong_double > 0 && wrong_float > 0 ? 0 : 1;
}
