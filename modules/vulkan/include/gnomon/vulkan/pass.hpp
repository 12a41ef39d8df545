#pragma once
// The raster passes, recorded: draw lists into the layers of a target.

#include <gnomon/backend/pass.hpp>
#include <gnomon/vulkan/draws.hpp>
#include <gnomon/vulkan/target.hpp>

#include <span>

namespace gnomon::vulkan {

/// What a pass adds to depths before it compares them. Positive moves away from the eye in either depth direction.
struct DepthBias {
    float constant = 0.0F;  ///< In the format's least steps: 2^-16, or 2^-23 of the power of two below the depth.
    float slope = 0.0F;     ///< Times the greater of a pixel's steps in depth across and down.
};

/// Records a pass of `draws` into `target`: clears, then draws, each layer its own view, area and rules.
///
/// A target with triangle ids takes ids too: `Draw::first_triangle` + the triangle's place, on and on from instance to
/// instance. Of equal depths the first drawn stays.
///
/// Outside of a rendering. Leaves the target in `TargetUse::draw`: call `Target::prepare` for what comes next. Binds
/// pipelines, sets and dynamic state of its own.
///
/// expects: `draws` uploaded; layers whose areas share no pixel (`backend::area_of`).
/// returns: what was asked for and the calls recorded; or `bad_argument` for a layer that is not there or pipelines that
///          were not made, `too_large` for a viewport beyond the device's; then nothing was recorded.
/// cost:    no allocation. Layers that share viewport, scissor and rules take one call together for each kind of draw
///          (culling, alpha test), `DrawListConfig::max_layers` at a time; areas of an atlas one each.
[[nodiscard]] Result<backend::PassCounts> record_pass(VkCommandBuffer commands, DrawList& draws, Target& target,
                                                      std::span<backend::PassLayer const> layers,
                                                      DepthBias const& bias = {});

}  // namespace gnomon::vulkan
