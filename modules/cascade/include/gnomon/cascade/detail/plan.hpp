#pragma once
// The parts of a plan; see cascades.hpp.

#include <gnomon/cascade/cascades.hpp>

namespace gnomon::cascade {

namespace detail {

[[nodiscard]] inline core::Result<core::Done, Error> validate_camera(math::View const& camera,
                                                                     math::dvec3 const& anchor_m) {
    math::Window const& w = camera.window;
    bool const finite = math::is_finite(camera.eye_m) && math::is_finite(camera.right) && math::is_finite(camera.up) &&
                        math::is_finite(camera.back) && math::is_finite(anchor_m);
    if (!finite)
        return core::Failure{Error::not_finite,
                             core::sentence({"the camera's eye ", math::text_of(camera.eye_m), ", its axes and the anchor ",
                                       math::text_of(anchor_m), " must be finite"})};
    bool const wide = w.right - w.left > 0.0 && w.top - w.bottom > 0.0 && math::is_finite(w.right) &&
                      math::is_finite(w.left) && math::is_finite(w.top) && math::is_finite(w.bottom);
    if (!wide)
        return core::Failure{Error::bad_range,
                             core::sentence({"the camera's window from ", math::text_of(w.left), " to ", math::text_of(w.right), " and ",
                                       math::text_of(w.bottom), " to ", math::text_of(w.top), " has no width or height"})};
    return core::Done{};
}

[[nodiscard]] inline core::Failure<Error> too_far(std::uint32_t k, math::View const& camera, CascadePlan const& c) {
    return {Error::too_far,
            core::sentence({"cascade ", std::to_string(k), ", ", math::text_of(c.extent_m), " m across, with texels of ",
                      math::text_of(c.volume.texel_m), " m and depths of ", math::text_of(c.volume.depth_unit_m),
                      " m is too far from the anchor for the camera at ", math::text_of(camera.eye_m),
                      ": move the anchor nearer, or see to a view of 1e-9 to 1e12 m"})};
}

/// Why what is held cannot be gone on from, but for its volume.
[[nodiscard]] inline Reason unusable(Cascades::Held const& held, CascadeFrame const& frame) noexcept {
    if (held.pending != Reason::none) return held.pending;
    if (!(held.light == frame.light)) return Reason::light_turned;
    if (held.anchor_m != frame.anchor_m) return Reason::anchor_moved;
    return Reason::none;
}

/// returns: false where the place would be too far
[[nodiscard]] inline bool plan_one(Cascades::Held const& held, CascadeConfig const& config, math::View const& camera,
                                   CascadeFrame const& frame, CascadePlan& out) {
    std::array<math::dvec3, 8> const corners = corners_in_view(camera, out.depths);
    double const diameter = diameter_m(corners);
    BoundingSphere const sphere = config.fit.extent == Extent::sphere ? bounding_sphere(corners) : BoundingSphere{};
    out.extent_m = config.fit.extent == Extent::sphere ? 2.0 * sphere.radius_m : diameter;
    if (!(out.extent_m >= 1e-9 && out.extent_m <= 1e12)) return false;
    math::dvec3 const eye_m = camera.eye_m - frame.anchor_m;
    std::array<math::dvec3, 8> relative_m;
    for (std::size_t i = 0; i < 8; ++i) relative_m[i] = eye_m + relative_from_view(camera, corners[i]);
    PlaceInput in;
    in.bounds = bounds_in_light(frame.light, relative_m);
    if (config.fit.extent == Extent::sphere) {
        math::dvec3 const centre =
            light_from_relative(frame.light, eye_m + relative_from_view(camera, sphere.center_in_view));
        in.bounds = {centre - math::dvec3(sphere.radius_m), centre + math::dvec3(sphere.radius_m)};
    }
    Reason const reason = unusable(held, frame);
    bool const kept = reason == Reason::none;
    in.texel_m = texel_for(config.fit, out.extent_m, held.pending == Reason::first ? 0.0 : held.volume.texel_m);
    in.depth = fit_depth(config.fit.depth, frame.light, out.extent_m);
    in.held = kept ? &held.volume : nullptr;
    out.volume.texel_m = in.texel_m;
    out.volume.depth_unit_m = in.depth.unit_m;
    auto const placed = try_place(config.fit, in);
    if (!placed) return false;
    out.volume = *placed;
    out.update = kept ? update_from(held.volume, out.volume) : redraw(reason, out.volume.size_px);
    return true;
}

}  // namespace detail

inline core::Result<CascadeFrame, Error> plan(Cascades const& cascades, CascadeConfig const& config,
                                              math::View const& camera) {
    auto const light = make_light_frame(config.direction, config.up);
    if (!light) return light.failure();
    if (auto ok = validate(config.fit); !ok) return std::move(ok).failure();
    if (auto ok = detail::validate_camera(camera, config.anchor_m); !ok) return std::move(ok).failure();
    auto const splits = make_splits(config.splits, camera);
    if (!splits) return splits.failure();
    CascadeFrame frame;
    frame.light = *light;
    frame.anchor_m = config.anchor_m;
    frame.count = splits->count;
    frame.clamp_near = config.fit.depth.range == DepthRange::fixed_length;
    for (std::uint32_t k = 0; k < frame.count; ++k) {
        frame.cascades[k].depths = splits->of[k];
        if (!detail::plan_one(cascades.held[k], config, camera, frame, frame.cascades[k]))
            return detail::too_far(k, camera, frame.cascades[k]);
    }
    return frame;
}

}  // namespace gnomon::cascade
