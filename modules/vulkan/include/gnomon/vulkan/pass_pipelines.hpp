#pragma once
// The pipelines of the raster passes: made once, before the first frame.

#include <gnomon/backend/pass.hpp>
#include <gnomon/vulkan/gpu.hpp>

#include <array>
#include <cstdint>
#include <memory>

namespace gnomon::vulkan {

/// What passes will be asked for. Every yes doubles the number of pipelines, at most 16.
struct PassPipelinesConfig {
    bool f32 = true;           ///< Targets of `DepthFormat::f32`.
    bool unorm16 = true;       ///< Targets of `DepthFormat::unorm16`.
    bool triangle_ids = true;  ///< Targets with triangle ids.
    bool alpha_tests = true;   ///< Draws with an alpha test; without, they are drawn solid.
    bool clamp = true;         ///< `DepthRange::clamp`.
    VkPipelineCache cache = VK_NULL_HANDLE;  ///< The caller's, if there is one.
};

/// How triangles of one call reach the layers of a target: the first that the device can.
enum class LayerMode : std::uint8_t {
    vertex_shader,
    geometry_shader,
    one_by_one,  ///< A rendering for each layer.
};

/// Which of the pipelines.
struct PassKind {
    backend::DepthFormat format = backend::DepthFormat::f32;
    bool triangle_ids = false;
    bool masked = false;
    backend::DepthRange range = backend::DepthRange::clip;
};

class PassPipelines {
  public:
    [[nodiscard]] GpuRef const& gpu() const noexcept { return gpu_; }
    [[nodiscard]] VkDescriptorSetLayout set_layout() const noexcept { return set_layout_.get(); }
    [[nodiscard]] VkPipelineLayout layout() const noexcept { return layout_.get(); }
    /// Null for a kind that the configuration left out. Dynamic state: viewport, scissor, cull mode, depth compare and
    /// write, depth bias and whether there is one.
    [[nodiscard]] VkPipeline get(PassKind const& kind) const noexcept;
    /// Makes the matrices of instances; null where the device has no doubles, and the host makes them.
    [[nodiscard]] VkPipeline instances() const noexcept { return instances_.get(); }

    [[nodiscard]] LayerMode layer_mode() const noexcept { return layer_mode_; }
    /// Whether passes with triangle ids pull corners from buffers, for want of gl_PrimitiveID.
    [[nodiscard]] bool pulls_ids() const noexcept { return !gpu_->features.geometry_shader; }
    [[nodiscard]] bool alpha_tests() const noexcept { return config_.alpha_tests; }
    /// Whether alpha tests are made as the CPU makes them: in double, from the corners of the triangle that
    /// gl_PrimitiveID names. Else in float, from interpolated coordinates.
    [[nodiscard]] bool tests_alpha_exactly() const noexcept {
        return config_.alpha_tests && gpu_->features.shader_float64 && gpu_->features.geometry_shader;
    }

  private:
    friend Result<std::shared_ptr<PassPipelines const>> make_pass_pipelines(GpuRef const& gpu,
                                                                            PassPipelinesConfig const& config);

    GpuRef gpu_;
    PassPipelinesConfig config_;
    LayerMode layer_mode_ = LayerMode::one_by_one;
    UniqueSetLayout set_layout_;
    UniquePipelineLayout layout_;
    UniquePipeline instances_;
    std::array<UniquePipeline, 16> pipelines_;
};

/// Shared by the draw lists that are drawn with them.
using PassPipelinesRef = std::shared_ptr<PassPipelines const>;

/// cost: the driver compiles; tens of milliseconds.
[[nodiscard]] Result<PassPipelinesRef> make_pass_pipelines(GpuRef const& gpu, PassPipelinesConfig const& config = {});

}  // namespace gnomon::vulkan
