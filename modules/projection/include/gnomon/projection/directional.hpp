#pragma once
// A sun's view: orthographic, fitted to what can cast and what can receive a shadow.
//
// The eye stands in the middle of the casters, so positions relative to it are small wherever the scene lies. Built
// directly from the bounds' corners; nothing is inverted.

#include <gnomon/projection/error.hpp>

#include <cmath>

namespace gnomon::projection {

struct DirectionalConfig {
    math::dvec3 origin_m{0.0, 0.0, 0.0};  ///< The world position of the bounds' (0, 0, 0).
    math::dvec3 up{0.0, 1.0, 0.0};        ///< Turns the map about the light's axis; see `math::looking_along`.
    math::ivec2 size_px{1024, 1024};
    double margin_px = 2.0;  ///< Texels left free on each side, for the filter's footprint.
    math::Depth depth = math::Depth::reversed;
};

namespace detail {

/// An interval of doubles that grows.
struct Extent {
    double lo = std::numeric_limits<double>::infinity();
    double hi = -std::numeric_limits<double>::infinity();

    void include(double x) noexcept {
        lo = x < lo ? x : lo;
        hi = x > hi ? x : hi;
    }
};

/// A box as the light sees it: across, upward, and along the light's way.
struct LightBox {
    Extent x;
    Extent y;
    Extent distance;
};

inline LightBox box_in_light(math::View const& view, math::Aabb const& box, math::dvec3 const& origin_m) noexcept {
    LightBox seen;
    for (unsigned i = 0; i < 8; ++i) {
        math::dvec3 const p = origin_m + math::to_double(math::corner(box, i)) - view.eye_m;
        seen.x.include(glm::dot(view.right, p));
        seen.y.include(glm::dot(view.up, p));
        seen.distance.include(-glm::dot(view.back, p));
    }
    return seen;
}

/// What both intervals hold; `a` alone where they hold nothing in common.
inline Extent common(Extent const& a, Extent const& b) noexcept {
    Extent const both{a.lo > b.lo ? a.lo : b.lo, a.hi < b.hi ? a.hi : b.hi};
    return both.lo <= both.hi ? both : a;
}

/// `extent` grown by `pad` on both sides and then by `factor` about its middle.
inline Extent grown(Extent const& extent, double pad, double factor) noexcept {
    double const middle = 0.5 * (extent.lo + extent.hi);
    double const half = (0.5 * (extent.hi - extent.lo) + pad) * factor;
    return {middle - half, middle + half};
}

}  // namespace detail

/// The view of a light that travels along `direction`, so that its window holds every point of `receivers` over which
/// `casters` can throw a shadow, and its depth range every point of both.
///
/// An empty `receivers` means that the casters are the receivers. What receives but lies beside the window is lit.
/// The fit is conservative in float: it is padded by 2^-18 of the largest coordinate, where evaluating the rounded
/// matrix on a rounded position errs by less than 8 * 2^-24 of it.
///
/// returns: a view, or the value that is wrong. Flat and one-point bounds are legal: the padding gives them a size.
[[nodiscard]] inline core::Result<math::View, Error> directional_view(math::dvec3 const& direction,
                                                                      math::Aabb const& casters,
                                                                      math::Aabb const& receivers,
                                                                      DirectionalConfig const& config) {
    if (auto ok = detail::validate_direction(direction); !ok) return std::move(ok).failure();
    if (auto ok = detail::validate_map(config.size_px); !ok) return std::move(ok).failure();
    if (math::is_empty(casters)) return core::Failure{Error::empty_bounds, "there are no casters to fit a map to"};
    bool const finite = math::is_finite(casters.lo) && math::is_finite(casters.hi) && math::is_finite(config.origin_m);
    if (!finite)
        return core::Failure{Error::not_finite, "the casters' bounds " + math::text_of(math::to_double(casters.lo)) +
                                                    " to " + math::text_of(math::to_double(casters.hi)) +
                                                    " are not finite"};
    math::View view;
    view.lens = math::Lens::orthographic;
    view.depth = config.depth;
    view.size_px = config.size_px;
    view.eye_m = config.origin_m + math::to_double(math::center(casters));
    view = math::looking_along(view, direction, config.up);

    bool const apart = !math::is_empty(receivers) && math::is_finite(receivers.lo) && math::is_finite(receivers.hi);
    detail::LightBox const cast = detail::box_in_light(view, casters, config.origin_m);
    detail::LightBox const receive = apart ? detail::box_in_light(view, receivers, config.origin_m) : cast;
    detail::Extent const x = detail::common(receive.x, cast.x);
    detail::Extent const y = detail::common(receive.y, cast.y);
    double largest = 1e-6;  // 1 um: a scene that is one point still gets a window
    for (detail::Extent const& e : {cast.x, cast.y, cast.distance, receive.x, receive.y, receive.distance})
        largest = std::fmax(largest, std::fmax(std::abs(e.lo), std::abs(e.hi)));
    double const pad = std::ldexp(largest, -18);
    detail::Extent const wide = detail::grown(x, pad, detail::widening(config.size_px.x, config.margin_px));
    detail::Extent const high = detail::grown(y, pad, detail::widening(config.size_px.y, config.margin_px));
    view.window = {wide.lo, wide.hi, high.lo, high.hi};
    view.near_m = std::fmin(cast.distance.lo, receive.distance.lo) - pad;
    view.far_m = std::fmax(cast.distance.hi, receive.distance.hi) + pad;
    return view;
}

}  // namespace gnomon::projection
