#include "detail/grid_mesh.hpp"
#include "detail/town.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::scene::detail {

namespace {

using math::dvec2;
using math::dvec3;

constexpr int hill_cells = 5;
constexpr double hill_height_m = 9.0;
constexpr double curb_m = 0.14;
constexpr double skirt_m = 14.0;

/// Lines of one street-to-street period: the curbs on both sides, the pavements' ends, and even ones between.
std::vector<double> town_lines(double pitch_m, int periods, int inner_cells) {
    std::vector<double> lines;
    double const inner_m = (pitch_m - 2.0 * pavement_end_m) / inner_cells;
    for (int period = 0; period < periods; ++period) {
        double const start = period * pitch_m - town_side_m * 0.5;
        for (double const line : {0.0, street_half_m - 0.05, street_half_m + 0.05}) lines.push_back(start + line);
        for (int i = 0; i <= inner_cells; ++i) lines.push_back(start + pavement_end_m + inner_m * i);
        for (double const line : {street_half_m + 0.05, street_half_m - 0.05}) lines.push_back(start + pitch_m - line);
    }
    lines.push_back(town_side_m * 0.5);
    return lines;
}

/// Whether a line lies in the roadway; `from_street` is its distance from the nearest street's middle.
double from_street(double at, double pitch_m) noexcept {
    double const cells = (at + town_side_m * 0.5) / pitch_m;
    return std::abs(cells - std::floor(cells + 0.5)) * pitch_m;
}

/// Heights at the corners of a coarse grid, joined smoothly: slopes of at most some percent.
class Hills {
public:
    explicit Hills(std::uint64_t seed) {
        Pcg32 random(seed);
        for (double& corner : corners_) corner = random.uniform(0.0, hill_height_m);
    }

    [[nodiscard]] double operator()(double x, double z) const noexcept {
        double const cell_m = town_side_m / (hill_cells - 1);
        double const u = std::clamp((x + town_side_m * 0.5) / cell_m, 0.0, hill_cells - 1.0);
        double const v = std::clamp((z + town_side_m * 0.5) / cell_m, 0.0, hill_cells - 1.0);
        int const i = std::min(static_cast<int>(u), hill_cells - 2);
        int const j = std::min(static_cast<int>(v), hill_cells - 2);
        double const s = smooth_step(u - i);
        double const t = smooth_step(v - j);
        double const near = corner(i, j) + (corner(i + 1, j) - corner(i, j)) * s;
        double const far = corner(i, j + 1) + (corner(i + 1, j + 1) - corner(i, j + 1)) * s;
        return near + (far - near) * t;
    }

private:
    [[nodiscard]] double corner(int i, int j) const noexcept { return corners_[static_cast<std::size_t>(j * hill_cells + i)]; }

    std::array<double, static_cast<std::size_t>(hill_cells* hill_cells)> corners_{};
};

struct GroundPaints {
    std::uint32_t asphalt;
    std::uint32_t pavement;
    std::uint32_t grass;
    std::uint32_t park;
    std::uint32_t paving;
    std::uint32_t earth;

    [[nodiscard]] std::uint32_t of(dvec2 const& middle) const noexcept {
        double const street = std::min(from_street(middle.x, town_pitch_x_m), from_street(middle.y, town_pitch_z_m));
        if (street < street_half_m) return asphalt;
        if (street < pavement_end_m) return pavement;
        auto const column = static_cast<int>((middle.x + town_side_m * 0.5) / town_pitch_x_m);
        auto const row = static_cast<int>((middle.y + town_side_m * 0.5) / town_pitch_z_m);
        switch (town_block(column, row)) {
            case Block::homes: return grass;
            case Block::park: return park;
            case Block::market: break;
        }
        return paving;
    }
};

/// The cell that holds `at`, of lines that rise.
std::size_t cell_of(std::vector<double> const& lines, double at) noexcept {
    auto const above = std::upper_bound(lines.begin() + 1, lines.end() - 1, at);
    return static_cast<std::size_t>(above - lines.begin()) - 1;
}

}  // namespace

Block town_block(int column, int row) noexcept {
    if (column == 3 && row == 5) return Block::market;
    bool const park = (column == 2 && row == 4) || (column == 1 && row == 7) || (column == 4 && row == 2) ||
                      (column == 5 && row == 8) || (column == 0 && row == 1);
    return park ? Block::park : Block::homes;
}

dvec2 town_corner(int column, int row) noexcept {
    return {column * town_pitch_x_m - town_side_m * 0.5, row * town_pitch_z_m - town_side_m * 0.5};
}

