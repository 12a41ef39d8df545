#pragma once
// What every backend refuses of integer passes and depth kernels, in the same words.

#include <gnomon/backend/check.hpp>
#include <gnomon/backend/depth_kernel.hpp>
#include <gnomon/backend/ortho.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace gnomon::backend {

namespace detail {

[[nodiscard]] inline bool is_sound(IntegerOrtho const& light) noexcept {
    auto const finite = [](math::dvec3 const& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
    return finite(light.right) && finite(light.down) && finite(light.away) && std::isfinite(light.texel_m) &&
           light.texel_m > 0.0 && std::isfinite(light.depth_unit_m) && light.depth_unit_m > 0.0;
}

}  // namespace detail

/// The pixels that a layer of an integer pass clears and draws.
[[nodiscard]] constexpr Rect area_of(OrthoLayer const& layer, math::ivec2 const& size_px) noexcept {
    Rect const whole{0, 0, size_px.x, size_px.y};
    return layer.scissor ? detail::common(whole, *layer.scissor) : whole;
}

/// The list that `draw_ortho` draws.
struct OrthoList {
    std::size_t draws = 0;
    bool has_instances = false;
};

/// Calls `use(place)` for each draw that a layer takes of a list of `draws`.
template <class Use>
void for_each_draw(OrthoLayer const& layer, std::size_t draws, Use&& use) {
    if (layer.draws)
        for (std::uint32_t const i : *layer.draws) use(std::size_t{i});
    else
        for (std::size_t i = 0; i < draws; ++i) use(i);
}

/// One layer of `draw_ortho`, over a list of `draws` draws.
[[nodiscard]] inline Result<Done> check_layer(OrthoLayer const& layer, TargetConfig const& target, std::size_t draws) {
    constexpr std::string_view verb = "draw_ortho";
    if (layer.layer >= target.layers)
        return detail::refuse(Error::bad_argument, verb,
                              "layer " + std::to_string(layer.layer) + " of a target of " + std::to_string(target.layers));
    if (!detail::is_sound(layer.light))
        return detail::refuse(Error::bad_argument, verb,
                              "a light of texels of " + std::to_string(layer.light.texel_m) + " m and depth units of " +
                                  std::to_string(layer.light.depth_unit_m) +
                                  " m: both must be above 0, and they and the axes finite");
    for (std::int64_t const at : {layer.light.origin_x, layer.light.origin_y, layer.light.origin_z})
        if (at > max_light_origin || at < -max_light_origin)
            return detail::refuse(Error::too_large, verb,
                                  "an image at " + std::to_string(at) + " units; 2^42 either way may be");
    if (!layer.draws) return Done{};
    std::int64_t before = -1;
    for (std::uint32_t const draw : *layer.draws) {
        if (draw >= draws)
            return detail::refuse(Error::bad_argument, verb,
                                  "draw " + std::to_string(draw) + " of a list of " + std::to_string(draws));
        if (std::int64_t{draw} <= before)
            return detail::refuse(Error::bad_argument, verb,
                                  "draw " + std::to_string(draw) + " comes after " + std::to_string(before) +
                                      ": places must ascend");
        before = draw;
    }
    return Done{};
}

/// All layers of `draw_ortho`.
///
/// cost: O(layers^2 + places of draws).
[[nodiscard]] inline Result<Done> check_layers(std::span<OrthoLayer const> layers, TargetConfig const& target,
                                               OrthoList const& list) {
    if (list.has_instances)
        return detail::refuse(Error::bad_argument, "draw_ortho", "the list has instances, which have no whole units");
    if (target.triangle_ids || target.color)
        return detail::refuse(Error::unsupported_format, "draw_ortho", "the target may have depths alone");
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (auto ok = check_layer(layers[i], target, list.draws); !ok) return ok;
        for (std::size_t j = 0; j < i; ++j)
            if (layers[j].layer == layers[i].layer &&
                detail::common(area_of(layers[i], target.size_px), area_of(layers[j], target.size_px)).width > 0)
                return detail::refuse(Error::bad_argument, "draw_ortho",
                                      "two areas of layer " + std::to_string(layers[i].layer) +
                                          " overlap: draw them one after the other");
    }
    return Done{};
}

/// How a call's arguments fit a depth kernel and its target.
[[nodiscard]] inline Result<Done> check(DepthKernel const& kernel, DepthCall const& call, TargetConfig const& target) {
    constexpr std::string_view verb = "write_depth";
    if (auto ok = detail::check_fits(verb, kernel, call, max_constant_bytes); !ok) return ok;
    if (auto ok = check_part(verb, {call.to, call.layer, Plane::depth, call.rect}, target); !ok) return ok;
    for (TargetBinding const& binding : call.targets)
        if (binding.target == call.to)
            return detail::refuse(Error::bad_argument, verb,
                                  "the kernel reads target " + std::to_string(call.to.value) + ", which it writes: use two");
    return Done{};
}

}  // namespace gnomon::backend
