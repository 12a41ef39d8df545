#include <gnomon/raster/cpu_backend.hpp>

#include <gnomon/backend/check_ortho.hpp>
#include <gnomon/backend/slots.hpp>
#include <gnomon/raster/alpha_map.hpp>
#include <gnomon/raster/layers.hpp>
#include <gnomon/raster/ortho.hpp>
#include <gnomon/raster/sample_query.hpp>

#include "shading.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::raster {

using backend::BufferId;
using backend::Done;
using backend::DrawListId;
using backend::Error;
using backend::PassLayer;
using backend::Plane;
using backend::Result;
using backend::StageTime;
using backend::TargetConfig;
using backend::TargetId;
using backend::TargetPart;

namespace {

using Clock = std::chrono::steady_clock;

/// Zeroed bytes, or none where there is no room: a size that a user asked for is no reason to end the program.
class Bytes {
  public:
    Bytes() = default;
    explicit Bytes(std::size_t size)
        : data_(static_cast<std::byte*>(::operator new (size, std::align_val_t{64}, std::nothrow))), size_(size) {
        if (data_ != nullptr) std::memset(data_, 0, size);
    }
    Bytes(Bytes&& other) noexcept : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
    Bytes& operator=(Bytes&& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        return *this;
    }
    ~Bytes() { ::operator delete (data_, std::align_val_t{64}); }

    [[nodiscard]] bool is_missing() const noexcept { return data_ == nullptr; }
    [[nodiscard]] std::byte* data() const noexcept { return data_; }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }

  private:
    std::byte* data_ = nullptr;
    std::size_t size_ = 0;
};

struct List {
    std::vector<AlphaTest> tests;                 // Pointed to by `draws`.
    std::vector<std::unique_ptr<AlphaMap>> maps;  // Pointed to by `tests`; one for each that differs.
    std::vector<Draw> draws;

    [[nodiscard]] backend::OrthoList ortho() const noexcept {
        bool const some = std::any_of(draws.begin(), draws.end(), [](Draw const& d) { return d.instances.is_set(); });
        return {draws.size(), some};
    }
};

struct Target {
    TargetConfig config;
    Bytes depth;
    Bytes triangle;
    Bytes color;

    [[nodiscard]] std::size_t pixels() const noexcept {
        return static_cast<std::size_t>(config.size_px.x) * static_cast<std::size_t>(config.size_px.y);
    }
    template <class T>
    [[nodiscard]] ImageView<T> image(Bytes const& bytes, std::uint32_t layer) const noexcept {
        return make_image(reinterpret_cast<T*>(bytes.data()) + layer * pixels(), config.size_px.x, config.size_px.y);
    }
    [[nodiscard]] DepthTarget depth_target(std::uint32_t layer) const noexcept {
        if (config.depth == backend::DepthFormat::unorm16) return image<std::uint16_t>(depth, layer);
        return image<float>(depth, layer);
    }
    [[nodiscard]] Layer layer(PassLayer const& pass) const noexcept {
        Layer layer{.target = depth_target(pass.layer),
                    .origin = pass.origin,
                    .clip_from_relative = pass.clip_from_relative,
                    .groups = pass.groups};
        if (config.triangle_ids) layer.triangle = image<std::uint32_t>(triangle, pass.layer);
        layer.config.depth = pass.depth;
        layer.config.range = pass.range;
        layer.config.load = pass.load;
        layer.config.viewport = pass.viewport;
        layer.config.subpixel = pass.subpixel;
        layer.config.scissor = backend::area_of(pass, config.size_px);
        return layer;
    }
    [[nodiscard]] Bytes const& bytes(Plane plane) const noexcept {
        return plane == Plane::depth ? depth : plane == Plane::triangle ? triangle : color;
    }
    [[nodiscard]] backend::TexelView view(Plane plane) const noexcept {
        return {bytes(plane).data(), config.size_px, config.layers, config.depth, plane};
    }
    /// The first byte of a row of a part, `y` rows from its top.
    [[nodiscard]] std::byte* row(TargetPart const& part, std::int32_t y) const noexcept {
        std::size_t const at = part.layer * pixels() +
                               static_cast<std::size_t>(part.rect.y + y) * static_cast<std::size_t>(config.size_px.x) +
                               static_cast<std::size_t>(part.rect.x);
        return bytes(part.plane).data() + at * bytes_per_pixel(config, part.plane);
    }
    [[nodiscard]] std::size_t row_bytes(TargetPart const& part) const noexcept {
        return static_cast<std::size_t>(part.rect.width) * bytes_per_pixel(config, part.plane);
    }
};