TownGround::TownGround(std::uint64_t seed)
    : x_(town_lines(town_pitch_x_m, town_blocks_x, 10)), z_(town_lines(town_pitch_z_m, town_blocks_z, 4)) {
    Hills const hills(seed);
    for (double const z : z_)
        for (double const x : x_) {
            bool const road = std::min(from_street(x, town_pitch_x_m), from_street(z, town_pitch_z_m)) < street_half_m;
            y_.push_back(hills(x, z) + (road ? 0.0 : curb_m));
        }
}

dvec3 TownGround::point(std::size_t i, std::size_t j) const noexcept { return {x_[i], y_[j * x_.size() + i], z_[j]}; }

double TownGround::height(double x, double z) const noexcept {
    std::size_t const i = cell_of(x_, x);
    std::size_t const j = cell_of(z_, z);
    dvec3 const a = point(i, j);
    dvec3 const b = point(i + 1, j);
    dvec3 const c = point(i, j + 1);
    dvec3 const d = point(i + 1, j + 1);
    double const u = (x - a.x) / (d.x - a.x);
    double const v = (z - a.z) / (d.z - a.z);
    // The diagonal of a cell runs from c to b: see `add_to`.
    if (u + v < 1.0) return a.y + (b.y - a.y) * u + (c.y - a.y) * v;
    return d.y + (c.y - d.y) * (1.0 - u) + (b.y - d.y) * (1.0 - v);
}

std::array<double, 2> TownGround::heights(dvec2 const& lo, dvec2 const& hi) const noexcept {
    std::array<double, 2> range{1e9, -1e9};
    for (int j = 0; j <= 2; ++j)
        for (int i = 0; i <= 2; ++i) {
            double const y = height(lo.x + (hi.x - lo.x) * 0.5 * i, lo.y + (hi.y - lo.y) * 0.5 * j);
            range = {std::min(range[0], y), std::max(range[1], y)};
        }
    return range;
}

void TownGround::add_to(Scene& scene) const {
    GroundPaints const paints{add_material(scene, "asphalt", {0.16F, 0.16F, 0.165F}),
                              add_material(scene, "pavement", {0.42F, 0.41F, 0.39F}),
                              add_material(scene, "grass", {0.20F, 0.27F, 0.10F}),
                              add_material(scene, "park", {0.16F, 0.30F, 0.10F}),
                              add_material(scene, "paving", {0.46F, 0.40F, 0.33F}),
                              add_material(scene, "earth", {0.25F, 0.18F, 0.12F})};
    SolidBuilder out;
    std::size_t const m = x_.size() - 1;
    std::size_t const n = z_.size() - 1;
    // Block by block, so that a chunk is a part of a block.
    std::size_t const wide = m / town_blocks_x;
    std::size_t const deep = n / town_blocks_z;
    for (std::size_t block = 0; block < std::size_t{town_blocks_x} * town_blocks_z; ++block)
        for (std::size_t cell = 0; cell < wide * deep; ++cell) {
            std::size_t const i = block % town_blocks_x * wide + cell % wide;
            std::size_t const j = block / town_blocks_x * deep + cell / wide;
            dvec3 const a = point(i, j);
            dvec3 const b = point(i + 1, j);
            dvec3 const c = point(i, j + 1);
            dvec3 const d = point(i + 1, j + 1);
            std::uint32_t const paint = paints.of({(a.x + b.x) * 0.5, (a.z + c.z) * 0.5});
            out.triangle(c, b, a, paint);
            out.triangle(c, d, b, paint);
        }
    auto const low = [](dvec3 const& p) { return dvec3(p.x, -skirt_m, p.z); };
    auto const skirt = [&](dvec3 const& a, dvec3 const& b) {
        out.quad(low(a), low(b), b, a, paints.earth);
        out.triangle(low(b), low(a), {0.0, -skirt_m, 0.0}, paints.earth);
    };
    for (std::size_t i = 0; i < m; ++i) {
        skirt(point(i, n), point(i + 1, n));
        skirt(point(i + 1, 0), point(i, 0));
    }
    for (std::size_t j = 0; j < n; ++j) {
        skirt(point(0, j), point(0, j + 1));
        skirt(point(m, j + 1), point(m, j));
    }
    scene.instances.push_back(placed_instance("ground", add_mesh(scene, "ground", out.take()), {}));
}

}  // namespace gnomon::scene::detail
