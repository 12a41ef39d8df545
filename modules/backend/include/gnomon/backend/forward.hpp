#pragma once
// A backend that hands every verb on to another: the base of whoever counts, logs or captures what a technique does.

#include <gnomon/backend/verbs.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon::backend {

/// Override what you watch; ids and answers are the other backend's.
///
/// expects: the other outlives it.
class Forward : public Backend {
  public:
    explicit Forward(Backend& to) noexcept : to_(&to) {}

    [[nodiscard]] Backend& target() const noexcept { return *to_; }

    [[nodiscard]] std::string_view name() const noexcept override { return to_->name(); }
    [[nodiscard]] Limits limits() const noexcept override { return to_->limits(); }

    Result<DrawListId> keep(std::span<Draw const> draws) override { return to_->keep(draws); }
    Result<TargetId> make_target(TargetConfig const& config) override { return to_->make_target(config); }
    Result<BufferId> make_buffer(std::size_t bytes) override { return to_->make_buffer(bytes); }
    Result<Done> release(DrawListId list) override { return to_->release(list); }
    Result<Done> release(TargetId target) override { return to_->release(target); }
    Result<Done> release(BufferId buffer) override { return to_->release(buffer); }

    void stage(std::string_view name) override { to_->stage(name); }
    Result<Done> write(BufferId buffer, std::size_t offset, std::span<std::byte const> bytes) override {
        return to_->write(buffer, offset, bytes);
    }
    Result<PassCounts> draw(DrawListId list, TargetId target, std::span<PassLayer const> layers) override {
        return to_->draw(list, target, layers);
    }
    Result<PassCounts> shade(DrawListId list, TargetId target, PassLayer const& layer, FragmentKernel const& kernel,
                             FragmentCall const& call) override {
        return to_->shade(list, target, layer, kernel, call);
    }
    Result<PassCounts> draw_ortho(DrawListId list, TargetId target, std::span<OrthoLayer const> layers) override {
        return to_->draw_ortho(list, target, layers);
    }
    Result<Done> write_depth(DepthKernel const& kernel, DepthCall const& call) override {
        return to_->write_depth(kernel, call);
    }
    Result<Done> count_samples(std::span<math::Aabb const> boxes, TargetId target, PassLayer const& view,
                               BufferId counts, std::size_t first) override {
        return to_->count_samples(boxes, target, view, counts, first);
    }
    Result<Done> run(Kernel const& kernel, KernelCall const& call) override { return to_->run(kernel, call); }
    Result<Done> copy(TargetPart const& from, TargetId to, std::uint32_t layer, math::ivec2 const& at) override {
        return to_->copy(from, to, layer, at);
    }
    Result<Done> read(BufferId buffer, std::size_t offset, std::span<std::byte> out) override {
        return to_->read(buffer, offset, out);
    }
    Result<Done> read(TargetPart const& part, std::span<std::byte> out) override { return to_->read(part, out); }
    Result<std::span<StageTime const>> finish() override { return to_->finish(); }

  private:
    Backend* to_;
};

}  // namespace gnomon::backend