/// Many draws share few textures: a map is made where none serves yet.
AlphaMap const* map_of(List& list, AlphaTest const& test) {
    for (auto const& map : list.maps)
        if (map->is_of(test)) return map.get();
    list.maps.push_back(std::make_unique<AlphaMap>(make_alpha_map(test)));
    return list.maps.back().get();
}

template <class Id>
Result<Id> made(Id id, std::string_view verb) {
    if (!id.is_none()) return id;
    return core::Failure{Error::out_of_memory, std::string(verb) + ": a million things live: release some"};
}

core::Failure<Error> no_room(std::string_view verb, std::uint64_t bytes) {
    return {Error::out_of_memory,
            std::string(verb) + ": no room for " + std::to_string(bytes) + " bytes: release something or ask for less"};
}

Result<Done> released(bool was_there, std::string_view what, std::uint32_t id) {
    if (!was_there) return backend::unknown_id("release", what, id);
    return Done{};
}

}  // namespace

/// The buffers and targets of a kernel's call.
struct Bound {
    std::array<std::span<std::byte>, backend::max_kernel_buffers> buffers;
    std::array<backend::TexelView, backend::max_kernel_targets> targets;
    std::size_t buffer_count = 0, target_count = 0;

    [[nodiscard]] backend::KernelData data(std::span<std::byte const> constants) const noexcept {
        return {std::span(buffers).first(buffer_count), std::span(targets).first(target_count), constants};
    }
};

struct CpuBackend::State {
    explicit State(core::ExecutorRef e) : executor(e) {}

    core::ExecutorRef executor;
    backend::Slots<DrawListId, List> lists;
    backend::Slots<TargetId, Target> targets;
    backend::Slots<BufferId, Bytes> buffers;
    Workspace passes;
    QueryWorkspace queries;
    TileWorkspace tiles;
    std::vector<OrthoDraw> ortho_draws;
    std::vector<Layer> layers;
    std::vector<std::uint64_t> counts;
    std::vector<StageTime> stages;
    std::vector<StageTime> finished;
    Clock::time_point begun;
    bool timing = false;  // The last of `stages` goes on.

    Result<Done> bind(std::string_view verb, std::span<BufferId const> ids, std::span<backend::TargetBinding const> bindings,
                      Bound& bound) const {
        for (BufferId const id : ids) {
            Bytes const* const bytes = buffers.find(id);
            if (bytes == nullptr) return backend::unknown_id(verb, "buffer", id.value);
            bound.buffers[bound.buffer_count++] = {bytes->data(), bytes->size()};
        }
        for (backend::TargetBinding const& binding : bindings) {
            Target const* const target = targets.find(binding.target);
            if (target == nullptr) return backend::unknown_id(verb, "target", binding.target.value);
            if (auto ok = backend::check_part(verb, {binding.target, 0, binding.plane, {}}, target->config); !ok) return ok;
            bound.targets[bound.target_count++] = target->view(binding.plane);
        }
        return Done{};
    }

    void end_stage() {
        Clock::time_point const now = Clock::now();
        if (timing) stages.back().ms = std::chrono::duration<double, std::milli>(now - begun).count();
        timing = false;
        begun = now;
    }
};

CpuBackend::CpuBackend(core::ExecutorRef executor) : state_(std::make_unique<State>(executor)) {}
CpuBackend::~CpuBackend() = default;

void CpuBackend::use(core::ExecutorRef executor) noexcept { state_->executor = executor; }
std::size_t CpuBackend::live() const noexcept {
    return state_->lists.size() + state_->targets.size() + state_->buffers.size();
}
std::string_view CpuBackend::name() const noexcept { return "cpu"; }
backend::Limits CpuBackend::limits() const noexcept { return {.target_px = max_size_px}; }

