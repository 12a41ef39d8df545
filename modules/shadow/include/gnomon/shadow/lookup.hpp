#pragma once
// The lookup: how much of a light arrives at a surface point, as one shadow map sees it.
//
// What the map does not cover is lit: texels beyond its border, points behind the light, texels that nothing was drawn
// to. A plane that faces away from the light is in shadow, without a lookup.

#include <gnomon/shadow/bias.hpp>
#include <gnomon/shadow/detail/texel_source.hpp>
#include <gnomon/shadow/filter.hpp>
#include <gnomon/shadow/formula/lookup.glsl>
#include <gnomon/shadow/map_view.hpp>
#include <gnomon/shadow/receiver.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>

namespace gnomon::shadow {

/// The map's texels: float depths or 16-bit codes, rows `stride` texels apart, row 0 on top.
///
/// expects: as many rows and columns as the `MapView` says.
template <class T>
struct Texels {
    T const* data = nullptr;
    std::ptrdiff_t stride = 0;

    [[nodiscard]] T at(std::int32_t x, std::int32_t y) const noexcept { return data[y * stride + x]; }
};

struct LookupConfig {
    BiasConfig bias;
    int taps = 2;  ///< 1..`max_taps` each way.
};

struct Lookup {
    float visibility = 1.0F;  ///< In [0, 1]: the weight of the texels with nothing before the receiver.
    float bias_m = 0.0F;      ///< The bias applied, normal offset included, in metres toward the light.
};

/// A point that is looked up: position in work space, unit geometric normal on the side that is looked at.
struct Surface {
    math::vec3 position{0.0F};
    math::vec3 normal{0.0F, 1.0F, 0.0F};
};

/// The receiver that a lookup compares with: projected, offset and biased.
struct Prepared {
    Receiver receiver;
    float depth = 0.0F;  ///< At the receiver's image point, biased.
    float bias_m = 0.0F;
    bool faces_away = false;
    bool nearer_is_greater = false;
};

[[nodiscard]] constexpr formula::GnShadowConfig formula_config(LookupConfig const& config) noexcept {
    return formula_config(config.bias, config.taps);
}

/// A plane whose cosine is at most this may face away for all that float can tell: two unit vectors (three roundings
/// each), two for the point relative to the light, five for the dot product and its division, at most 2^-24 each. Such
/// a plane catches less than a millionth of the light, so calling it shadow is never seen; calling it lit would be a coin
/// tossed per sample where the light runs along walls.
inline constexpr float edge_on_cos = 13.0F * 0x1p-24F;

[[nodiscard]] inline Prepared prepare(MapView const& map, math::vec3 const& position, math::vec3 const& normal,
                                      LookupConfig const& config) noexcept {
    formula::GnPrepared<float> const ready =
        gn_prepare(map, formula::Vec3<float>(position), formula::Vec3<float>(normal), formula_config(config));
    Prepared made;
    made.receiver = detail::plain(ready.at);
    made.bias_m = ready.bias_m.v;
    made.faces_away = ready.faces_away.v;
    if (made.faces_away) made.bias_m = 0.0F;
    if (made.faces_away || !made.receiver.in_front) return made;
    made.nearer_is_greater = map.reversed != 0U;
    made.depth = ready.depth.v;
    return made;
}

namespace detail {

[[nodiscard]] inline formula::GnPrepared<float> as_formula(Prepared const& ready) noexcept {
    return {as_formula(ready.receiver), ready.depth, ready.bias_m, ready.faces_away};
}

}  // namespace detail

/// The depth that texel (x, y) is compared with, within what a map can hold: that of the receiver's plane under the
/// texel's centre where the plane is nearer to the light there, the receiver's own where it is farther.
///
/// Following the plane away from the light would only find what lies below the receiver: at the foot of a wall, the
/// ground in front of it.
[[nodiscard]] inline float plane_depth(Prepared const& ready, std::int32_t x, std::int32_t y) noexcept {
    using Int = formula::Int<float>;
    return gn_plane_depth(detail::as_formula(ready), ready.nearer_is_greater, Int(x), Int(y)).v;
}

/// Calls `visit(x, y, weight, blocked)` for every texel of the filter that lies in the map.
template <TexelSource Source, class Visit>
void for_each_tap(MapView const& map, Source const& texels, Prepared const& ready, int taps, Visit&& visit) noexcept {
    TapRow const columns = taps_at(ready.receiver.texel.x, taps);
    TapRow const rows = taps_at(ready.receiver.texel.y, taps);
    auto const width = static_cast<std::int32_t>(map.size_px.x);
    auto const height = static_cast<std::int32_t>(map.size_px.y);
    for (int j = 0; j < taps; ++j) {
        std::int32_t const y = rows.first + j;
        if (y < 0 || y >= height) continue;
        for (int i = 0; i < taps; ++i) {
            std::int32_t const x = columns.first + i;
            if (x < 0 || x >= width) continue;
            formula::Float<float> const stored = depth_of(texels.at(x, y));
            formula::Float<float> const receiver = plane_depth(ready, x, y);
            bool const blocked = gn_is_nearer(stored, receiver, map.reversed != 0U).v;
            visit(x, y, columns.weight(i) * rows.weight(j), blocked);
        }
    }
}

/// Visibility of `position`, whose surface has the unit geometric normal `normal` on the side that is looked at.
///
///     visibility = 1 - sum of the weights of the texels whose depth is nearer to the light than the biased plane
///
/// expects: `texels` were drawn with `map`'s view and format; 1 <= taps <= `max_taps`.
/// returns: 1 outside the map and for a position that is not finite; 0 where the plane faces away.
/// cost:    O(taps^2)
template <TexelSource Source>
[[nodiscard]] Lookup look_up(MapView const& map, Source const& texels, math::vec3 const& position,
                             math::vec3 const& normal, LookupConfig const& config) noexcept {
    formula::GnLookup<float> const seen = gn_look_up(map, texels, formula::Vec3<float>(position),
                                                     formula::Vec3<float>(normal), formula_config(config));
    return {seen.visibility.v, seen.bias_m.v};
}

}  // namespace gnomon::shadow
