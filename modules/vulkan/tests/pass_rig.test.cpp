#include "pass_rig.hpp"

#include <gnomon/backend/check.hpp>
#include <gnomon/check/check.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace gnomon::vulkan::test {

namespace {

std::size_t pixels_of(backend::TargetConfig const& config) {
    return static_cast<std::size_t>(config.size_px.x) * static_cast<std::size_t>(config.size_px.y) * config.layers;
}

raster::Layer cpu_layer(backend::PassLayer const& layer, backend::TargetConfig const& config, Pixels& pixels,
                        std::vector<std::uint16_t>& codes) {
    std::int32_t const width = config.size_px.x;
    std::int32_t const height = config.size_px.y;
    auto const offset = static_cast<std::ptrdiff_t>(pixels_of(config) / config.layers * layer.layer);
    raster::DepthTarget const target = config.depth == backend::DepthFormat::f32
                                           ? raster::DepthTarget(raster::make_image(pixels.depth.data() + offset, width, height))
                                           : raster::DepthTarget(raster::make_image(codes.data() + offset, width, height));
    raster::Layer made{.target = target};
    if (config.triangle_ids) made.triangle = raster::make_image(pixels.triangle.data() + offset, width, height);
    made.origin = layer.origin;
    made.clip_from_relative = layer.clip_from_relative;
    made.groups = layer.groups;
    made.config.depth = layer.depth;
    made.config.range = layer.range;
    made.config.load = layer.load;
    made.config.viewport = layer.viewport;
    made.config.scissor = backend::area_of(layer, config.size_px);
    return made;
}

}  // namespace

std::string Difference::text() const {
    return std::to_string(covered) + " of " + std::to_string(pixels) + " px covered; coverage " + std::to_string(coverage) +
           ", other surface " + std::to_string(other_surface) + ", beyond 2e-6 " + std::to_string(beyond) + ", worst " +
           std::to_string(worst * 1e6) + "e-6, other id " + std::to_string(other_id);
}

namespace {

struct Bounds {
    double other_surface;
    double beyond;
};

Difference compare(Pixels const& cpu, Pixels const& gpu, float farthest, Bounds const& bounds) {
    Difference d;
    d.pixels = cpu.depth.size();
    for (std::size_t i = 0; i < cpu.depth.size(); ++i) {
        float const a = cpu.depth[i];
        float const b = gpu.depth[i];
        d.covered += a != farthest ? 1U : 0U;
        if ((a != farthest) != (b != farthest)) {
            ++d.coverage;
            continue;
        }
        double const apart = std::abs(static_cast<double>(a) - static_cast<double>(b));
        if (!(apart < bounds.other_surface)) {
            ++d.other_surface;
            continue;
        }
        if (apart > bounds.beyond) ++d.beyond;
        else d.worst = std::max(d.worst, apart);
        if (!cpu.triangle.empty() && cpu.triangle[i] != gpu.triangle[i]) ++d.other_id;
    }
    return d;
}

}  // namespace

Difference difference_of(Pixels const& cpu, Pixels const& gpu, float farthest) {
    return compare(cpu, gpu, farthest, {1e-4, 2e-6});
}

Difference difference_of_codes(Pixels const& cpu, Pixels const& gpu, float farthest) {
    return compare(cpu, gpu, farthest, {6.5, 1.5});
}

PassRig::PassRig(Device& device, GpuRef gpu, PassPipelinesConfig const& config) : device_(device), gpu_(std::move(gpu)) {
    auto made = make_pass_pipelines(gpu_, config);
    REQUIRE(made);
    pipelines_ = *std::move(made);
}

DrawList PassRig::keep(std::span<backend::Draw const> draws, DrawListConfig const& config) {
    auto list = make_draw_list(pipelines_, draws, config);
    REQUIRE(list);
    list->record_upload(device_.begin());
    device_.submit_and_wait();
    list->release_staging();
    return *std::move(list);
}

