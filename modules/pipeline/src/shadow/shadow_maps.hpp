#pragma once
// The maps of one light on a backend, and what they are drawn and looked up with.

#include <gnomon/backend/pass.hpp>
#include <gnomon/math/view.hpp>
#include <gnomon/shadow/map_view.hpp>

#include "../cascade/map_pictures.hpp"
#include "../detail.hpp"
#include "../staged.hpp"

#include <memory>
#include <vector>

namespace gnomon::pipeline {

/// Where a light is for its maps: in its frame's place, or where they were drawn from.
struct LightPlace {
    Light light;
    math::vec3 position{0.0F};  ///< As `Frame::light_position`.
    math::vec3 to_light{0.0F};  ///< As `Frame::to_light`.
};

[[nodiscard]] inline LightPlace place_of(Frame const& frame) { return {frame.light, frame.light_position, frame.to_light}; }

/// The maps of one light.
struct ShadowMaps {
    DrawList draws;
    std::shared_ptr<Surfaces const> drawn;  ///< What `draws` were made of.
    raster::Cull cull = raster::Cull::none;
    Held<backend::DrawListId> list;  ///< Of `draws`, which it may point into.
    backend::TargetConfig config;
    Held<backend::TargetId> target;  ///< Made by `config`; a layer for each map.
    LightPlace at;  ///< What `views` were fitted to.
    std::vector<math::View> views;
    std::vector<shadow::MapView> maps;
    std::vector<backend::PassLayer> layers;
    StagedBuffer map_views;
    StagedBuffer visibility;
    StagedBuffer bias_m;
};

/// Of pictures of them.
[[nodiscard]] inline MapFormat format_of(ShadowMaps const& shadow) noexcept {
    math::Depth const depth = shadow.views.empty() ? math::Depth::forward : shadow.views.front().depth;
    return {shadow.config.size_px.x, shadow.config.depth, depth};
}

}  // namespace gnomon::pipeline
