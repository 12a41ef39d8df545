#pragma once
// The lookup: how much of a light arrives at a surface point, as one shadow map sees it.
//
// What the map does not cover is lit: texels beyond its border, points behind the light, texels that nothing was drawn
// to. A plane that faces away from the light is in shadow, without a lookup.

#include <gnomon/shadow/bias.hpp>
#include <gnomon/shadow/filter.hpp>
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

[[nodiscard]] inline float depth_of(float texel) noexcept { return texel; }
[[nodiscard]] inline float depth_of(std::uint16_t texel) noexcept {
    return static_cast<float>(texel) * (1.0F / 65535.0F);
}

/// Anything that can give the texel at (x, y): memory, an atlas tile, a page table, a formula.
template <class S>
concept TexelSource = requires(S const& source, std::int32_t i) {
    { depth_of(source.at(i, i)) }
    noexcept->std::same_as<float>;
};

struct LookupConfig {
    BiasConfig bias;
    int taps = 2;  ///< 1..`max_taps` each way.
};

struct Lookup {
    float visibility = 1.0F;  ///< In [0, 1]: the weight of the texels with nothing before the receiver.
    float bias_m = 0.0F;      ///< The bias applied, normal offset included, in metres toward the light.
};

/// The receiver that a lookup compares with: projected, offset and biased.
struct Prepared {
    Receiver receiver;
    float depth = 0.0F;  ///< At the receiver's image point, biased.
    float bias_m = 0.0F;
    bool faces_away = false;
    bool nearer_is_greater = false;
};

/// A plane whose cosine is at most this may face away for all that float can tell: two unit vectors (three roundings
/// each), two for the point relative to the light, five for the dot product and its division, at most 2^-24 each. Such
/// a plane catches less than a millionth of the light, so calling it shadow is never seen; calling it lit would be a coin
/// tossed per sample where the light runs along walls.
inline constexpr float edge_on_cos = 13.0F * 0x1p-24F;

[[nodiscard]] inline Prepared prepare(MapView const& map, math::vec3 const& position, math::vec3 const& normal,
                                      LookupConfig const& config) noexcept {
    Prepared ready;
    ready.receiver = receiver_at(map, position, normal);
    Receiver& at = ready.receiver;
    ready.faces_away = at.in_front && at.cos_angle <= edge_on_cos;
    if (!at.in_front || ready.faces_away) return ready;
    if (config.bias.normal_offset != 0.0F) {
        math::vec3 const moved = offset_position(at, position, normal, config.bias);
        float const along_light = std::sqrt(glm::dot(moved - position, moved - position)) * at.cos_angle;
        at = receiver_at(map, moved, normal);
        ready.bias_m = along_light;
        if (!at.in_front) return ready;
    }
    Bias const bias = bias_at(map, at, position, config.bias, config.taps);
    ready.bias_m += bias.metres;
    ready.nearer_is_greater = map.reversed;
    ready.depth = map.reversed ? at.depth + bias.depth : at.depth - bias.depth;
    if (!config.bias.receiver_plane) at.gradient = math::vec2(0.0F);
    return ready;
}

/// `x` limited to [0, 1]. Comparisons, because compilers keep std::fmin and std::fmax as calls.
[[nodiscard]] inline float to_unit(float x) noexcept { return x < 0.0F ? 0.0F : x > 1.0F ? 1.0F : x; }

/// The depth that texel (x, y) is compared with, within what a map can hold: that of the receiver's plane under the
/// texel's centre where the plane is nearer to the light there, the receiver's own where it is farther.
///
/// Following the plane away from the light would only find what lies below the receiver: at the foot of a wall, the
/// ground in front of it.
[[nodiscard]] inline float plane_depth(Prepared const& ready, std::int32_t x, std::int32_t y) noexcept {
    float const dx = static_cast<float>(x) + 0.5F - ready.receiver.texel.x;
    float const dy = static_cast<float>(y) + 0.5F - ready.receiver.texel.y;
    float const slide = ready.receiver.gradient.x * dx + ready.receiver.gradient.y * dy;
    bool const toward_light = ready.nearer_is_greater ? slide > 0.0F : slide < 0.0F;
    return to_unit(ready.depth + (toward_light ? slide : 0.0F));
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
            float const stored = depth_of(texels.at(x, y));
            float const receiver = plane_depth(ready, x, y);
            bool const blocked = map.reversed ? stored > receiver : stored < receiver;
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
    Prepared const ready = prepare(map, position, normal, config);
    if (ready.faces_away) return {0.0F, 0.0F};
    if (!ready.receiver.in_front) return {1.0F, ready.bias_m};
    float shadow = 0.0F;
    for_each_tap(map, texels, ready, config.taps,
                 [&](std::int32_t, std::int32_t, float weight, bool blocked) { shadow += blocked ? weight : 0.0F; });
    return {to_unit(1.0F - shadow), ready.bias_m};
}

}  // namespace gnomon::shadow
