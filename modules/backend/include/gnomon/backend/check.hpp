#pragma once
// What every backend refuses, in the same words: the checks of the verbs' arguments, for whoever writes a backend.
//
// Nothing here allocates unless it refuses.

#include <gnomon/backend/error.hpp>
#include <gnomon/backend/fragment.hpp>
#include <gnomon/backend/kernel.hpp>
#include <gnomon/backend/pass.hpp>
#include <gnomon/backend/verbs.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace gnomon::backend {

namespace detail {

[[nodiscard]] inline core::Failure<Error> refuse(Error code, std::string_view verb, std::string const& why) {
    return {code, std::string(verb) + ": " + why};
}

[[nodiscard]] inline std::string text(Rect const& r) {
    return "[" + std::to_string(r.x) + ", " + std::to_string(r.y) + ", " + std::to_string(r.width) + " x " +
           std::to_string(r.height) + "]";
}

[[nodiscard]] inline std::string text(math::ivec2 const& size) {
    return std::to_string(size.x) + " x " + std::to_string(size.y);
}

/// In 64 bits, so that no rectangle overflows.
[[nodiscard]] constexpr Rect common(Rect const& a, Rect const& b) noexcept {
    auto const end = [](std::int32_t start, std::int32_t size) { return std::int64_t{start} + std::max(size, 0); };
    std::int32_t const x = std::max(a.x, b.x);
    std::int32_t const y = std::max(a.y, b.y);
    std::int64_t const width = std::min(end(a.x, a.width), end(b.x, b.width)) - x;
    std::int64_t const height = std::min(end(a.y, a.height), end(b.y, b.height)) - y;
    if (width <= 0 || height <= 0) return {x, y, 0, 0};
    return {x, y, static_cast<std::int32_t>(width), static_cast<std::int32_t>(height)};
}

}  // namespace detail

/// The pixels that a layer of a pass clears and draws: viewport, scissor and target in common; empty if there are none.
[[nodiscard]] constexpr Rect area_of(PassLayer const& layer, math::ivec2 const& size_px) noexcept {
    Rect const whole{0, 0, size_px.x, size_px.y};
    Rect const seen = detail::common(layer.viewport.value_or(whole), whole);
    return layer.scissor ? detail::common(seen, *layer.scissor) : seen;
}

[[nodiscard]] inline core::Failure<Error> unknown_id(std::string_view verb, std::string_view what, std::uint32_t id) {
    return detail::refuse(Error::bad_argument, verb,
                          std::string(what) + " " + (id == ~0U ? std::string("none") : std::to_string(id)) +
                              " does not exist: it was never made, or released");
}

[[nodiscard]] inline Result<Done> check(TargetConfig const& target, Limits const& limits) {
    if (target.size_px.x < 1 || target.size_px.y < 1 || target.layers < 1)
        return detail::refuse(Error::bad_argument, "make_target",
                              detail::text(target.size_px) + " pixels in " + std::to_string(target.layers) +
                                  " layers is no image: each must be at least 1");
    if (target.size_px.x > limits.target_px || target.size_px.y > limits.target_px)
        return detail::refuse(
            Error::too_large, "make_target",
            detail::text(target.size_px) + " pixels; a side may have " + std::to_string(limits.target_px));
    if (target.layers > limits.target_layers)
        return detail::refuse(
            Error::too_large, "make_target",
            std::to_string(target.layers) + " layers; there may be " + std::to_string(limits.target_layers));
    std::uint64_t const bytes = std::uint64_t{static_cast<std::uint32_t>(target.size_px.x)} *
                                static_cast<std::uint32_t>(target.size_px.y) * target.layers *
                                bytes_per_pixel(target, target.color ? Plane::color : Plane::depth);
    if (bytes > limits.target_bytes)
        return detail::refuse(Error::too_large, "make_target",
                              std::to_string(target.layers) + " layers of " + detail::text(target.size_px) +
                                  " pixels are " + std::to_string(bytes >> 20U) + " MiB; there may be " +
                                  std::to_string(limits.target_bytes >> 20U));
    if (target.triangle_ids && target.depth != DepthFormat::f32)
        return detail::refuse(Error::unsupported_format, "make_target", "triangle ids need depth format f32");
    if (target.color && target.depth != DepthFormat::f32)
        return detail::refuse(Error::unsupported_format, "make_target", "colours need depth format f32");
    return Done{};
}

