#pragma once
// A camera's cascades from frame to frame: where each map stands, and whether to keep, scroll or redraw it. Draws
// nothing.

#include <gnomon/cascade/place.hpp>
#include <gnomon/cascade/splits.hpp>
#include <gnomon/cascade/step.hpp>

#include <utility>

namespace gnomon::cascade {

struct CascadeConfig {
    math::dvec3 direction{-0.45, -0.8, -0.4};  ///< The way the light travels.
    math::dvec3 up{0.0, 1.0, 0.0};
    math::dvec3 anchor_m{0.0, 0.0,
                         0.0};  ///< Light space begins here; anywhere, but always at the same place (`rebase`).
    SplitConfig splits;
    FitConfig fit;
};

/// One cascade of a frame.
struct CascadePlan {
    DepthInterval depths;
    double extent_m = 0.0;  ///< Of the sub-frustum, which the map holds at any turn.
    Volume volume;
    Update update;
};

/// A frame's cascades: plain data.
struct CascadeFrame {
    LightFrame light;
    math::dvec3 anchor_m{0.0, 0.0, 0.0};
    std::uint32_t count = 0;
    std::array<CascadePlan, max_cascades> cascades{};
    /// Casters may lie in front of code 0, and must be drawn at code 0 ("pancaking"): depths there are
    /// no distances, which filters that measure them (PCSS, moments) must know. False with `scene_bounds`, which hold
    /// all.
    bool clamp_near = true;
};

/// What each map holds. `plan` reads it, `commit` writes it.
struct Cascades {
    struct Held {
        Volume volume;
        LightFrame light;
        math::dvec3 anchor_m{0.0, 0.0, 0.0};
        Reason pending = Reason::first;  ///< `none`: the map holds `volume`.
    };
    std::array<Held, max_cascades> held{};
};

/// Places the cascades of this frame and says what becomes of each map. Changes nothing.
///
/// returns: the frame, or the value that is wrong: of the configuration, or of the camera (NaN, no field, infinite far
///          without a shadow distance, too far from the anchor)
/// cost:    O(cascades); allocates nothing but a failure's sentence
[[nodiscard]] core::Result<CascadeFrame, Error> plan(Cascades const& cascades, CascadeConfig const& config,
                                                     math::View const& camera);

/// Tells that the map of cascade `k` has been brought up to date with `frame`, all of it. A cascade that was put off to
/// a later frame is not committed, and goes on from what it holds.
///
/// expects: k < frame.count.
inline void commit(Cascades& cascades, CascadeFrame const& frame, std::uint32_t k) noexcept {
    GNOMON_EXPECT(k < frame.count);
    cascades.held[k] = {frame.cascades[k].volume, frame.light, frame.anchor_m, Reason::none};
}

inline void commit(Cascades& cascades, CascadeFrame const& frame) noexcept {
    for (std::uint32_t k = 0; k < frame.count; ++k) commit(cascades, frame, k);
}

/// Has the map of cascade `k` drawn anew with the next plan; one that holds nothing yet stays `first`.
///
/// expects: k < max_cascades.
inline void invalidate(Cascades& cascades, std::uint32_t k) noexcept {
    GNOMON_EXPECT(k < max_cascades);
    if (cascades.held[k].pending == Reason::none) cascades.held[k].pending = Reason::requested;
}

/// Follows a shift of the world's origin: what was at p is at p + shift_m from now on, and nothing is redrawn.
///
/// Light space goes by differences from the anchor. They are the same to the bit where the shift loses no bits of the
/// positions and the anchor, as one of whole powers of two of metres does.
inline void rebase(Cascades& cascades, CascadeConfig& config, math::dvec3 const& shift_m) noexcept {
    config.anchor_m += shift_m;
    for (Cascades::Held& held : cascades.held) held.anchor_m += shift_m;
}

}  // namespace gnomon::cascade

#include <gnomon/cascade/detail/plan.hpp>
