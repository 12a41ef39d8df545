// Shows: what one step of a 32-bit float depth buffer is worth in metres, forward and reversed, with no far plane.

#include <gnomon/math.hpp>

#include <cmath>
#include <cstdio>

namespace math = gnomon::math;

/// How far a point at `distance_m` can move before its stored depth changes.
static double depth_step_m(math::View const& view, double distance_m) {
    float const depth = static_cast<float>(math::depth_from_distance(view, distance_m));
    // Away from the eye: reversed depth falls to 0, forward depth rises to 1.
    float const next = std::nextafter(depth, view.depth == math::Depth::reversed ? 0.0f : 1.0f);
    if (next == depth) return INFINITY; // no depth is left behind this point
    return std::abs(math::distance_from_depth(view, static_cast<double>(next)) -
                    math::distance_from_depth(view, static_cast<double>(depth)));
}

int main() {
    auto const made = math::make_perspective({.near_m = 0.1, .size_px = {1920, 1080}});
    if (!made) return 1;
    math::View reversed = made.value();
    math::View forward = reversed;
    forward.depth = math::Depth::forward;

    std::printf("%12s %14s %14s\n", "distance m", "forward m", "reversed m");
    for (double distance_m : {1.0, 10.0, 100.0, 1000.0, 10000.0})
        std::printf("%12g %14g %14g\n", distance_m, depth_step_m(forward, distance_m), depth_step_m(reversed, distance_m));

    // Reversed depth keeps float's own relative precision: a step is at most 2^-23 of the distance.
    bool const reversed_is_fine = depth_step_m(reversed, 10000.0) < 10000.0 * 0x1p-23;
    bool const forward_is_not = depth_step_m(forward, 10000.0) > 1.0;
    return reversed_is_fine && forward_is_not ? 0 : 1;
}