[[nodiscard]] inline Result<Done> check_buffer(std::size_t bytes, Limits const& limits) {
    if (bytes == 0) return detail::refuse(Error::bad_argument, "make_buffer", "0 bytes are no buffer");
    if (bytes > limits.buffer_bytes)
        return detail::refuse(Error::too_large, "make_buffer",
                              std::to_string(bytes) + " bytes; there may be " + std::to_string(limits.buffer_bytes));
    return Done{};
}

/// Bytes [offset, offset + bytes) of a buffer of `size`.
[[nodiscard]] inline Result<Done> check_range(std::string_view verb, std::size_t size, std::size_t offset,
                                              std::size_t bytes) {
    if (offset <= size && bytes <= size - offset) return Done{};
    return detail::refuse(Error::bad_argument, verb,
                          std::to_string(bytes) + " bytes from byte " + std::to_string(offset) +
                              " on are beyond the buffer's " + std::to_string(size));
}

/// One layer of a pass, or the view of `count_samples`.
[[nodiscard]] inline Result<Done> check_layer(std::string_view verb, PassLayer const& layer, TargetConfig const& target,
                                              Limits const& limits) {
    if (layer.layer >= target.layers)
        return detail::refuse(
            Error::bad_argument, verb,
            "layer " + std::to_string(layer.layer) + " of a target of " + std::to_string(target.layers));
    if (std::max({layer.subpixel.x, layer.subpixel.y, -layer.subpixel.x, -layer.subpixel.y}) > 127)
        return detail::refuse(Error::bad_argument, verb,
                              "an image moved by " + detail::text(layer.subpixel) + " subpixels; -127 to 127 may be");
    if (!layer.viewport) return Done{};
    Rect const& v = *layer.viewport;
    if (v.width > limits.target_px || v.height > limits.target_px || v.x > limits.target_px || v.y > limits.target_px ||
        v.x < -limits.target_px || v.y < -limits.target_px)
        return detail::refuse(
            Error::too_large, verb,
            "viewport " + detail::text(v) + "; sizes and offsets may be " + std::to_string(limits.target_px));
    return Done{};
}

/// Up to so many layers of a pass are compared with each other; that more do not overlap is the caller's word.
inline constexpr std::size_t max_compared_layers = 64;

/// All layers of a pass.
///
/// cost: O(layers^2) up to `max_compared_layers`.
[[nodiscard]] inline Result<Done> check_layers(std::span<PassLayer const> layers, TargetConfig const& target,
                                               Limits const& limits) {
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (auto ok = check_layer("draw", layers[i], target, limits); !ok) return ok;
        if (layers.size() > max_compared_layers) continue;
        Rect const area = area_of(layers[i], target.size_px);
        for (std::size_t j = 0; j < i; ++j) {
            if (layers[j].layer != layers[i].layer) continue;
            Rect const other = area_of(layers[j], target.size_px);
            if (detail::common(area, other).width > 0)
                return detail::refuse(Error::bad_argument, "draw",
                                      "the areas " + detail::text(other) + " and " + detail::text(area) + " of layer " +
                                          std::to_string(layers[i].layer) + " overlap: draw them one after the other");
        }
    }
    return Done{};
}

/// A part of a target, for `copy` and `read`.
[[nodiscard]] inline Result<Done> check_part(std::string_view verb, TargetPart const& part,
                                             TargetConfig const& target) {
    if (part.layer >= target.layers)
        return detail::refuse(
            Error::bad_argument, verb,
            "layer " + std::to_string(part.layer) + " of a target of " + std::to_string(target.layers));
    if (part.plane == Plane::triangle && !target.triangle_ids)
        return detail::refuse(Error::bad_argument, verb, "the target has no triangle ids");
    if (part.plane == Plane::color && !target.color)
        return detail::refuse(Error::bad_argument, verb, "the target has no colours");
    Rect const& r = part.rect;
    bool const inside = r.x >= 0 && r.y >= 0 && r.width >= 0 && r.height >= 0 && r.x <= target.size_px.x - r.width &&
                        r.y <= target.size_px.y - r.height;
    if (inside) return Done{};
    return detail::refuse(
        Error::bad_argument, verb,
        "the rectangle " + detail::text(r) + " is not within the target's " + detail::text(target.size_px) + " pixels");
}

[[nodiscard]] inline Result<Done> check_read(TargetPart const& part, TargetConfig const& target,
                                             std::size_t out_bytes) {
    if (auto ok = check_part("read", part, target); !ok) return ok;
    std::size_t const needed = static_cast<std::size_t>(part.rect.width) * static_cast<std::size_t>(part.rect.height) *
                               bytes_per_pixel(target, part.plane);
    if (out_bytes == needed) return Done{};
    return detail::refuse(Error::bad_argument, "read",
                          "the rectangle " + detail::text(part.rect) + " is " + std::to_string(needed) +
                              " bytes, not the " + std::to_string(out_bytes) + " given");
}

