#include "detail/leaf_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::scene::detail {

namespace {

using math::dvec2;

/// A leaf from its stalk to its tip.
struct Leaf {
    dvec2 from;
    dvec2 to;
    double half_width;
    double shade;
};

constexpr std::array<Leaf, 9> leaves{{
    {{0.50, 0.12}, {0.18, 0.30}, 0.085, 0.90}, {{0.50, 0.16}, {0.86, 0.30}, 0.085, 1.05},
    {{0.50, 0.32}, {0.08, 0.54}, 0.095, 1.10}, {{0.50, 0.36}, {0.94, 0.54}, 0.095, 0.92},
    {{0.50, 0.52}, {0.14, 0.78}, 0.090, 0.98}, {{0.50, 0.56}, {0.87, 0.80}, 0.090, 1.12},
    {{0.50, 0.68}, {0.29, 0.95}, 0.075, 1.06}, {{0.50, 0.70}, {0.72, 0.96}, 0.075, 0.94},
    {{0.50, 0.74}, {0.51, 1.00}, 0.070, 1.02},
}};

/// How far inside the leaf the point is, across it; and how far from its middle vein.
struct Inside {
    double depth;
    double vein;
};

Inside look_into(Leaf const& leaf, dvec2 const& p) noexcept {
    dvec2 const axis = leaf.to - leaf.from;
    double const length = std::sqrt(axis.x * axis.x + axis.y * axis.y);
    dvec2 const d(axis.x / length, axis.y / length);
    dvec2 const q = p - leaf.from;
    double const along = (q.x * d.x + q.y * d.y) / length;
    double const aside = std::abs(q.y * d.x - q.x * d.y);
    // Widest before the middle, pointed at both ends.
    double const width = along <= 0.0 || along >= 1.0 ? -1.0 : leaf.half_width * 4.4 * along * (1.0 - along) * (1.1 - 0.35 * along);
    return {width - aside, aside};
}

std::uint8_t byte_of(double share) noexcept {
    return static_cast<std::uint8_t>(std::clamp(share, 0.0, 1.0) * 255.0 + 0.5);
}

/// Colour and alpha at a point of the unit square, y up.
std::array<std::uint8_t, 4> texel(dvec2 const& p, double texel_size) noexcept {
    double const stem = p.y < 0.76 ? 0.014 - std::abs(p.x - 0.5) : -1.0;
    double depth = stem;
    double shade = 0.75;
    for (Leaf const& leaf : leaves) {
        Inside const in = look_into(leaf, p);
        if (in.depth <= 0.0 && in.depth <= depth) continue;
        if (in.depth > 0.0 && depth > 0.0 && depth != stem && in.depth < depth) continue;
        depth = in.depth;
        shade = leaf.shade * (in.vein < 0.009 ? 1.25 : 1.0 - 0.8 * std::min(in.vein, 0.1));
    }
    double const alpha = 0.5 + 0.5 * depth / texel_size;
    return {byte_of(0.62 * shade), byte_of(0.80 * shade), byte_of(0.40 * shade), byte_of(alpha)};
}

}  // namespace

Image paint_leaves(int side_px) {
    Image image;
    image.name = "leaves";
    image.size_px = math::ivec2(side_px, side_px);
    for (int y = 0; y < side_px; ++y)
        for (int x = 0; x < side_px; ++x) {
            dvec2 const p((x + 0.5) / side_px, 1.0 - (y + 0.5) / side_px);
            for (std::uint8_t const channel : texel(p, 1.0 / side_px)) image.rgba.push_back(channel);
        }
    return image;
}

}  // namespace gnomon::scene::detail
