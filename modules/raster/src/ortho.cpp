// The orthographic integer pass: corners to units, set-up, tiles in and out.

#include "ortho.hpp"

#include <gnomon/math/scalar.hpp>

#include "masked.hpp"
#include "ortho_loop.hpp"
#include "tile_workspace.hpp"

#include <algorithm>

namespace gnomon::raster {

namespace {

/// To the nearest integer, ties to even.
///
/// expects: |x| below 2^51.
std::int64_t rounded(double x) {
    constexpr double magic = 6755399441055744.0;  // 1.5 * 2^52
    return static_cast<std::int64_t>((x + magic) - magic);
}

double along(math::dvec3 const& axis, math::dvec3 const& p) { return (axis.x * p.x + axis.y * p.y) + axis.z * p.z; }

}  // namespace

std::optional<LightVertex> try_light_vertex(IntegerOrtho const& light, math::dvec3 const& world_m) noexcept {
    double const per_texel = 256.0 / light.texel_m;
    double const per_depth = 256.0 / light.depth_unit_m;
    double const at[3] = {along(light.right, world_m) * per_texel, along(light.down, world_m) * per_texel,
                          along(light.away, world_m) * per_depth};
    constexpr double most = static_cast<double>(max_light_units);
    for (double const c : at)
        if (!(c <= most && c >= -most)) return std::nullopt;
    return LightVertex{rounded(at[0]), rounded(at[1]), rounded(at[2])};
}

namespace detail {

OrthoRules::OrthoRules(std::span<OrthoDraw const> draws, std::span<std::size_t const> ends, IntegerOrtho const& light,
                       OrthoConfig const& config, DepthTarget const& target)
    : draws_(draws),
      ends_(ends),
      light_(light),
      config_(config),
      target_(target),
      last_code_(target.is_unorm16() ? 65535.0F : 16777216.0F) {
    Rect const whole{0, 0, target.width(), target.height()};
    Rect const scissor = config.scissor.value_or(whole);
    auto const end = [](std::int32_t at, std::int32_t size, std::int32_t limit) {
        return static_cast<std::int32_t>(std::min<std::int64_t>(std::int64_t{at} + std::max(size, 0), limit));
    };
    x0_ = std::max(scissor.x, 0);
    y0_ = std::max(scissor.y, 0);
    x1_ = end(scissor.x, scissor.width, whole.width);
    y1_ = end(scissor.y, scissor.height, whole.height);
    stats.triangles = ends.empty() ? 0 : ends.back();
}

TiledArea OrthoRules::area() const { return {x0_, y0_, x1_, y1_, make_bin_grid(target_.width(), target_.height(), 0)}; }

void OrthoRules::add(OrthoStats const& counts) {
    stats.bad_index += counts.bad_index;
    stats.not_finite += counts.not_finite;
    stats.overflow += counts.overflow;
    stats.outside += counts.outside;
    stats.degenerate += counts.degenerate;
    stats.culled += counts.culled;
    stats.no_sample += counts.no_sample;
    stats.drawn += counts.drawn;
}

void OrthoRules::set_up(std::size_t begin, std::size_t end, Chunk& chunk) const {
    auto d = static_cast<std::size_t>(std::upper_bound(ends_.begin(), ends_.end(), begin) - ends_.begin());
    for (; begin < end; ++d) {
        std::size_t const first = d == 0 ? 0 : ends_[d - 1];
        for (; begin < std::min(end, ends_[d]); ++begin)
            set_up_triangle(static_cast<std::uint32_t>(d), begin - first, chunk);
    }
}

/// returns: false where the triangle is left out, and counted.
bool OrthoRules::read_corner(OrthoDraw const& draw, std::uint32_t index, LightVertex& corner, Chunk& chunk) const {
    math::vec3 const position = draw.positions[index];
    math::dvec3 const world(draw.origin_m.x + static_cast<double>(position.x),
                            draw.origin_m.y + static_cast<double>(position.y),
                            draw.origin_m.z + static_cast<double>(position.z));
    if (!math::is_finite(position)) {
        ++chunk.counts.not_finite;
        return false;
    }
    auto const vertex = try_light_vertex(light_, world);
    auto const fits = [](std::int64_t c) { return c >= -max_ortho_extent && c <= max_ortho_extent; };
    if (vertex.has_value())
        corner = {vertex->x - light_.origin_x * 256, vertex->y - light_.origin_y * 256,
                  vertex->z - light_.origin_z * 256};
    if (vertex.has_value() && fits(corner.x) && fits(corner.y) && fits(corner.z)) return true;
    ++chunk.counts.overflow;
    return false;
}

void OrthoRules::set_up_triangle(std::uint32_t d, std::size_t triangle, Chunk& chunk) const {
    OrthoDraw const& draw = draws_[d];
    std::uint32_t index[3];
    for (std::size_t i = 0; i < 3; ++i) {
        index[i] = draw.indices.empty() ? static_cast<std::uint32_t>(triangle * 3 + i) : draw.indices[triangle * 3 + i];
        if (index[i] < draw.positions.size()) continue;
        ++chunk.counts.bad_index;
        return;
    }
    LightVertex corner[3];
    for (int i = 0; i < 3; ++i)
        if (!read_corner(draw, index[i], corner[i], chunk)) return;
    OrthoRecord record{};
    record.draw = d;
    for (int i = 0; i < 3; ++i) {
        record.x[i] = corner[i].x;
        record.y[i] = corner[i].y;
        record.z[i] = corner[i].z;
        record.uv[i] = index[i];
    }
    add_record(record, chunk);
}

void OrthoRules::add_record(OrthoRecord& r, Chunk& chunk) const {
    Wide const area = wide_edge(r, 0, 1, r.x[2], r.y[2]);
    Cull const cull = draws_[r.draw].cull;
    if (area == 0) {
        ++chunk.counts.degenerate;
        return;
    }
    if ((cull == Cull::back && area > 0) || (cull == Cull::front && area < 0)) {  // y is down: clockwise is positive.
        ++chunk.counts.culled;
        return;
    }
    if (area < 0) {
        std::swap(r.x[1], r.x[2]);
        std::swap(r.y[1], r.y[2]);
        std::swap(r.z[1], r.z[2]);
        std::swap(r.uv[1], r.uv[2]);
    }
    // The pixels whose centres the bounds hold; a centre on the far side is never covered.
    std::int64_t x0 = (std::min({r.x[0], r.x[1], r.x[2]}) + 127) >> 8;
    std::int64_t y0 = (std::min({r.y[0], r.y[1], r.y[2]}) + 127) >> 8;
    std::int64_t x1 = (std::max({r.x[0], r.x[1], r.x[2]}) - 129) >> 8;
    std::int64_t y1 = (std::max({r.y[0], r.y[1], r.y[2]}) - 129) >> 8;
    if (x0 > x1 || y0 > y1) {
        ++chunk.counts.no_sample;
        return;
    }
    x0 = std::max<std::int64_t>(x0, x0_);
    y0 = std::max<std::int64_t>(y0, y0_);
    x1 = std::min<std::int64_t>(x1, x1_ - 1);
    y1 = std::min<std::int64_t>(y1, y1_ - 1);
    if (x0 > x1 || y0 > y1) {
        ++chunk.counts.outside;
        return;
    }
    ++chunk.counts.drawn;
    r.min_x = static_cast<std::uint16_t>(x0);
    r.min_y = static_cast<std::uint16_t>(y0);
    r.max_x = static_cast<std::uint16_t>(x1);
    r.max_y = static_cast<std::uint16_t>(y1);
    chunk.add_record() = r;
}

/// Codes of the image, from near to far in either convention.
void OrthoRules::load(OrthoTile const& tile) const {
    bool const reversed = config_.depth == math::Depth::reversed;
    for (std::int32_t y = tile.rect.y0; y < tile.rect.y1; ++y) {
        float* const row = tile.code + std::ptrdiff_t{y - tile.rect.y0} * tile_size;
        for (std::int32_t x = tile.rect.x0; x < tile.rect.x1; ++x) {
            float const held = target_.is_unorm16() ? static_cast<float>(target_.unorm16().row(y)[x])
                                                    : target_.f32().row(y)[x] * 16777216.0F;
            row[x - tile.rect.x0] = reversed ? last_code_ - held : held;
        }
    }
}

void OrthoRules::store(OrthoTile const& tile) const {
    bool const reversed = config_.depth == math::Depth::reversed;
    for (std::int32_t y = tile.rect.y0; y < tile.rect.y1; ++y) {
        float const* const row = tile.code + std::ptrdiff_t{y - tile.rect.y0} * tile_size;
        for (std::int32_t x = tile.rect.x0; x < tile.rect.x1; ++x) {
            float const code = reversed ? last_code_ - row[x - tile.rect.x0] : row[x - tile.rect.x0];
            if (target_.is_unorm16())
                target_.unorm16().row(y)[x] = static_cast<std::uint16_t>(code);
            else
                target_.f32().row(y)[x] = code * 0x1p-24F;
        }
    }
}

template <class ForEach>
std::uint64_t OrthoRules::draw(TileRect const& rect, bool first_batch, ForEach const& for_each) const {
    alignas(64) float code[tile_size * tile_size];
    OrthoTile const tile{rect, code};
    if (first_batch && config_.load == Load::clear)
        std::fill_n(code, tile_size * tile_size, last_code_);
    else
        load(tile);
    OrthoDepth const depth{static_cast<double>(last_code_), config_.range == DepthRange::clip};
    std::uint64_t written = 0;
    for_each([&](OrthoRecord const& record, Chunk const&) {
        AlphaTest const* const test = draws_[record.draw].alpha_test;
        bool const masked = test != nullptr && is_complete(*test, draws_[record.draw].positions.size());
        written += draw_ortho(tile, record, depth, masked ? test : nullptr);
    });
    store(tile);
    return written;
}

}  // namespace detail

OrthoStats ortho_pass(std::span<OrthoDraw const> draws, IntegerOrtho const& light, DepthTarget const& target,
                      OrthoConfig const& config, TileWorkspace& workspace, core::ExecutorRef executor) {
    GNOMON_EXPECT(light.texel_m > 0.0 && light.depth_unit_m > 0.0);
    GNOMON_EXPECT(target.width() <= max_size_px && target.height() <= max_size_px);
    TileWorkspace::State& state = workspace.state();
    state.ends.clear();
    std::size_t triangles = 0;
    for (OrthoDraw const& draw : draws) {
        triangles += (draw.indices.empty() ? draw.positions.size() : draw.indices.size()) / 3;
        state.ends.push_back(triangles);
    }
    detail::OrthoRules rules(draws, state.ends, light, config, target);
    detail::TiledArea const area = rules.area();
    if (area.x1 <= area.x0 || area.y1 <= area.y0) {
        rules.stats.outside = rules.stats.triangles;
        return rules.stats;
    }
    std::uint64_t const written = detail::TiledPass(rules, state.ortho, area, executor).run(triangles);
    rules.stats.samples_written = written;
    return rules.stats;
}

}  // namespace gnomon::raster
