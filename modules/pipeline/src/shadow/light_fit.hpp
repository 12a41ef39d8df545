#pragma once
// Where a light's maps look, and how near its nearest caster is.

#include <gnomon/core/executor.hpp>
#include <gnomon/pipeline/error.hpp>
#include <gnomon/pipeline/frame.hpp>

#include "shadow_map.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace gnomon::pipeline {

/// The smallest distance from a light to the box of a triangle: nothing casts nearer than that. Range by range,
/// of which those that did not move are not looked at again.
class NearestCaster {
  public:
    /// returns: 0 for a directional light, of which nothing depends on it.
    /// cost:    O(triangles) for a light or a geometry that is new, else those of instances that moved.
    double operator()(scene::Geometry const& geometry, LightPlace const& at, core::ExecutorRef executor);

  private:
    std::shared_ptr<void const> identity_;  ///< Of the geometry; kept, so that no other has it.
    math::vec3 light_{0.0F};
    std::vector<std::uint32_t> revisions_;
    std::vector<double> of_range_;
};

/// The views that the maps are drawn with: one of a sun or a spot, six of a point light.
[[nodiscard]] Result<std::vector<math::View>> light_views(Frame const& frame, LightPlace const& at, ShadowMapOptions const& options, double nearest_m);

}  // namespace gnomon::pipeline
