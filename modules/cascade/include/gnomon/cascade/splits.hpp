#pragma once
// Where the view is divided into cascades, and how far each reaches into the next.

#include <gnomon/math/text.hpp>
#include <gnomon/cascade/error.hpp>
#include <gnomon/core/result.hpp>
#include <gnomon/math/view.hpp>

#include <array>
#include <cstdint>

namespace gnomon::cascade {

inline constexpr std::uint32_t max_cascades = 8;

enum class SplitScheme : std::uint8_t {
    uniform,      ///< Equal steps.
    logarithmic,  ///< Equal ratios: an equal share of the image each. Needs near above 0.
    practical,    ///< lambda of the logarithmic, the rest of the uniform.
    given,        ///< `ends_m`, as it stands.
};

struct SplitConfig {
    SplitScheme scheme = SplitScheme::practical;
    std::uint32_t count = 4;
    double lambda = 0.5;   ///< In [0, 1]: 0 uniform, 1 logarithmic.
    double near_m = 0.0;   ///< Where the first begins; 0: at the camera's near plane.
    double far_m = 0.0;    ///< The shadow distance; 0: the camera's far plane, which must be finite then.
    double overlap = 0.1;  ///< In [0, 1]: the part of a cascade's depth, at its end, that the next one holds too.
    double fade = 0.0;     ///< In [0, 1]: the part of the last cascade's depth, at its end, that fades to no shadow.
    std::array<double, max_cascades> ends_m{};  ///< Of `given`: `count` of them, rising.
};

/// The depths, in metres along the axis of sight, that one cascade's map must hold.
struct DepthInterval {
    double begin_m = 0.0;  ///< Where the blend from the cascade before begins.
    double end_m = 0.0;
    double blend_m = 0.0;  ///< Where the blend to the next begins; the end itself without overlap (the last: fade).

    friend bool operator==(DepthInterval const&, DepthInterval const&) noexcept = default;
};

struct Splits {
    std::uint32_t count = 0;
    std::array<DepthInterval, max_cascades> of{};

    friend bool operator==(Splits const&, Splits const&) noexcept = default;
};

/// The cascades of a camera.
///
///     end_k = lambda near (far / near)^(k / N) + (1 - lambda) (near + k / N (far - near)),   k of 1 to N
///     begin_k+1 = blend_k = end_k - overlap (end_k - end_k-1)
///
/// The power is made of products, rounded alike on every machine; the last end is far itself.
/// returns: the splits, or the value that is wrong. A camera with infinite far needs `far_m`.
[[nodiscard]] core::Result<Splits, Error> make_splits(SplitConfig const& config, math::View const& camera);

/// The depths that a frame's visible samples span, widened to a few steps for each doubling, so that small changes
/// change nothing; a caller puts it into `SplitConfig::near_m` and `far_m`.
struct VisibleRange {
    double near_m = 0.0;
    double far_m = 0.0;

    friend bool operator==(VisibleRange const&, VisibleRange const&) noexcept = default;
};

/// Follows the visible depths: keeps `held` while it holds them and is not a doubling too wide on either side.
///
/// expects: 0 < nearest <= farthest, finite; anything else leaves `held` as it is (an empty frame changes nothing).
/// returns: the range, near rounded down and far up to a quarter of a doubling
[[nodiscard]] VisibleRange follow_visible(VisibleRange const& held, double nearest_m, double farthest_m) noexcept;

}  // namespace gnomon::cascade

#include <gnomon/cascade/detail/make_splits.hpp>
