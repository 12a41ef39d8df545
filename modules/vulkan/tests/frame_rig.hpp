#pragma once
// A frame that uses every verb, the same over and over, for what is counted and timed.

#include "pass_scenes.hpp"
#include "test_kernels.hpp"

#include <gnomon/backend/verbs.hpp>
#include <gnomon/math/bounds.hpp>
#include <gnomon/vulkan/backend.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::vulkan::test {

/// A host that has no device: what is recorded goes nowhere.
inline Host null_host() {
    return {nullptr,
            [](void*, VkCommandBuffer& out) {
                out = reinterpret_cast<VkCommandBuffer>(8);
                return VK_SUCCESS;
            },
            [](void*, VkCommandBuffer) { return VK_SUCCESS; }};
}

/// Resources of a backend, and verbs over them. `step` gives the first failure.
class FrameRig {
  public:
    /// `batches` draws of one soup: every other one culled.
    backend::Result<core::Done> make(backend::Backend& b, std::size_t batches) {
        soup_ = make_soup(1, 8, 0.5F);
        draws_.assign(batches, soup_.draw());
        for (std::size_t i = 0; i < batches; i += 2) draws_[i].cull = backend::Cull::back;
        auto list = b.keep(draws_);
        if (!list) return std::move(list).failure();
        list_ = *list;
        for (backend::TargetId* target : {&targets_[0], &targets_[1]}) {
            auto made = b.make_target({.size_px = {64, 32}, .layers = 2, .triangle_ids = target == &targets_[1]});
            if (!made) return std::move(made).failure();
            *target = *made;
        }
        for (backend::BufferId* buffer : {&buffers_[0], &buffers_[1]}) {
            auto made = b.make_buffer(64 * 32 * 4);
            if (!made) return std::move(made).failure();
            *buffer = *made;
        }
        read_.resize(64 * 32 * 4);
        return core::Done{};
    }

    /// Two layers of each target.
    backend::Result<backend::PassCounts> draw(backend::Backend& b, std::size_t target) {
        backend::PassLayer layers[2] = {layer_of(camera({64, 32})), layer_of(camera({64, 32}))};
        layers[1].layer = 1;
        return b.draw(list_, targets_[target], layers);
    }

    /// Every verb but those that make and release; ends the frame.
    backend::Result<core::Done> step(backend::Backend& b) {
        auto const failed = [&](auto&& result) {
            if (result) return false;
            failure_ = result.failure();
            return true;
        };
        b.stage("draw");
        for (std::size_t target : {std::size_t{0}, std::size_t{1}})
            if (failed(draw(b, target))) return failure_;
        backend::OrthoLayer const whole;
        if (failed(b.draw_ortho(list_, targets_[0], {&whole, 1}))) return failure_;
        backend::TargetPart const part{targets_[0], 0, backend::Plane::depth, {0, 0, 16, 16}};
        if (failed(b.copy(part, targets_[1], 1, {3, 4}))) return failure_;
        backend::TargetBinding const old{targets_[0]};
        std::int32_t const scroll[8] = {3, -2, 0, 0x3F80'0000, 32};  // texels; by depth 0 of 1
        backend::DepthCall const moved{.to = targets_[1], .rect = {8, 0, 32, 32}, .targets = {&old, 1}, .constants = std::as_bytes(std::span(scroll))};
        if (failed(b.write_depth(scroll_map_kernel, moved))) return failure_;
        math::Aabb const boxes[] = {{{-1, -1, -4}, {1, 1, -3}}, {{-9, -9, -90}, {9, 9, -80}}};
        backend::PassLayer const view = layer_of(camera({64, 32}));
        if (failed(b.count_samples(boxes, targets_[0], view, buffers_[1], 0))) return failure_;
        b.stage("kernels");
        for (std::uint32_t i = 0; i < 70; ++i) {
            if (failed(b.write(buffers_[0], i * 4, std::as_bytes(std::span(boxes))))) return failure_;
            Affine const affine{500, 3, i};
            backend::BufferId const there[] = {buffers_[i % 2], buffers_[1 - i % 2]};
            if (failed(b.run(affine_kernel, {500, there, {}, backend::bytes_of(affine)}))) return failure_;
        }
        backend::TargetBinding const in{targets_[1]};
        Covered const covered{64, 32, 1};
        if (failed(b.run(covered_kernel, {64 * 32, {buffers_, 1}, {&in, 1}, backend::bytes_of(covered)})))
            return failure_;
        b.stage("read");
        if (failed(b.read(buffers_[0], 0, read_))) return failure_;
        if (failed(b.read({targets_[1], 0, backend::Plane::triangle, {0, 0, 64, 32}}, read_))) return failure_;
        if (failed(b.finish())) return failure_;
        return core::Done{};
    }

  private:
    Soup soup_;
    std::vector<backend::Draw> draws_;
    backend::DrawListId list_;
    backend::TargetId targets_[2];
    backend::BufferId buffers_[2];
    std::vector<std::byte> read_;
    core::Failure<backend::Error> failure_{};
};

}  // namespace gnomon::vulkan::test
