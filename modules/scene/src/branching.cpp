#include "detail/branching.hpp"

#include "detail/turn.hpp"

#include <cmath>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;

constexpr double golden_turn = 0.38196601125010515;

/// A branch before it is a pipe.
struct Sprout {
    dvec3 start_m;
    dvec3 direction;
    double length_m;
    double radius_m;
};

dvec3 random_offset(Pcg32& random) noexcept {
    dvec3 v;
    for (int axis = 0; axis < 3; ++axis) v[axis] = random.uniform(-1.0, 1.0);
    return v;
}

/// `d` leaned by `lean_turns` towards the side that `around_turns` names.
dvec3 leaned(dvec3 const& d, double lean_turns, double around_turns) noexcept {
    dvec3 const aside = std::abs(d.y) < 0.9 ? dvec3(0.0, 1.0, 0.0) : dvec3(1.0, 0.0, 0.0);
    dvec3 const u = glm::normalize(glm::cross(aside, d));
    dvec3 const v = glm::cross(d, u);
    SinCos const lean = sin_cos(lean_turns);
    SinCos const around = sin_cos(around_turns);
    return glm::normalize(d * lean.cos + (u * around.cos + v * around.sin) * lean.sin);
}

class Grower {
public:
    Grower(TreeShape const& shape, Pcg32& random, Tree& tree) : shape_(shape), random_(random), tree_(tree) {}

    void grow(std::size_t order, Sprout const& sprout) {
        BranchLevel const& level = shape_.levels[order];
        bool const outermost = order + 1 == shape_.levels.size();
        std::vector<dvec3> line{sprout.start_m};
        std::vector<dvec3> directions{sprout.direction};
        std::vector<double> radii{sprout.radius_m};
        dvec3 d = sprout.direction;
        for (std::uint32_t i = 1; i <= level.segments; ++i) {
            d = glm::normalize(d + random_offset(random_) * level.wobble + dvec3(0.0, level.rise, 0.0));
            line.push_back(line.back() + d * (sprout.length_m / level.segments));
            directions.push_back(d);
            double const left = 1.0 - static_cast<double>(i) / level.segments;
            radii.push_back(i == level.segments ? 0.0 : sprout.radius_m * (0.18 + 0.82 * left));
            if (outermost) tree_.twigs.push_back({line.back(), d});
        }
        if (!outermost) branch(order, sprout, line, directions);
        if (order == 0) flare(line, radii);
        add_tube(tree_.bark, line, radii, level.sides);
    }

private:
    /// The foot of the trunk: wider, and sunk so that no slope of the ground shows its end.
    static void flare(std::vector<dvec3>& line, std::vector<double>& radii) {
        line.insert(line.begin() + 1, line[0] + dvec3(0.0, 2.5 * radii[0], 0.0));
        radii.insert(radii.begin() + 1, radii[0] * 0.95);
        line[0].y -= 0.6;
        radii[0] *= 1.7;
    }

    void branch(std::size_t order, Sprout const& parent, std::vector<dvec3> const& line, std::vector<dvec3> const& directions) {
        BranchLevel const& level = shape_.levels[order + 1];
        std::uint32_t const segments = shape_.levels[order].segments;
        double const first = order == 0 ? shape_.bare_share : 0.22;
        double around = random_.uniform();
        for (std::uint32_t i = 0; i < level.count; ++i) {
            double const step = (i + 0.25 + 0.5 * random_.uniform()) / level.count;
            double const t = first + (0.97 - first) * step;
            double const place = t * segments;
            auto const below = static_cast<std::size_t>(place);  // t < 1, so below the last point
            double const part = place - static_cast<double>(below);
            Sprout child;
            child.start_m = line[below] + (line[below + 1] - line[below]) * part;
            around += golden_turn + random_.uniform(-0.06, 0.06);
            double const lean = level.spread_turns * random_.uniform(0.8, 1.2);
            child.direction = leaned(directions[below + 1], lean, around);
            child.length_m = parent.length_m * level.length * (1.0 - shape_.crown * step) * random_.uniform(0.85, 1.15);
            double const parent_radius_m = parent.radius_m * (0.18 + 0.82 * (1.0 - t));
            double const thin = child.length_m / parent.length_m + 0.18;
            child.radius_m = parent_radius_m * (thin < 0.75 ? thin : 0.75);
            grow(order + 1, child);
        }
    }

    TreeShape const& shape_;
    Pcg32& random_;
    Tree& tree_;
};

}  // namespace

std::uint64_t count_tree_triangles(TreeShape const& shape) noexcept {
    std::uint64_t branches = 1;
    std::uint64_t triangles = 0;
    for (std::size_t order = 0; order < shape.levels.size(); ++order) {
        BranchLevel const& level = shape.levels[order];
        branches *= order == 0 ? 1 : level.count;
        std::uint64_t const bands = level.segments + (order == 0 ? 1 : 0);  // the trunk's foot is one more
        triangles += branches * level.sides * (2 * bands - 1) + branches * (level.sides - 2);
    }
    return triangles;
}

Tree grow_tree(TreeShape const& shape, Pcg32& random) {
    Tree tree;
    Grower(shape, random, tree).grow(0, {dvec3(0.0), dvec3(0.0, 1.0, 0.0), shape.height_m * shape.levels[0].length, shape.radius_m});
    return tree;
}

}  // namespace gnomon::scene::detail
