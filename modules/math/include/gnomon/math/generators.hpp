#pragma once
// Adapter: generators of math's types for property tests. Needs the check module; no other header includes it.
//
// All favour what breaks code: equal and neighbouring coordinates, flat boxes, axis-parallel and nearly parallel
// directions, views far from the origin, windows off the centre, every depth convention.

#include <gnomon/check/check.hpp>
#include <gnomon/math/bounds.hpp>
#include <gnomon/math/scalar.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/math/view.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>

namespace gnomon::math {

[[nodiscard]] inline std::string check_string(dvec3 const& v) {
    char text[96];
    std::snprintf(text, sizeof text, "(%.17g, %.17g, %.17g)", v.x, v.y, v.z);
    return text;
}

[[nodiscard]] inline std::string check_string(vec3 const& v) {
    char text[64];
    std::snprintf(text, sizeof text, "(%.9g, %.9g, %.9g)", static_cast<double>(v.x), static_cast<double>(v.y),
                  static_cast<double>(v.z));
    return text;
}

[[nodiscard]] inline std::string check_string(Aabb const& box) {
    return "[" + check_string(box.lo) + " .. " + check_string(box.hi) + "]";
}

[[nodiscard]] inline std::string check_string(View const& view) {
    char text[256];
    std::snprintf(text, sizeof text, "%s %s view %dx%d px, near %.17g, far %.17g, window %.17g..%.17g x %.17g..%.17g",
                  view.depth == Depth::reversed ? "reversed" : "forward",
                  view.lens == Lens::perspective ? "perspective" : "orthographic", view.size_px.x, view.size_px.y,
                  view.near_m, view.far_m, view.window.left, view.window.right, view.window.bottom, view.window.top);
    return text + (" from " + check_string(view.eye_m)) + " back " + check_string(view.back);
}

/// A coordinate of ordinary scenes: mostly within 1000 m, at times 1e7 m away, tiny, or a round number.
[[nodiscard]] inline auto coordinates() {
    return [](check::Choices& choices) -> float {
        switch (choices.draw(7)) {
            case 0: return check::floats(-8.0F, 8.0F)(choices);
            case 1: return static_cast<float>(check::integers(-16, 16)(choices));
            case 2: return (choices.draw(1) != 0 ? -1e7F : 1e7F) + static_cast<float>(check::integers(-4, 4)(choices));
            case 3: return check::floats(-1e-4F, 1e-4F)(choices);
            default: return check::floats(-1000.0F, 1000.0F)(choices);
        }
    };
}

/// Points; one in four repeats a coordinate or moves it by one ulp.
[[nodiscard]] inline auto points() {
    return [](check::Choices& choices) {
        auto const number = coordinates();
        vec3 p(number(choices), number(choices), number(choices));
        if (choices.draw(3) == 3) p.y = choices.draw(1) != 0 ? next_up(p.x) : p.x;
        return p;
    };
}

/// Boxes that are not empty; some are flat or a single point.
[[nodiscard]] inline auto boxes() {
    return [](check::Choices& choices) {
        vec3 const a = points()(choices);
        vec3 b = points()(choices);
        for (axis_t axis = 0; axis < 3; ++axis)
            if (choices.draw(7) == 7) b[axis] = a[axis];
        return Aabb{glm::min(a, b), glm::max(a, b)};
    };
}

/// Unit directions; half of them along an axis or within 1e-9 of one.
[[nodiscard]] inline auto directions() {
    return [](check::Choices& choices) {
        auto const number = check::floats(-1.0, 1.0);
        dvec3 v(0.0);
        v[static_cast<axis_t>(choices.draw(2))] = choices.draw(1) != 0 ? -1.0 : 1.0;
        std::uint64_t const kind = choices.draw(3);
        double const amount = kind == 0 ? 0.0 : kind == 1 ? 1e-9 : 1.0;
        v += dvec3(number(choices), number(choices), number(choices)) * amount;
        return glm::dot(v, v) > 1e-30 ? glm::normalize(v) : dvec3(0.0, 0.0, -1.0);
    };
}

/// Three corners; some triangles are slivers, points, or have corners one ulp apart.
[[nodiscard]] inline auto triangles() {
    return [](check::Choices& choices) {
        auto const point = points();
        std::array<vec3, 3> t{point(choices), point(choices), point(choices)};
        std::uint64_t const kind = choices.draw(7);
        if (kind == 5) t[2] = t[0];
        if (kind == 6) t[2] = t[0] * 0.5F + t[1] * 0.5F;
        if (kind == 7) t[2] = vec3(next_up(t[0].x), t[0].y, t[0].z);
        return t;
    };
}

/// Views of either lens and either depth, infinite far in half of the perspective ones, windows off the centre, eyes up
/// to 1e7 m away, 1 to 4096 pixels a side. Near and far lie at least a factor of 1.5 apart.
[[nodiscard]] inline auto views() {
    return [](check::Choices& choices) {
        View view;
        view.lens = choices.draw(1) != 0 ? Lens::orthographic : Lens::perspective;
        view.depth = choices.draw(1) != 0 ? Depth::reversed : Depth::forward;
        view.eye_m = to_double(points()(choices));
        view = looking_along(view, directions()(choices), directions()(choices));
        auto const half = check::floats(0.01, 3.0);
        auto const shift = check::floats(-2.0, 2.0);
        double const scale = view.lens == Lens::orthographic ? 100.0 : 1.0;
        double const half_width = half(choices) * scale;
        double const half_height = half(choices) * scale;
        bool const centred = choices.draw(1) == 0;
        double const x = centred ? 0.0 : shift(choices) * half_width;
        double const y = centred ? 0.0 : shift(choices) * half_height;
        view.window = {x - half_width, x + half_width, y - half_height, y + half_height};
        view.near_m = check::element_of({0.1, 1e-3, 0.5, 10.0})(choices);
        bool const infinite = view.lens == Lens::perspective && choices.draw(1) != 0;
        view.far_m = infinite ? std::numeric_limits<double>::infinity()
                              : view.near_m * check::floats(1.5, 1e5)(choices);
        auto const size = check::integers(1, 4096);
        view.size_px = ivec2(size(choices), size(choices));
        return view;
    };
}

}  // namespace gnomon::math
