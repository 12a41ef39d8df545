#include "masked.hpp"

#include "sample_loop.hpp"

#include <gnomon/math/scalar.hpp>

#include <cmath>

namespace gnomon::raster::detail {

namespace {

std::int64_t wrapped(std::int64_t i, std::int64_t n, Wrap wrap) {
    switch (wrap) {
        case Wrap::clamp: return i < 0 ? 0 : i >= n ? n - 1 : i;
        case Wrap::repeat: return ((i % n) + n) % n;
        case Wrap::mirror: {
            std::int64_t const m = ((i % (2 * n)) + 2 * n) % (2 * n);
            return m < n ? m : 2 * n - 1 - m;
        }
    }
    return 0;
}

/// Bilinear alpha in [0, 1] at texture coordinates (u, v) of mip 0.
double alpha_at(AlphaTexture const& texture, double u, double v) {
    // Beyond 2^40 texels a double has no fraction worth filtering, and the cast below must not overflow.
    auto const texel = [](double t, std::int32_t size) {
        double const at = t * size - 0.5;
        return at > -0x1p40 && at < 0x1p40 ? at : 0.0;  // NaN too
    };
    double const x = texel(u, texture.width);
    double const y = texel(v, texture.height);
    double const x_low = std::floor(x);
    double const y_low = std::floor(y);
    auto const at = [&](int dx, int dy) {
        std::int64_t const i = wrapped(static_cast<std::int64_t>(x_low) + dx, texture.width, texture.wrap_u);
        std::int64_t const j = wrapped(static_cast<std::int64_t>(y_low) + dy, texture.height, texture.wrap_v);
        return static_cast<double>(texture.alpha[j * texture.row_bytes + i * texture.stride_bytes]);
    };
    double const fx = x - x_low;
    double const fy = y - y_low;
    double const top = at(0, 0) * (1.0 - fx) + at(1, 0) * fx;
    double const bottom = at(0, 1) * (1.0 - fx) + at(1, 1) * fx;
    return (top * (1.0 - fy) + bottom * fy) / 255.0;
}

/// Perspective-correct texture coordinates of one triangle at image points, from its corners before any clipping.
struct TexturePlane {
    double weight[3][3];  // Weight of corner i at (x, y, 1) of normalized device space, up to a common factor.
    double u[3], v[3];
};

TexturePlane make_texture_plane(MaskedDraw const& draw, std::uint32_t triangle) {
    TexturePlane plane{};
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
        math::vec2 const uv = draw.test->uv[index];
        plane.u[i] = static_cast<double>(uv.x);
        plane.v[i] = static_cast<double>(uv.y);
    }
    for (int i = 0; i < 3; ++i) {
        double const* const p = c[(i + 1) % 3];
        double const* const q = c[(i + 2) % 3];
        for (int k = 0; k < 3; ++k)
            plane.weight[i][k] = p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3];
    }
    return plane;
}

}  // namespace

bool is_complete(AlphaTest const& test, std::size_t positions) noexcept {
    return test.uv.size() >= positions && test.texture.alpha != nullptr && test.texture.width > 0 &&
           test.texture.height > 0;
}

std::uint64_t draw_masked(TileJob const& job, Record const& record) {
    MaskedDraw const& draw = static_cast<MaskedDraw const*>(job.masked_context)[(record.tag >> 1U) - 1];
    TexturePlane const plane = make_texture_plane(draw, record.id - draw.id_base);
    VertexJob const& view = *draw.vertex;
    double const left = view.offset_x / 256.0;
    double const top = view.offset_y / 256.0;
    return draw_samples(job, record, [&](std::int32_t px, std::int32_t py) {
        double const x = (px + 0.5 - left) / static_cast<double>(view.half_width) - 1.0;
        double const y = (py + 0.5 - top) / static_cast<double>(view.half_height) - 1.0;
        double sum = 0.0, u = 0.0, v = 0.0;
        for (int i = 0; i < 3; ++i) {
            double const w = plane.weight[i][0] * x + plane.weight[i][1] * y + plane.weight[i][2];
            sum += w;
            u += w * plane.u[i];
            v += w * plane.v[i];
        }
        return alpha_at(draw.test->texture, u / sum, v / sum) * draw.test->factor >= draw.test->cutoff;
    });
}

}  // namespace gnomon::raster::detail