Result<DrawListId> CpuBackend::keep(std::span<Draw const> draws) {
    List list;
    list.draws.assign(draws.begin(), draws.end());
    list.tests.reserve(draws.size());
    for (Draw& draw : list.draws) {
        if (draw.alpha_test == nullptr) continue;
        list.tests.push_back(*draw.alpha_test);
        AlphaTest& test = list.tests.back();
        if (test.map == nullptr && math::is_complete(test.texture)) test.map = map_of(list, test);
        draw.alpha_test = &test;
    }
    return made(state_->lists.insert(std::move(list)), "keep");
}

Result<TargetId> CpuBackend::make_target(TargetConfig const& config) {
    if (auto ok = backend::check(config, limits()); !ok) return std::move(ok).failure();
    Target target{config, {}, {}, {}};
    std::size_t const pixels = target.pixels() * config.layers;
    std::size_t bytes = 0;
    auto const make = [&](bool wanted, Bytes& plane, Plane which) {
        if (wanted) plane = Bytes(pixels * bytes_per_pixel(config, which));
        bytes += wanted ? pixels * bytes_per_pixel(config, which) : 0;
        return !wanted || !plane.is_missing();
    };
    bool const fits_depth = make(true, target.depth, Plane::depth);
    bool const fits_ids = make(config.triangle_ids, target.triangle, Plane::triangle);
    bool const fits_color = make(config.color, target.color, Plane::color);
    if (!fits_depth || !fits_ids || !fits_color) return no_room("make_target", bytes);
    return made(state_->targets.insert(std::move(target)), "make_target");
}

Result<BufferId> CpuBackend::make_buffer(std::size_t bytes) {
    if (auto ok = backend::check_buffer(bytes, limits()); !ok) return std::move(ok).failure();
    Bytes memory(bytes);
    if (memory.is_missing()) return no_room("make_buffer", bytes);
    return made(state_->buffers.insert(std::move(memory)), "make_buffer");
}

Result<Done> CpuBackend::release(DrawListId list) {
    return released(state_->lists.erase(list), "draw list", list.value);
}
Result<Done> CpuBackend::release(TargetId target) {
    return released(state_->targets.erase(target), "target", target.value);
}
Result<Done> CpuBackend::release(BufferId buffer) {
    return released(state_->buffers.erase(buffer), "buffer", buffer.value);
}

void CpuBackend::stage(std::string_view name) {
    state_->end_stage();
    if (name.empty()) return;
    state_->stages.push_back({name, 0.0});
    state_->timing = true;
}

Result<Done> CpuBackend::write(BufferId buffer, std::size_t offset, std::span<std::byte const> bytes) {
    Bytes const* const to = state_->buffers.find(buffer);
    if (to == nullptr) return backend::unknown_id("write", "buffer", buffer.value);
    if (auto ok = backend::check_range("write", to->size(), offset, bytes.size()); !ok) return ok;
    if (!bytes.empty()) std::memcpy(to->data() + offset, bytes.data(), bytes.size());
    return Done{};
}

Result<backend::PassCounts> CpuBackend::draw(DrawListId list, TargetId target, std::span<PassLayer const> layers) {
    List const* const kept = state_->lists.find(list);
    if (kept == nullptr) return backend::unknown_id("draw", "draw list", list.value);
    Target const* const to = state_->targets.find(target);
    if (to == nullptr) return backend::unknown_id("draw", "target", target.value);
    if (auto ok = backend::check_layers(layers, to->config, limits()); !ok) return std::move(ok).failure();
    backend::PassCounts counts;
    state_->layers.clear();
    for (PassLayer const& layer : layers) {
        state_->layers.push_back(to->layer(layer));
        for (Draw const& draw : kept->draws) {
            if ((draw.groups & layer.groups) == 0) continue;
            counts.triangles += std::uint64_t{triangle_count(draw)} * draw.instances.size();
            ++counts.draw_calls;
        }
    }
    layered_pass(kept->draws, state_->layers, state_->passes, state_->executor);
    return counts;
}

