#pragma once
// Integer passes on both backends: random triangles under random lights, and the texels that differ.

#include <gnomon/raster/ortho.hpp>
#include <gnomon/vulkan/ortho.hpp>

#include "pass_rig.hpp"
#include "pass_scenes.hpp"

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace gnomon::vulkan::test {

using OrthoPasses = std::vector<std::vector<backend::OrthoLayer>>;

class OrthoRig {
  public:
    explicit OrthoRig(Device& device, OrthoPipelinesConfig const& config = {});

    [[nodiscard]] OrthoPipelines const& pipelines() const { return pipelines_; }
    /// A list, a target, the passes one after the other. Layers that no pass clears hold the farthest forward depth.
    [[nodiscard]] std::vector<float> draw(std::span<backend::Draw const> draws, backend::TargetConfig const& config,
                                          OrthoPasses const& passes);

  private:
    Device& device_;
    PassRig rig_;
    OrthoPipelines pipelines_;
};

/// The same by raster::ortho_pass; 16-bit codes as floats.
[[nodiscard]] std::vector<float> draw_ortho_on_cpu(std::span<backend::Draw const> draws, backend::TargetConfig const& config,
                                                   OrthoPasses const& passes, raster::OrthoStats* sum = nullptr);

struct OrthoDifference {
    std::uint64_t texels = 0;
    std::uint64_t written = 0;  ///< Not the farthest.
    std::uint64_t differing = 0;
    float most = 0.0F;  ///< How far two are apart.

    OrthoDifference& operator+=(OrthoDifference const& other) {
        texels += other.texels;
        written += other.written;
        differing += other.differing;
        most = other.most > most ? other.most : most;
        return *this;
    }
    [[nodiscard]] std::string text() const {
        return std::to_string(differing) + " of " + std::to_string(texels) + " texels differ, " + std::to_string(written) +
               " written";
    }
};

[[nodiscard]] OrthoDifference ortho_difference(std::span<float const> cpu, std::span<float const> gpu, float farthest);

/// What is drawn: draws that own their arrays.
struct OrthoScene {
    std::deque<Soup> soups;
    std::deque<std::vector<std::uint8_t>> textures;
    std::deque<backend::AlphaTest> tests;
    std::deque<std::uint32_t> places;  ///< Draw i, for layers that take one.
    std::vector<backend::Draw> draws;
};

/// A light whose image's middle shows `origin_m`, whose code range spans the depths about it.
struct OrthoView {
    backend::OrthoLayer layer;
    math::ivec2 size_px{96, 80};
    double last_code = 65535.0;

    /// From `origin_m` to a point in the image: texels from the left and the top, codes.
    [[nodiscard]] math::vec3 position(double x_px, double y_px, double code) const;
};

/// `far_m`: how far from the world's origin. `plain`: the world's axes and powers of two, so that corners lie on the grid.
[[nodiscard]] OrthoView random_view(Random& random, backend::TargetConfig const& config, double far_m, bool plain);
/// One triangle of a kind: 0 to 11.
void add_triangle(Soup& soup, Random& random, OrthoView const& view, std::uint64_t kind);
inline constexpr std::uint64_t ortho_kinds = 12;
/// An alpha test with a random texture for a soup.
[[nodiscard]] backend::AlphaTest const* add_alpha_test(OrthoScene& scene, Random& random, Soup const& soup);

}  // namespace gnomon::vulkan::test
