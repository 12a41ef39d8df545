#pragma once
// The backend that does nothing: every verb, every check, no pixel. It shows that the verbs hide neither a rasterizer
// nor a GPU, and times what a technique costs beside them.

#include <gnomon/backend/check.hpp>
#include <gnomon/backend/check_ortho.hpp>
#include <gnomon/backend/slots.hpp>
#include <gnomon/backend/verbs.hpp>

#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace gnomon::backend {

/// Accepts and refuses what the others do, in the same words; reads back zeros; takes 0 ms.
class NullBackend final : public Backend {
  public:
    NullBackend() = default;
    /// With limits of somebody's own, to see a technique meet them.
    explicit NullBackend(Limits const& limits) noexcept : limits_(limits) {}

    [[nodiscard]] std::string_view name() const noexcept override { return "null"; }
    [[nodiscard]] Limits limits() const noexcept override { return limits_; }
    /// How many lists, targets and buffers live.
    [[nodiscard]] std::size_t live() const noexcept { return lists_.size() + targets_.size() + buffers_.size(); }

    Result<DrawListId> keep(std::span<Draw const> draws) override {
        List list;
        list.groups.reserve(draws.size());
        list.triangles.reserve(draws.size());
        for (Draw const& draw : draws) {
            list.groups.push_back(draw.groups);
            list.triangles.push_back(std::uint64_t{triangle_count(draw)} * draw.instances.size());
            list.has_instances = list.has_instances || draw.instances.is_set();
            list.has_alpha_tests = list.has_alpha_tests || draw.alpha_test != nullptr;
        }
        return made(lists_.insert(std::move(list)), "keep");
    }
    Result<TargetId> make_target(TargetConfig const& config) override {
        if (auto ok = check(config, limits_); !ok) return std::move(ok).failure();
        return made(targets_.insert(config), "make_target");
    }
    Result<BufferId> make_buffer(std::size_t bytes) override {
        if (auto ok = check_buffer(bytes, limits_); !ok) return std::move(ok).failure();
        return made(buffers_.insert(bytes), "make_buffer");
    }
    Result<Done> release(DrawListId list) override { return released(lists_.erase(list), "draw list", list.value); }
    Result<Done> release(TargetId target) override { return released(targets_.erase(target), "target", target.value); }
    Result<Done> release(BufferId buffer) override { return released(buffers_.erase(buffer), "buffer", buffer.value); }

    void stage(std::string_view name) override {
        if (!name.empty()) stages_.push_back({name, 0.0});
    }