/// `from_config` and `to_config` of the targets `part.target` and `to`.
[[nodiscard]] inline Result<Done> check_copy(TargetPart const& part, TargetConfig const& from_config,
                                             TargetPart const& to, TargetConfig const& to_config) {
    if (auto ok = check_part("copy", part, from_config); !ok) return ok;
    if (auto ok = check_part("copy", to, to_config); !ok) return ok;
    if (from_config.depth != to_config.depth && part.plane == Plane::depth)
        return detail::refuse(Error::bad_argument, "copy", "the targets' depth formats differ");
    if (part.target == to.target && part.layer == to.layer)
        return detail::refuse(Error::bad_argument, "copy",
                              "from layer " + std::to_string(part.layer) + " to itself: use a second layer or target");
    return Done{};
}

namespace detail {

/// A kernel or a fragment kernel, and its call.
template <class AnyKernel, class Call>
[[nodiscard]] Result<Done> check_fits(std::string_view verb, AnyKernel const& kernel, Call const& call,
                                      std::size_t most_constants) {
    auto const differs = [&](char const* what, std::size_t given, std::size_t wanted) {
        return refuse(Error::bad_argument, verb,
                      "kernel '" + std::string(kernel.name) + "' has " + std::to_string(wanted) + " " + what +
                          ", not the " + std::to_string(given) + " given");
    };
    if (call.buffers.size() != kernel.buffers) return differs("buffers", call.buffers.size(), kernel.buffers);
    if (call.targets.size() != kernel.targets) return differs("targets", call.targets.size(), kernel.targets);
    if (call.constants.size() != kernel.constant_bytes)
        return differs("bytes of constants", call.constants.size(), kernel.constant_bytes);
    if (kernel.buffers > max_kernel_buffers || kernel.targets > max_kernel_targets ||
        kernel.constant_bytes > most_constants || kernel.constant_bytes % 4 != 0)
        return refuse(Error::too_large, verb,
                      "kernel '" + std::string(kernel.name) + "' may have " + std::to_string(max_kernel_buffers) +
                          " buffers, " + std::to_string(max_kernel_targets) + " targets and " +
                          std::to_string(most_constants) + " bytes of constants in fours");
    return Done{};
}

}  // namespace detail

/// How a call's arguments fit the kernel; that their ids exist is for the backend to see.
[[nodiscard]] inline Result<Done> check(Kernel const& kernel, KernelCall const& call) {
    if (auto ok = detail::check_fits("run", kernel, call, max_constant_bytes); !ok) return ok;
    if (call.count > 0xFFFF'FFFFU - kernel_local_size)
        return detail::refuse(Error::too_large, "run", std::to_string(call.count) + " items; 2^32 - 65 may be");
    return Done{};
}

/// What `shade` draws into.
struct ShadedTarget {
    TargetId id;
    TargetConfig const* config = nullptr;
    bool list_has_alpha_tests = false;
};

/// The same of a fragment kernel, and what its target must be.
[[nodiscard]] inline Result<Done> check(FragmentKernel const& kernel, FragmentCall const& call, PassLayer const& layer,
                                        ShadedTarget const& target, Limits const& limits) {
    constexpr std::string_view verb = "shade";
    if (auto ok = check_layer(verb, layer, *target.config, limits); !ok) return ok;
    if (auto ok = detail::check_fits(verb, kernel, call, max_fragment_constant_bytes); !ok) return ok;
    if (!target.config->color) return detail::refuse(Error::bad_argument, verb, "the target has no colours");
    if (layer.range != DepthRange::clip)
        return detail::refuse(Error::bad_argument, verb, "depths are clipped to their range, never clamped");
    if (target.list_has_alpha_tests && call.test == FragmentTest::nearer)
        return detail::refuse(Error::bad_argument, verb,
                              "the list has alpha tests, which early depth tests exclude: draw it, then shade what is visible");
    for (TargetBinding const& binding : call.targets)
        if (binding.target == target.id && binding.plane != Plane::triangle)
            return detail::refuse(Error::bad_argument, verb,
                                  "the kernel reads a plane of target " + std::to_string(target.id.value) +
                                      " that the pass tests or writes");
    return Done{};
}

}  // namespace gnomon::backend