Result<backend::PassCounts> CpuBackend::shade(DrawListId list, TargetId target, PassLayer const& layer,
                                              backend::FragmentKernel const& kernel, backend::FragmentCall const& call) {
    List const* const kept = state_->lists.find(list);
    if (kept == nullptr) return backend::unknown_id("shade", "draw list", list.value);
    Target const* const to = state_->targets.find(target);
    if (to == nullptr) return backend::unknown_id("shade", "target", target.value);
    backend::ShadedTarget const shaded{target, &to->config, !kept->tests.empty()};
    if (auto ok = backend::check(kernel, call, layer, shaded, limits()); !ok) return std::move(ok).failure();
    if (kernel.cpu == nullptr)
        return core::Failure{Error::missing_feature, "shade: kernel '" + std::string(kernel.name) + "' has no C++ half"};
    Bound bound;
    if (auto ok = state_->bind("shade", call.buffers, call.targets, bound); !ok) return std::move(ok).failure();
    backend::KernelData const data = bound.data(call.constants);
    ImageView<math::vec4> const color = to->image<math::vec4>(to->color, layer.layer);
    Layer drawn = to->layer(layer);
    drawn.triangle = {};
    if (call.color == backend::Load::clear) {
        backend::Rect const area = backend::area_of(layer, to->config.size_px);
        for (std::int32_t y = area.y; y < area.y + area.height; ++y)
            std::fill_n(color.row(y) + area.x, area.width, math::vec4(0.0F));
    }
    shading_pass(kept->draws, drawn, {kernel.cpu, &data, color, call.test, call.blend}, state_->passes, state_->executor);
    backend::PassCounts counts;
    for (Draw const& draw : kept->draws) {
        if ((draw.groups & layer.groups) == 0) continue;
        counts.triangles += std::uint64_t{triangle_count(draw)} * draw.instances.size();
        ++counts.draw_calls;
    }
    return counts;
}

Result<backend::PassCounts> CpuBackend::draw_ortho(DrawListId list, TargetId target,
                                                   std::span<backend::OrthoLayer const> layers) {
    List const* const kept = state_->lists.find(list);
    if (kept == nullptr) return backend::unknown_id("draw_ortho", "draw list", list.value);
    Target const* const to = state_->targets.find(target);
    if (to == nullptr) return backend::unknown_id("draw_ortho", "target", target.value);
    if (auto ok = backend::check_layers(layers, to->config, kept->ortho()); !ok) return std::move(ok).failure();
    backend::PassCounts counts;
    for (backend::OrthoLayer const& layer : layers) {
        state_->ortho_draws.clear();
        backend::for_each_draw(layer, kept->draws.size(), [&](std::size_t i) {
            Draw const& draw = kept->draws[i];
            state_->ortho_draws.push_back({draw.positions, draw.indices, layer.origin_m, draw.cull, draw.alpha_test});
            counts.triangles += triangle_count(draw);
            ++counts.draw_calls;
        });
        OrthoConfig const config{layer.depth, layer.range, layer.load, layer.scissor};
        ortho_pass(state_->ortho_draws, layer.light, to->depth_target(layer.layer), config, state_->tiles, state_->executor);
    }
    return counts;
}

Result<Done> CpuBackend::write_depth(backend::DepthKernel const& kernel, backend::DepthCall const& call) {
    Target const* const to = state_->targets.find(call.to);
    if (to == nullptr) return backend::unknown_id("write_depth", "target", call.to.value);
    if (auto ok = backend::check(kernel, call, to->config); !ok) return ok;
    if (kernel.cpu == nullptr)
        return core::Failure{Error::missing_feature,
                             "write_depth: kernel '" + std::string(kernel.name) + "' has no C++ half"};
    Bound bound;
    if (auto ok = state_->bind("write_depth", call.buffers, call.targets, bound); !ok) return ok;
    backend::KernelData const data = bound.data(call.constants);
    TargetPart const part{call.to, call.layer, Plane::depth, call.rect};
    constexpr std::size_t rows_a_task = 16;
    state_->executor.parallel_for(static_cast<std::size_t>(call.rect.height), rows_a_task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
            kernel.cpu(data, {to->row(part, static_cast<std::int32_t>(y)), call.rect.x,
                              call.rect.y + static_cast<std::int32_t>(y), call.rect.width, to->config.depth});
    });
    return Done{};
}

