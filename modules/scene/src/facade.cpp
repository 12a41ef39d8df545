#include "detail/facade.hpp"

namespace gnomon::scene::detail {

namespace {

using math::dvec3;

/// One wall as a lattice of points, level with the wall or in the depth of the recesses.
class Wall {
public:
    Wall(Facade const& facade, std::size_t wall)
        : facade_(facade), axes_(facade.axes[wall]), recess_(facade.recess[wall]), wall_(wall) {}

    [[nodiscard]] int columns() const noexcept { return static_cast<int>(axes_.size()) + 1; }
    [[nodiscard]] int rows() const noexcept { return static_cast<int>(facade_.heights.size()) + 1; }

    [[nodiscard]] dvec3 at(int column, int row, bool deep) const {
        double const d = deep ? facade_.depth : 0.0;
        double const along = column == 0 ? 0.0 : column == columns() ? length() : axes_[static_cast<std::size_t>(column - 1)];
        double const y = row == 0 ? facade_.lo.y : row == rows() ? facade_.hi.y : facade_.heights[static_cast<std::size_t>(row - 1)];
        dvec3 const& lo = facade_.lo;
        dvec3 const& hi = facade_.hi;
        bool const end = column == columns();
        switch (wall_) {
            case 0: return {end ? hi.x : lo.x + along, y, hi.z - d};
            case 1: return {hi.x - d, y, end ? lo.z : hi.z - along};
            case 2: return {end ? lo.x : hi.x - along, y, lo.z + d};
            default: return {lo.x + d, y, end ? hi.z : lo.z + along};
        }
    }

    [[nodiscard]] std::uint32_t recess(int column, int row) const {
        if (column < 0 || row < 0 || column >= columns() || row >= rows()) return none;
        return recess_[static_cast<std::size_t>(row * columns() + column)];
    }

    void add(SolidBuilder& out) const {
        for (int row = 0; row < rows(); ++row)
            for (int column = 0; column < columns(); ++column) {
                std::uint32_t const inner = recess(column, row);
                bool const deep = inner != none;
                out.quad(at(column, row, deep), at(column + 1, row, deep), at(column + 1, row + 1, deep),
                         at(column, row + 1, deep), deep ? inner : facade_.material);
                if (deep) add_reveals(out, column, row);
            }
    }

private:
    [[nodiscard]] double length() const noexcept {
        return wall_ % 2 == 0 ? facade_.hi.x - facade_.lo.x : facade_.hi.z - facade_.lo.z;
    }

    void reveal(SolidBuilder& out, math::ivec2 const& a, math::ivec2 const& b) const {
        out.quad(at(a.x, a.y, false), at(b.x, b.y, false), at(b.x, b.y, true), at(a.x, a.y, true), facade_.material);
    }

    void add_reveals(SolidBuilder& out, int c, int r) const {
        if (recess(c, r - 1) == none) reveal(out, {c, r}, {c + 1, r});
        if (recess(c + 1, r) == none) reveal(out, {c + 1, r}, {c + 1, r + 1});
        if (recess(c, r + 1) == none) reveal(out, {c + 1, r + 1}, {c, r + 1});
        if (recess(c - 1, r) == none) reveal(out, {c, r + 1}, {c, r});
    }

    Facade const& facade_;
    std::vector<double> const& axes_;
    std::vector<std::uint32_t> const& recess_;
    std::size_t wall_;
};

/// Triangles from `tip` to all steps of a wall's upper (or, reversed, lower) border.
void cap_wall(SolidBuilder& out, Wall const& wall, int row, dvec3 const& tip, std::uint32_t material) {
    for (int c = 0; c < wall.columns(); ++c) {
        dvec3 const a = wall.at(c, row, false);
        dvec3 const b = wall.at(c + 1, row, false);
        if (row == 0)
            out.triangle(b, a, tip, material);
        else
            out.triangle(a, b, tip, material);
    }
}

void add_gable(SolidBuilder& out, Facade const& f, std::array<Wall, 4> const& walls) {
    std::size_t const first = f.top == Top::gable_along_x ? 1 : 0;  // the walls that end in a gable: this and the one opposite
    auto const tip_over = [&](std::size_t wall) {
        Wall const& w = walls[wall];
        dvec3 const middle = (w.at(0, w.rows(), false) + w.at(w.columns(), w.rows(), false)) * 0.5;
        return dvec3(middle.x, f.ridge, middle.z);
    };
    for (std::size_t i = 0; i < 4; ++i) {
        Wall const& w = walls[i];
        if (i % 2 == first % 2) {
            cap_wall(out, w, w.rows(), tip_over(i), f.material);
            continue;
        }
        dvec3 const left = tip_over((i + 3) % 4);
        dvec3 const right = tip_over((i + 1) % 4);
        cap_wall(out, w, w.rows(), left, f.top_material);
        out.triangle(left, w.at(w.columns(), w.rows(), false), right, f.top_material);
    }
}

}  // namespace

std::vector<double> window_axes(double length, Openings const& openings) {
    std::vector<double> axes;
    double const pitch = length / openings.count;
    for (int i = 0; i < openings.count; ++i) {
        axes.push_back((i + 0.5) * pitch - openings.width * 0.5);
        axes.push_back((i + 0.5) * pitch + openings.width * 0.5);
    }
    return axes;
}

void clear_recesses(Facade& facade) {
    for (std::size_t wall = 0; wall < 4; ++wall)
        facade.recess[wall].assign((facade.axes[wall].size() + 1) * (facade.heights.size() + 1), none);
}

void set_recess(Facade& facade, std::size_t wall, math::ivec2 const& column_row, std::uint32_t material) {
    std::size_t const columns = facade.axes[wall].size() + 1;
    facade.recess[wall][static_cast<std::size_t>(column_row.y) * columns + static_cast<std::size_t>(column_row.x)] = material;
}

void add_facade(SolidBuilder& out, Facade const& facade) {
    std::array<Wall, 4> const walls{Wall(facade, 0), Wall(facade, 1), Wall(facade, 2), Wall(facade, 3)};
    dvec3 const middle = (facade.lo + facade.hi) * 0.5;
    for (Wall const& wall : walls) {
        wall.add(out);
        cap_wall(out, wall, 0, {middle.x, facade.lo.y, middle.z}, facade.material);
        if (facade.top == Top::flat) cap_wall(out, wall, wall.rows(), {middle.x, facade.hi.y, middle.z}, facade.top_material);
    }
    if (facade.top != Top::flat) add_gable(out, facade, walls);
}

}  // namespace gnomon::scene::detail