Target PassRig::make(backend::TargetConfig const& config) {
    auto target = make_target(gpu_, config);
    REQUIRE(target);
    return *std::move(target);
}

backend::PassCounts PassRig::draw(DrawList& list, Target& target, std::span<backend::PassLayer const> layers,
                                  DepthBias const& bias) {
    auto const counts = record_pass(device_.begin(), list, target, layers, bias);
    device_.submit_and_wait();
    REQUIRE(counts);
    return *counts;
}

Pixels PassRig::read(Target& target) {
    backend::TargetConfig const& config = target.config();
    std::size_t const count = pixels_of(config);
    std::size_t const depth_bytes = count * backend::bytes_per_pixel(config, backend::Plane::depth);
    std::size_t const ids_at = (depth_bytes + 3) / 4 * 4;
    auto buffer = make_buffer(gpu_, ids_at + count * 4, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::read_back);
    REQUIRE(buffer);
    VkCommandBuffer commands = device_.begin();
    target.prepare(commands, TargetUse::copy_from);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, config.layers};
    region.imageExtent = {static_cast<std::uint32_t>(config.size_px.x), static_cast<std::uint32_t>(config.size_px.y), 1};
    gpu_->call.CmdCopyImageToBuffer(commands, target.depth_image(), target.layout(), buffer->handle.get(), 1, &region);
    region.bufferOffset = ids_at;
    region.imageSubresource.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
    if (config.triangle_ids)
        gpu_->call.CmdCopyImageToBuffer(commands, target.triangle_image(), target.layout(), buffer->handle.get(), 1, &region);
    device_.submit_and_wait();
    REQUIRE(invalidate(*gpu_, buffer->allocation.memory(), 0, buffer->size));
    Pixels pixels;
    pixels.depth.resize(count);
    if (config.depth == backend::DepthFormat::f32) {
        std::memcpy(pixels.depth.data(), buffer->mapped().data(), depth_bytes);
    } else {
        std::vector<std::uint16_t> codes(count);
        std::memcpy(codes.data(), buffer->mapped().data(), depth_bytes);
        std::copy(codes.begin(), codes.end(), pixels.depth.begin());
    }
    if (config.triangle_ids) {
        pixels.triangle.resize(count);
        std::memcpy(pixels.triangle.data(), buffer->mapped().data() + ids_at, count * 4);
    }
    return pixels;
}

Pixels PassRig::draw_all(std::span<backend::Draw const> draws, backend::TargetConfig const& config,
                         std::span<std::vector<backend::PassLayer> const> passes) {
    DrawList list = keep(draws);
    Target target = make(config);
    for (auto const& layers : passes) draw(list, target, layers);
    return read(target);
}

Pixels draw_on_cpu(std::span<backend::Draw const> draws, backend::TargetConfig const& config,
                   std::span<std::vector<backend::PassLayer> const> passes) {
    bool const reversed = passes.front().front().depth == math::Depth::reversed;
    bool const is_f32 = config.depth == backend::DepthFormat::f32;
    Pixels pixels;
    pixels.depth.assign(pixels_of(config), reversed ? 0.0F : 1.0F);
    if (config.triangle_ids) pixels.triangle.assign(pixels_of(config), backend::no_triangle);
    std::vector<std::uint16_t> codes(is_f32 ? 0 : pixels_of(config), reversed ? 0 : 65535);
    raster::Workspace workspace;
    core::SerialExecutor serial;
    for (auto const& pass : passes) {
        std::vector<raster::Layer> layers;
        for (backend::PassLayer const& layer : pass) layers.push_back(cpu_layer(layer, config, pixels, codes));
        raster::layered_pass(draws, layers, workspace, serial);
    }
    if (!is_f32) std::copy(codes.begin(), codes.end(), pixels.depth.begin());
    return pixels;
}

}  // namespace gnomon::vulkan::test