Result<Done> CpuBackend::count_samples(std::span<math::Aabb const> boxes, TargetId target, PassLayer const& view,
                                       BufferId counts, std::size_t first) {
    Target const* const in = state_->targets.find(target);
    if (in == nullptr) return backend::unknown_id("count_samples", "target", target.value);
    Bytes const* const out = state_->buffers.find(counts);
    if (out == nullptr) return backend::unknown_id("count_samples", "buffer", counts.value);
    if (auto ok = backend::check_layer("count_samples", view, in->config, limits()); !ok) return ok;
    if (auto ok = backend::check_range("count_samples", out->size() / 4, first, boxes.size()); !ok) return ok;
    state_->counts.resize(boxes.size());
    count_samples_passing(boxes, in->layer(view), state_->counts, state_->queries, state_->executor);
    auto* const to = reinterpret_cast<std::uint32_t*>(out->data()) + first;
    for (std::size_t i = 0; i < boxes.size(); ++i) to[i] = static_cast<std::uint32_t>(state_->counts[i]);
    return Done{};
}

Result<Done> CpuBackend::run(backend::Kernel const& kernel, backend::KernelCall const& call) {
    if (auto ok = backend::check(kernel, call); !ok) return ok;
    if (kernel.cpu == nullptr)
        return core::Failure{Error::missing_feature, "run: kernel '" + std::string(kernel.name) + "' has no C++ half"};
    Bound bound;
    if (auto ok = state_->bind("run", call.buffers, call.targets, bound); !ok) return ok;
    backend::KernelData const data = bound.data(call.constants);
    state_->executor.parallel_for(call.count, kernel.grain,
                                  [&](std::size_t begin, std::size_t end) { kernel.cpu(data, begin, end); });
    return Done{};
}

Result<Done> CpuBackend::copy(TargetPart const& from, TargetId to, std::uint32_t layer, math::ivec2 const& at) {
    Target const* const source = state_->targets.find(from.target);
    if (source == nullptr) return backend::unknown_id("copy", "target", from.target.value);
    Target const* const goal = state_->targets.find(to);
    if (goal == nullptr) return backend::unknown_id("copy", "target", to.value);
    TargetPart const part{to, layer, from.plane, {at.x, at.y, from.rect.width, from.rect.height}};
    if (auto ok = backend::check_copy(from, source->config, part, goal->config); !ok) return ok;
    for (std::int32_t y = 0; y < part.rect.height; ++y)
        std::memcpy(goal->row(part, y), source->row(from, y), source->row_bytes(from));
    return Done{};
}

Result<Done> CpuBackend::read(BufferId buffer, std::size_t offset, std::span<std::byte> out) {
    Bytes const* const from = state_->buffers.find(buffer);
    if (from == nullptr) return backend::unknown_id("read", "buffer", buffer.value);
    if (auto ok = backend::check_range("read", from->size(), offset, out.size()); !ok) return ok;
    if (!out.empty()) std::memcpy(out.data(), from->data() + offset, out.size());
    return Done{};
}

Result<Done> CpuBackend::read(TargetPart const& part, std::span<std::byte> out) {
    Target const* const from = state_->targets.find(part.target);
    if (from == nullptr) return backend::unknown_id("read", "target", part.target.value);
    if (auto ok = backend::check_read(part, from->config, out.size()); !ok) return ok;
    std::size_t const bytes = from->row_bytes(part);
    if (bytes == 0) return Done{};
    for (std::int32_t y = 0; y < part.rect.height; ++y)
        std::memcpy(out.data() + static_cast<std::size_t>(y) * bytes, from->row(part, y), bytes);
    return Done{};
}

Result<std::span<StageTime const>> CpuBackend::finish() {
    state_->end_stage();
    state_->finished.swap(state_->stages);
    state_->stages.clear();
    return std::span<StageTime const>(state_->finished);
}

}  // namespace gnomon::raster
