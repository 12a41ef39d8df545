#include <gnomon/core.hpp>
#include <gnomon/math.hpp>

#include <cstdio>

int main() {
    auto const view = gnomon::math::make_perspective({.target_m = {0.0, 0.0, -1.0}, .near_m = 1.0, .size_px = {64, 64}});
    if (!view) return 1;
    double const depth = gnomon::math::depth_from_distance(view.value(), 2.0);
    std::printf("reversed depth 2 m in front of a camera with its near plane at 1 m: %g\n", depth);
    return depth == 0.5 ? 0 : 1;
}
