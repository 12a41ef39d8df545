#pragma once
// What several of the tests draw, and what they draw on.

#include <gnomon/core/executor.hpp>
#include <gnomon/raster.hpp>

#include "oracle.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace fixture {

using namespace gnomon;
using namespace gnomon::raster;
using oracle::Random;
using Positions = std::vector<math::vec3>;
using Indices = std::vector<std::uint32_t>;

/// What must give the same image.
inline constexpr Kernel every_kernel[] = {Kernel::scalar, Kernel::simd, Kernel::avx2};

struct Canvas {
    std::int32_t width, height;
    std::vector<float> depth;
    std::vector<std::uint32_t> id;
    Workspace workspace;
    PassStats stats;

    Canvas(std::int32_t w, std::int32_t h)
        : width(w),
          height(h),
          depth(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), -7.0F),
          id(depth.size(), 7U) {}

    VisibilityTarget target() {
        return {make_image(depth.data(), width, height), make_image(id.data(), width, height)};
    }

    Canvas& draw(std::vector<Draw> const& draws, PassConfig const& config, core::ExecutorRef executor) {
        stats = camera_pass(draws, target(), config, workspace, executor);
        return *this;
    }
    Canvas& draw(std::vector<Draw> const& draws, PassConfig const& config = {}) {
        core::SerialExecutor serial;
        return draw(draws, config, serial);
    }
    [[nodiscard]] std::uint64_t hash() const { return oracle::hash(depth) * 31 + oracle::hash(id); }
};

inline Draw draw_of(Positions const& positions, Indices const& indices, math::mat4 const& matrix = math::mat4(1.0F)) {
    return {.positions = std::span<math::vec3 const>(positions),
            .indices = std::span<std::uint32_t const>(indices),
            .clip_from_relative = matrix};
}

/// w = -z, near plane at 1/8 m, reversed depth, infinite far plane.
inline math::mat4 camera() {
    math::mat4 m(0.0F);
    m[0][0] = 1.0F;
    m[1][1] = -1.0F;
    m[3][2] = 0.125F;
    m[2][3] = -1.0F;
    return m;
}

/// A scene that takes every path: small, large, clipped, degenerate, equal depths, two draws.
struct Mixed {
    Positions positions;
    Indices indices;

    explicit Mixed(std::uint64_t seed, int count) {
        // Braces, not parentheses: the order of evaluation is part of the scene.
        Random random{seed};
        for (int i = 0; i < count; ++i) {
            float const reach = i % 50 == 0 ? 40.0F : i % 7 == 0 ? 1.0F : 0.05F;
            math::vec3 const at{random.unit() * 6.0F - 3.0F, random.unit() * 6.0F - 3.0F, -random.unit() * 4.0F};
            auto const start = static_cast<std::uint32_t>(positions.size());
            for (int c = 0; c < 3; ++c)
                positions.push_back(at + math::vec3{random.unit() - 0.5F, random.unit() - 0.5F, random.unit() - 0.5F} *
                                             reach);
            for (std::uint32_t c = 0; c < 3; ++c) indices.push_back(start + c);
            if (i % 9 == 0) indices.insert(indices.end(), {start, start + 2, start + 1});  // the same depths again
        }
    }
    [[nodiscard]] std::vector<Draw> draws() const {
        Draw const first = draw_of(positions, indices, camera());
        Draw second = first;
        second.origin = math::vec3(0.25F, -0.5F, 0.75F);
        second.first_triangle = static_cast<std::uint32_t>(triangle_count(first));
        second.cull = Cull::back;
        return {first, second};
    }
};

}  // namespace fixture
