#pragma once
// What a `TileWorkspace` holds.

#include <gnomon/raster/tile_workspace.hpp>

#include "conservative_pass.hpp"
#include "plan.hpp"
#include "tiled.hpp"

namespace gnomon::raster {

struct TileWorkspace::State {
    detail::Plan plan;
    detail::TiledState<detail::ConservativeRules> conservative;
};

}  // namespace gnomon::raster
