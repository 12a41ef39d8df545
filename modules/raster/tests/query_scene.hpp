#pragma once
// What the query tests look at: a street of boxes on a ground, seen from within, from the air or by the sun.

#include <gnomon/math/bounds.hpp>
#include <gnomon/math/view.hpp>
#include <gnomon/raster/draw.hpp>

#include "oracle.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace query {

namespace math = gnomon::math;
namespace raster = gnomon::raster;

/// Corner order of `math::corner`; two triangles a face.
inline constexpr std::array<std::uint32_t, 36> box_triangles{0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3, 0, 4, 5, 0, 5, 1,
                                                             2, 3, 7, 2, 7, 6, 0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5};

struct Street {
    std::vector<math::Aabb> boxes;
    std::vector<math::vec3> positions;
    std::vector<std::uint32_t> indices;

    Street(std::uint64_t seed, int count) {
        oracle::Random random{seed};
        add({math::vec3(-300, -1, -300), math::vec3(300, 0, 300)});
        for (int i = 0; i < count; ++i) {
            math::vec3 const at{random.unit() * 400.0F - 200.0F, 0.0F, random.unit() * 400.0F - 200.0F};
            math::vec3 const half{2.0F + random.unit() * 8.0F, 0.0F, 2.0F + random.unit() * 8.0F};
            math::vec3 const up{0.0F, 3.0F + random.unit() * 37.0F, 0.0F};
            // Nothing stands on the camera's street.
            if (at.x + half.x > -6.0F && at.x - half.x < 6.0F && count < 1000) continue;
            add({at - half, at + half + up});
        }
    }

    void add(math::Aabb const& box) {
        boxes.push_back(box);
        auto const first = static_cast<std::uint32_t>(positions.size());
        for (unsigned c = 0; c < 8; ++c) positions.push_back(math::corner(box, c));
        for (std::uint32_t const i : box_triangles) indices.push_back(first + i);
        if (boxes.size() == 9000)  // The scene of many triangles: enough for two batches of a small image.
            while (indices.size() < 3 * 140'000) indices.push_back(indices[indices.size() - 36 * 8999]);
    }

    [[nodiscard]] static math::View view(math::Depth depth, math::ivec2 size_px) {
        return math::make_perspective({.eye_m = {0, 1.7, 190},
                                       .target_m = {3, 4, 0},
                                       .near_m = 0.5,
                                       .far_m = 1000.0,
                                       .size_px = size_px,
                                       .depth = depth})
            .value();
    }

    [[nodiscard]] raster::Draw draw(math::View const& view) const {
        return {.positions = std::span<math::vec3 const>(positions),
                .indices = std::span<std::uint32_t const>(indices),
                .origin = math::to_float(view.eye_m),
                .clip_from_relative = math::clip_from_relative(view)};
    }
};

}  // namespace query
