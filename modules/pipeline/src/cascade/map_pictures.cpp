#include "map_pictures.hpp"

#include "../tone.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace gnomon::pipeline {

namespace {

constexpr std::int32_t most_px = 512;  ///< Of a map's side in the picture.
constexpr std::int32_t gap_px = 8;

/// What a texel shows; of several in one pixel the last of these counts.
enum class Shows : std::uint8_t {
    nothing,
    bare,    ///< Nothing, where nothing was kept.
    kept,    ///< Beneath what was drawn.
    caster,  ///< Of the row's own colour.
    told,    ///< What the row is about: an active caster, a texel that is new.
};

struct Texel {
    Shows shows = Shows::nothing;
    float depth = 1.0F;  ///< 0 nearest to the light, 1: nothing was drawn.
};

/// Depths from 0 to 1, whatever the format; 1 is empty.
std::vector<float> depths_of(std::span<std::byte const> bytes, MapFormat const& format) {
    std::size_t const texels = static_cast<std::size_t>(format.size_px) * static_cast<std::size_t>(format.size_px);
    std::vector<float> depths(texels, 1.0F);
    if (bytes.empty()) return depths;
    for (std::size_t i = 0; i < texels; ++i) {
        float held = 0.0F;
        if (format.format == backend::DepthFormat::unorm16) {
            std::uint16_t code = 0;
            std::memcpy(&code, bytes.data() + i * sizeof code, sizeof code);
            held = static_cast<float>(code) / 65535.0F;
        } else {
            std::memcpy(&held, bytes.data() + i * sizeof held, sizeof held);
        }
        depths[i] = format.depth == math::Depth::reversed ? 1.0F - held : held;
    }
    return depths;
}

bool is_in(cascade::TexelRect const& r, std::int32_t x, std::int32_t y) noexcept {
    return x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height;
}

/// Texels of a map that one pixel stands for, on a side.
std::int32_t step_of(MapFormat const& format) noexcept { return (format.size_px + most_px - 1) / most_px; }

/// One map at its three points.
struct Column {
    std::int32_t size_px, step;
    cascade::ExposedRects exposed;
    std::vector<float> kept, content, finished;
    float nearest = 0.0F, farthest = 1.0F;  ///< Of what was drawn: the picture's contrast.

    Column(MapSteps const& steps, MapFormat const& format)
        : size_px(format.size_px),
          step(step_of(format)),
          exposed(steps.exposed),
          kept(depths_of(steps.kept, format)),
          content(depths_of(steps.content.empty() ? steps.finished : steps.content, format)),
          finished(depths_of(steps.finished, format)) {
        nearest = std::numeric_limits<float>::infinity();
        farthest = 0.0F;
        for (float const d : finished)
            if (d < 1.0F) {
                nearest = std::min(nearest, d);
                farthest = std::max(farthest, d);
            }
        if (!(nearest < farthest)) nearest = 0.0F, farthest = 1.0F;
    }

    [[nodiscard]] bool is_exposed(std::int32_t x, std::int32_t y) const noexcept {
        for (std::int32_t k = 0; k < exposed.count; ++k)
            if (is_in(exposed.rects[static_cast<std::size_t>(k)], x, y)) return true;
        return false;
    }
    [[nodiscard]] Texel at(int row, std::int32_t x, std::int32_t y) const noexcept {
        std::size_t const i = static_cast<std::size_t>(y) * static_cast<std::size_t>(size_px) + static_cast<std::size_t>(x);
        auto const plain = [](float depth, Shows shows) { return Texel{depth < 1.0F ? shows : Shows::nothing, depth}; };
        if (row == 0) return plain(finished[i], finished[i] != content[i] ? Shows::told : Shows::caster);
        if (row == 1) return plain(kept[i], Shows::caster);
        if (content[i] != kept[i]) return {Shows::told, content[i]};
        if (kept[i] < 1.0F) return {Shows::kept, kept[i]};
        return {is_exposed(x, y) ? Shows::bare : Shows::nothing, 1.0F};
    }
    /// Grey level of a depth: dark near, lighter far, never as light as empty.
    [[nodiscard]] float level(float depth) const noexcept {
        return 0.06F + 0.62F * std::clamp((depth - nearest) / (farthest - nearest), 0.0F, 1.0F);
    }
};

math::vec3 color_of(int row, Texel const& texel, float level) noexcept {
    constexpr math::vec3 white(1.0F), amber(1.0F, 0.42F, 0.02F), red(1.0F, 0.02F, 0.01F), blue(0.30F, 0.55F, 1.0F);
    switch (texel.shows) {
        case Shows::nothing: return white;
        case Shows::bare: return math::vec3(1.0F, 0.62F, 0.58F);
        case Shows::kept: return math::vec3(0.45F + 0.55F * level);
        case Shows::caster: return row == 1 ? blue * level : math::vec3(level);
        case Shows::told: break;
    }
    return (row == 0 ? amber : red) * (0.45F + 0.8F * level);
}

/// The most telling of the texels that a pixel of a cell stands for.
Texel shown_at(Column const& column, int row, math::ivec2 pixel) {
    Texel best;
    std::int32_t const step = column.step;
    for (std::int32_t y = pixel.y * step; y < std::min(column.size_px, (pixel.y + 1) * step); ++y)
        for (std::int32_t x = pixel.x * step; x < std::min(column.size_px, (pixel.x + 1) * step); ++x) {
            Texel const texel = column.at(row, x, y);
            bool const more = texel.shows > best.shows || (texel.shows == best.shows && texel.depth < best.depth);
            if (more) best = texel;
        }
    return best;
}

}  // namespace

void note(Verbs& verbs, backend::TargetId target, std::uint32_t layer, MapFormat const& format, std::vector<std::byte>& bytes) {
    auto const side = static_cast<std::size_t>(format.size_px);
    bytes.resize(side * side * (format.format == backend::DepthFormat::unorm16 ? 2U : 4U));
    verbs(verbs.device().read({target, layer, backend::Plane::depth, {0, 0, format.size_px, format.size_px}}, bytes));
}

Image picture_of_maps(std::span<MapSteps const> maps, MapFormat const& format) {
    std::int32_t const step = step_of(format);
    std::int32_t const cell = (format.size_px + step - 1) / step;
    auto const pitch = cell + gap_px;
    Image image;
    image.size_px = math::ivec2(static_cast<std::int32_t>(maps.size()) * pitch + gap_px, 3 * pitch + gap_px);
    image.rgb.assign(pixel_count(image.size_px) * 3, 96);
    for (std::size_t k = 0; k < maps.size(); ++k) {
        Column const column(maps[k], format);
        for (int row = 0; row < 3; ++row)
            for (std::int32_t y = 0; y < cell; ++y)
                for (std::int32_t x = 0; x < cell; ++x) {
                    Texel const texel = shown_at(column, row, math::ivec2(x, y));
                    std::int32_t const left = gap_px + static_cast<std::int32_t>(k) * pitch + x;
                    std::int32_t const top = gap_px + row * pitch + y;
                    put(image, static_cast<std::size_t>(top) * static_cast<std::size_t>(image.size_px.x) + static_cast<std::size_t>(left),
                        color_of(row, texel, column.level(texel.depth)));
                }
    }
    return image;
}

}  // namespace gnomon::pipeline
