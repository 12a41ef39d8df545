#include "tile_workspace.hpp"

namespace gnomon::raster {

TileWorkspace::TileWorkspace() : state_(std::make_unique<State>()) {}
TileWorkspace::~TileWorkspace() = default;
TileWorkspace::TileWorkspace(TileWorkspace&&) noexcept = default;
TileWorkspace& TileWorkspace::operator=(TileWorkspace&&) noexcept = default;

std::size_t TileWorkspace::size_bytes() const noexcept {
    return state_->plan.size_bytes() + state_->conservative.size_bytes() + state_->ortho.size_bytes() +
           state_->ends.capacity() * sizeof(std::size_t);
}

}  // namespace gnomon::raster
