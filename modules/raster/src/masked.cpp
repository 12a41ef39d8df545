#include "masked.hpp"

#include "sample_loop.hpp"

#include <gnomon/math/texel.hpp>

namespace gnomon::raster::detail {

namespace {

/// weight[i] . (x, y, 1): the weight of corner i at a point of normalized device space, up to a common factor.
struct CornerWeights {
    double weight[3][3];
    math::vec2 uv[3];
};

CornerWeights make_corner_weights(MaskedDraw const& draw, std::uint32_t triangle) {
    CornerWeights made{};
    double c[3][3];
    for (std::size_t i = 0; i < 3; ++i) {
        std::size_t const at = std::size_t{triangle} * 3 + i;
        std::size_t const index = draw.indices.empty() ? at : draw.indices[at];
        float position[3];
        __builtin_memcpy(position, draw.vertex->positions + index * draw.vertex->stride, sizeof position);
        Clip4 const clip = to_clip(*draw.vertex, position);
        c[i][0] = static_cast<double>(clip.x);
        c[i][1] = static_cast<double>(clip.y);
        c[i][2] = static_cast<double>(clip.w);
        made.uv[i] = draw.test->uv[index];
    }
    for (int i = 0; i < 3; ++i) {
        double const* const p = c[(i + 1) % 3];
        double const* const q = c[(i + 2) % 3];
        for (int k = 0; k < 3; ++k)
            made.weight[i][k] = p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3];
    }
    return made;
}

}  // namespace

MaskedDraw make_masked_draw(AlphaTest const& test, VertexJob const& vertex, IndexSpan indices,
                            std::uint32_t id_base) noexcept {
    MaskedDraw made{&test, nullptr, &vertex, indices, id_base, 0.0, 0.0, 0.0, 0.0, {}};
    if (test.map != nullptr && test.map->is_of(test)) made.map = test.map;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r) made.column[c][r] = vertex.row[r == 2 ? 3 : r][c];
    made.scale_x = 1.0 / static_cast<double>(vertex.half_width);
    made.scale_y = 1.0 / static_cast<double>(vertex.half_height);
    made.shift_x = (0.5 - vertex.offset_x / 256.0) * made.scale_x - 1.0;
    made.shift_y = (0.5 - vertex.offset_y / 256.0) * made.scale_y - 1.0;
    return made;
}

/// The weights' sums over the corners, moved from device space to the pixels of the viewport.
TexturePlane make_texture_plane(MaskedDraw const& draw, std::uint32_t triangle) {
    CornerWeights const corners = make_corner_weights(draw, triangle);
    auto const linear = [&](auto const& factor) {
        double sum[3] = {0.0, 0.0, 0.0};
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) sum[k] += corners.weight[i][k] * factor(corners.uv[i]);
        return Linear{sum[0] * draw.scale_x, sum[1] * draw.scale_y,
                      sum[0] * draw.shift_x + sum[1] * draw.shift_y + sum[2]};
    };
    return {linear([](math::vec2 const&) { return 1.0; }),
            linear([](math::vec2 const& uv) { return static_cast<double>(uv.x); }),
            linear([](math::vec2 const& uv) { return static_cast<double>(uv.y); })};
}

bool is_complete(AlphaTest const& test, std::size_t positions) noexcept {
    return test.uv.size() >= positions && math::is_complete(test.texture);
}

std::uint64_t draw_masked(TileJob const& job, Record const& record) {
    MaskedDraw const& draw = masked_draw(job, record);
    TexturePlane const plane = make_texture_plane(draw, record.id - draw.id_base);
    AlphaTest const& test = *draw.test;
    return draw_samples(job, record, [&](std::int32_t px, std::int32_t py) {
        double const x = px;
        double const y = py;
        double const w = 1.0 / plane.w(x, y);
        return math::alpha_at(test.texture, {plane.u(x, y) * w, plane.v(x, y) * w}) * test.factor >= test.cutoff;
    });
}

}  // namespace gnomon::raster::detail
