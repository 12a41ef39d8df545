#include "workspace.hpp"

namespace gnomon::pipeline {

Workspace::Workspace() : state_(std::make_unique<State>()) {}
Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

void Workspace::clear() noexcept { state_->clear(); }

backend::Backend& Workspace::own_backend(core::ExecutorRef executor) {
    if (state_->own == nullptr) state_->own = std::make_unique<raster::CpuBackend>(executor);
    state_->own->use(executor);
    return *state_->own;
}

}  // namespace gnomon::pipeline
