#pragma once
// What a `TileWorkspace` holds.

#include <gnomon/raster/tile_workspace.hpp>

#include "conservative_pass.hpp"
#include "ortho.hpp"
#include "plan.hpp"
#include "tiled.hpp"

#include <cstddef>
#include <vector>

namespace gnomon::raster {

struct TileWorkspace::State {
    detail::Plan plan;
    detail::TiledState<detail::ConservativeRules> conservative;
    std::vector<std::size_t> ends;  // Of an orthographic pass's draws.
    detail::TiledState<detail::OrthoRules> ortho;
};

}  // namespace gnomon::raster
