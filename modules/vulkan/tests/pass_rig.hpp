#pragma once
// One scene drawn by both backends, and how the images differ.

#include <gnomon/core/executor.hpp>
#include <gnomon/raster/layers.hpp>
#include <gnomon/vulkan/pass.hpp>

#include "test_device.hpp"

#include <string>
#include <vector>

namespace gnomon::vulkan::test {

/// The pixels of a target, layer by layer; 16-bit codes as floats.
struct Pixels {
    std::vector<float> depth;
    std::vector<std::uint32_t> triangle;
};

struct Difference {
    std::uint64_t pixels = 0;
    std::uint64_t covered = 0;        ///< By the CPU.
    std::uint64_t coverage = 0;       ///< Covered by one of them only.
    std::uint64_t other_surface = 0;  ///< Depths farther apart than 1e-4: an edge between two surfaces.
    std::uint64_t beyond = 0;         ///< Of the rest: farther apart than 2e-6.
    double worst = 0.0;               ///< Of the rest without these.
    std::uint64_t other_id = 0;       ///< Where depths are within 2e-6: two surfaces that tie.

    [[nodiscard]] std::string text() const;
};

/// `farthest`: what a pixel holds where nothing was drawn.
[[nodiscard]] Difference difference_of(Pixels const& cpu, Pixels const& gpu, float farthest);

/// The same of codes: `other_surface` counts those more than 6 apart, `beyond` those more than 1 apart, `worst` is in codes.
[[nodiscard]] Difference difference_of_codes(Pixels const& cpu, Pixels const& gpu, float farthest);

class PassRig {
  public:
    PassRig(Device& device, GpuRef gpu, PassPipelinesConfig const& config = {});

    [[nodiscard]] GpuRef const& gpu() const { return gpu_; }
    [[nodiscard]] PassPipelinesRef const& pipelines() const { return pipelines_; }
    /// Uploaded, its staging released.
    [[nodiscard]] DrawList keep(std::span<backend::Draw const> draws, DrawListConfig const& config = {});
    [[nodiscard]] Target make(backend::TargetConfig const& config);
    backend::PassCounts draw(DrawList& list, Target& target, std::span<backend::PassLayer const> layers,
                             DepthBias const& bias = {});
    [[nodiscard]] Pixels read(Target& target);
    /// All of it: a list, a target, the passes one after the other.
    [[nodiscard]] Pixels draw_all(std::span<backend::Draw const> draws, backend::TargetConfig const& config,
                                  std::span<std::vector<backend::PassLayer> const> passes);

  private:
    Device& device_;
    GpuRef gpu_;
    PassPipelinesRef pipelines_;
};

/// The same on the CPU.
[[nodiscard]] Pixels draw_on_cpu(std::span<backend::Draw const> draws, backend::TargetConfig const& config,
                                 std::span<std::vector<backend::PassLayer> const> passes);

}  // namespace gnomon::vulkan::test