    Result<Done> write(BufferId buffer, std::size_t offset, std::span<std::byte const> bytes) override {
        std::size_t const* const size = buffers_.find(buffer);
        if (size == nullptr) return unknown_id("write", "buffer", buffer.value);
        return check_range("write", *size, offset, bytes.size());
    }
    Result<PassCounts> draw(DrawListId list, TargetId target, std::span<PassLayer const> layers) override {
        List const* const kept = lists_.find(list);
        if (kept == nullptr) return unknown_id("draw", "draw list", list.value);
        TargetConfig const* const config = targets_.find(target);
        if (config == nullptr) return unknown_id("draw", "target", target.value);
        if (auto ok = check_layers(layers, *config, limits_); !ok) return std::move(ok).failure();
        return kept->counts(layers);
    }
    Result<PassCounts> shade(DrawListId list, TargetId target, PassLayer const& layer, FragmentKernel const& kernel,
                             FragmentCall const& call) override {
        List const* const kept = lists_.find(list);
        if (kept == nullptr) return unknown_id("shade", "draw list", list.value);
        TargetConfig const* const config = targets_.find(target);
        if (config == nullptr) return unknown_id("shade", "target", target.value);
        ShadedTarget const to{target, config, kept->has_alpha_tests};
        if (auto ok = check(kernel, call, layer, to, limits_); !ok) return std::move(ok).failure();
        if (auto ok = check_ids("shade", call.buffers, call.targets); !ok) return std::move(ok).failure();
        return kept->counts({&layer, 1});
    }
    Result<PassCounts> draw_ortho(DrawListId list, TargetId target, std::span<OrthoLayer const> layers) override {
        List const* const kept = lists_.find(list);
        if (kept == nullptr) return unknown_id("draw_ortho", "draw list", list.value);
        TargetConfig const* const config = targets_.find(target);
        if (config == nullptr) return unknown_id("draw_ortho", "target", target.value);
        if (auto ok = check_layers(layers, *config, kept->ortho()); !ok) return std::move(ok).failure();
        PassCounts counts;
        for (OrthoLayer const& layer : layers)
            for_each_draw(layer, kept->triangles.size(), [&](std::size_t i) { counts.triangles += kept->triangles[i]; });
        return counts;
    }
    Result<Done> write_depth(DepthKernel const& kernel, DepthCall const& call) override {
        TargetConfig const* const config = targets_.find(call.to);
        if (config == nullptr) return unknown_id("write_depth", "target", call.to.value);
        if (auto ok = check(kernel, call, *config); !ok) return ok;
        return check_ids("write_depth", call.buffers, call.targets);
    }
    Result<Done> count_samples(std::span<math::Aabb const> boxes, TargetId target, PassLayer const& view,
                               BufferId counts, std::size_t first) override {
        TargetConfig const* const config = targets_.find(target);
        if (config == nullptr) return unknown_id("count_samples", "target", target.value);
        std::size_t const* const size = buffers_.find(counts);
        if (size == nullptr) return unknown_id("count_samples", "buffer", counts.value);
        if (auto ok = check_layer("count_samples", view, *config, limits_); !ok) return ok;
        return check_range("count_samples", *size / 4, first, boxes.size());
    }
    Result<Done> run(Kernel const& kernel, KernelCall const& call) override {
        if (auto ok = check(kernel, call); !ok) return ok;
        return check_ids("run", call.buffers, call.targets);
    }
    Result<Done> copy(TargetPart const& from, TargetId to, std::uint32_t layer, math::ivec2 const& at) override {
        TargetConfig const* const source = targets_.find(from.target);
        if (source == nullptr) return unknown_id("copy", "target", from.target.value);
        TargetConfig const* const goal = targets_.find(to);
        if (goal == nullptr) return unknown_id("copy", "target", to.value);
        Rect const rect{at.x, at.y, from.rect.width, from.rect.height};
        return check_copy(from, *source, {to, layer, from.plane, rect}, *goal);
    }
    Result<Done> read(BufferId buffer, std::size_t offset, std::span<std::byte> out) override {
        std::size_t const* const size = buffers_.find(buffer);
        if (size == nullptr) return unknown_id("read", "buffer", buffer.value);
        if (auto ok = check_range("read", *size, offset, out.size()); !ok) return ok;
        if (!out.empty()) std::memset(out.data(), 0, out.size());
        return Done{};
    }
    Result<Done> read(TargetPart const& part, std::span<std::byte> out) override {
        TargetConfig const* const config = targets_.find(part.target);
        if (config == nullptr) return unknown_id("read", "target", part.target.value);
        if (auto ok = check_read(part, *config, out.size()); !ok) return ok;
        if (!out.empty()) std::memset(out.data(), 0, out.size());
        return Done{};
    }
    Result<std::span<StageTime const>> finish() override {
        finished_.swap(stages_);
        stages_.clear();
        return std::span<StageTime const>(finished_);
    }

  private:
    struct List {
        std::vector<std::uint64_t> groups;
        std::vector<std::uint64_t> triangles;
        bool has_alpha_tests = false;
        bool has_instances = false;

        [[nodiscard]] OrthoList ortho() const noexcept { return {triangles.size(), has_instances}; }

        [[nodiscard]] PassCounts counts(std::span<PassLayer const> layers) const noexcept {
            PassCounts counts;
            for (PassLayer const& layer : layers)
                for (std::size_t i = 0; i < groups.size(); ++i)
                    if ((groups[i] & layer.groups) != 0) counts.triangles += triangles[i];
            return counts;
        }
    };

    /// That the ids of a call exist, and their planes.
    Result<Done> check_ids(std::string_view verb, std::span<BufferId const> buffers,
                           std::span<TargetBinding const> targets) const {
        for (BufferId const buffer : buffers)
            if (buffers_.find(buffer) == nullptr) return unknown_id(verb, "buffer", buffer.value);
        for (TargetBinding const& binding : targets) {
            TargetConfig const* const config = targets_.find(binding.target);
            if (config == nullptr) return unknown_id(verb, "target", binding.target.value);
            if (auto ok = check_part(verb, {binding.target, 0, binding.plane, {}}, *config); !ok) return ok;
        }
        return Done{};
    }

    template <class Id>
    static Result<Id> made(Id id, std::string_view verb) {
        if (id.is_none()) return detail::refuse(Error::out_of_memory, verb, "a million things live: release some");
        return id;
    }
    static Result<Done> released(bool was_there, std::string_view what, std::uint32_t id) {
        if (!was_there) return unknown_id("release", what, id);
        return Done{};
    }

    Limits limits_;
    Slots<DrawListId, List> lists_;
    Slots<TargetId, TargetConfig> targets_;
    Slots<BufferId, std::size_t> buffers_;
    std::vector<StageTime> stages_;
    std::vector<StageTime> finished_;
};

}  // namespace gnomon::backend
