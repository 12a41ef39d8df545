#include <gnomon/scene/suggest.hpp>

#include "detail/coarse_grid.hpp"
#include "detail/generators.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::scene {

namespace {

using detail::CoarseGrid;
using detail::GridHit;
using math::dvec3;

constexpr double outside_fov_rad = detail::pi * 0.25;
constexpr double inside_fov_rad = detail::pi * 0.4;

/// Directions of a lattice on a cube, turned a little so that none runs along a wall: the same on every machine.
template <class Visit>
void each_direction(Visit visit) {
    for (int z = -2; z <= 2; ++z)
        for (int y = -2; y <= 2; ++y)
            for (int x = -2; x <= 2; ++x)
                if (std::max({std::abs(x), std::abs(y), std::abs(z)}) == 2) visit(dvec3(x + 0.013, y + 0.017, z + 0.011));
}

/// What it is like to stand at a point.
struct Surroundings {
    double enclosed = 0.0;  ///< The part of all directions that end on something.
    double behind = 0.0;    ///< The part that ends on the back of something: high inside a solid.
    double clearance = 0.0; ///< The nearest of what is met.
};

Surroundings look_around(CoarseGrid const& grid, dvec3 const& at) {
    Surroundings found;
    found.clearance = 1e300;
    double count = 0.0;
    each_direction([&](dvec3 const& direction) {
        GridHit const hit = grid.cast(at, direction);
        count += 1.0;
        if (hit.triangle == none) return;
        found.enclosed += 1.0;
        found.behind += hit.front ? 0.0 : 1.0;
        found.clearance = std::min(found.clearance, hit.distance * glm::length(direction));
    });
    found.enclosed /= count;
    found.behind /= count;
    return found;
}

/// A camera's axes: where a point of the image [-1, 1]^2 looks.
struct Frame {
    dvec3 right{1.0, 0.0, 0.0};
    dvec3 up{0.0, 1.0, 0.0};
    dvec3 forward{0.0, 0.0, -1.0};
    double slope = 1.0;  ///< Tangent of half the field of view, the same both ways.

    [[nodiscard]] dvec3 through(double x, double y) const { return forward + right * (x * slope) + up * (y * slope); }
};

Frame frame_of(dvec3 const& eye, dvec3 const& target, double fov_rad) {
    Camera const camera = looking_at("", eye, target, fov_rad);
    return {camera.right, camera.up, -camera.back, std::tan(fov_rad * 0.5)};
}

/// Rays through an even grid over the image.
template <class Visit>
void each_pixel(int side, Visit visit) {
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
            visit((2.0 * column + 1.0) / side - 1.0, (2.0 * row + 1.0) / side - 1.0);
}

class Chooser {
public:
    explicit Chooser(Geometry const& geometry)
        : grid_(geometry),
          lo_(math::to_double(geometry.bounds.lo)),
          size_(math::to_double(geometry.bounds.hi) - math::to_double(geometry.bounds.lo)),
          radius_(std::max(glm::length(size_) * 0.5, 1e-9)) {}

    /// A view in work space.
    SuggestedView run() {
        SuggestedView view;
        view.inside = is_interior() && find_inside(view);
        if (!view.inside) find_outside(view);
        choose_near(view);
        return view;
    }

private:
    [[nodiscard]] dvec3 at(double x, double y, double z) const { return lo_ + size_ * dvec3(x, y, z); }

    /// From most places within the bounds one sees walls, floor or ceiling wherever one looks.
    [[nodiscard]] bool is_interior() const {
        int enclosed = 0;
        int count = 0;
        for (int z = 0; z < 5; ++z)
            for (int y = 0; y < 3; ++y)
                for (int x = 0; x < 5; ++x) {
                    Surroundings const s = look_around(grid_, at((x + 0.5) / 5.0, (y + 0.5) / 3.0, (z + 0.5) / 5.0));
                    enclosed += s.enclosed >= 0.9 && s.behind <= 0.7 ? 1 : 0;
                    ++count;
                }
        return enclosed * 5 >= count * 2;
    }

    /// How much there is to see: far walls and near things, few of either, nothing in front of the eye.
    [[nodiscard]] double worth_inside(dvec3 const& eye, Frame const& frame) const {
        double worth = 0.0;
        each_pixel(6, [&](double x, double y) {
            dvec3 const direction = frame.through(x, y);
            GridHit const hit = grid_.cast(eye, direction);
            if (hit.triangle == none) return;
            double const distance = hit.distance / radius_;
            worth += distance < 0.06 ? -1.5 : std::sqrt(std::min(distance, 1.5));
            worth -= hit.front ? 0.0 : 0.25;
        });
        return worth;
    }

    bool find_inside(SuggestedView& view) const {
        constexpr std::array<double, 2> heights{0.22, 0.4};
        constexpr int places = 7;
        double best = -1e300;
        for (double const height : heights)
            for (int z = 0; z < places; ++z)
                for (int x = 0; x < places; ++x) {
                    dvec3 const eye = at((x + 0.5) / places, height, (z + 0.5) / places);
                    Surroundings const s = look_around(grid_, eye);
                    if (s.enclosed < 0.85 || s.behind > 0.7 || s.clearance < 0.03 * radius_) continue;
                    best = std::max(best, look_from(eye, best, view));
                }
        return best > 0.0;
    }

    /// Twelve directions round the horizon, a little downward; `view` becomes the best if it beats `best`.
    double look_from(dvec3 const& eye, double best, SuggestedView& view) const {
        constexpr std::array<std::array<double, 2>, 3> turns{{{1.0, 0.0}, {0.866, 0.5}, {0.5, 0.866}}};
        for (auto const& turn : turns)
            for (int quarter = 0; quarter < 4; ++quarter) {
                double const x = quarter % 2 == 0 ? turn[0] : -turn[1];
                double const z = quarter % 2 == 0 ? turn[1] : turn[0];
                double const sign = quarter < 2 ? 1.0 : -1.0;
                dvec3 const target = eye + dvec3(sign * x, -0.12, sign * z) * (radius_ * 0.5);
                double const worth = worth_inside(eye, frame_of(eye, target, inside_fov_rad));
                if (worth <= best) continue;
                best = worth;
                view.eye_m = eye;
                view.target_m = target;
                view.fov_y_rad = inside_fov_rad;
            }
        return best;
    }

    /// The distance along `away` at which the bounds' corners fit the image.
    [[nodiscard]] double fitting_distance(dvec3 const& middle, dvec3 const& away) const {
        Frame const frame = frame_of(middle + away, middle, outside_fov_rad);
        double distance = radius_ * 0.1;
        for (unsigned corner = 0; corner < 8; ++corner) {
            dvec3 const c = at((corner & 1U) != 0 ? 1.0 : 0.0, (corner & 2U) != 0 ? 1.0 : 0.0, (corner & 4U) != 0 ? 1.0 : 0.0) - middle;
            double const sideways = std::max(std::abs(glm::dot(c, frame.right)), std::abs(glm::dot(c, frame.up)));
            distance = std::max(distance, sideways / frame.slope - glm::dot(c, frame.forward));
        }
        return distance;
    }

    /// Whether the scene lies flat on the ground, as a city does: then nearer, so that what stands on it can be made out.
    [[nodiscard]] double closeness() const {
        double const across = std::max(size_.x, size_.z);
        return size_.y < 0.25 * across ? 0.7 : 1.05;
    }

    void find_outside(SuggestedView& view) const {
        // Left of the front first: the side that the default sun shines on, at an angle.
        constexpr std::array<std::array<double, 2>, 8> sides{
            {{-0.6, 0.8}, {0.6, 0.8}, {0.8, -0.6}, {-0.8, 0.6}, {0.8, 0.6}, {-0.8, -0.6}, {-0.6, -0.8}, {0.6, -0.8}}};
        dvec3 const middle = at(0.5, 0.45, 0.5);
        double best = -1e300;
        for (std::size_t i = 0; i < sides.size(); ++i) {
            dvec3 const away = glm::normalize(dvec3(sides[i][0], 0.55, sides[i][1]));
            dvec3 const eye = middle + away * (fitting_distance(middle, away) * closeness());
            double const worth = worth_outside(eye, middle) + (i == 0 ? 0.1 : 0.0);
            if (worth <= best) continue;
            best = worth;
            view.eye_m = eye;
            view.target_m = middle;
            view.fov_y_rad = outside_fov_rad;
        }
        zoom_in(view);
    }

    /// Turns to the middle of what is seen, and narrows the field until it fills the image but for a border.
    void zoom_in(SuggestedView& view) const {
        constexpr double narrowest_slope = 0.2;
        constexpr int side = 40;
        constexpr double border = 2.0 / side + 0.06;
        Frame const frame = frame_of(view.eye_m, view.target_m, view.fov_y_rad);
        math::dvec2 lo(1.0);
        math::dvec2 hi(-1.0);
        each_pixel(side, [&](double x, double y) {
            if (grid_.cast(view.eye_m, frame.through(x, y)).triangle == none) return;
            lo = glm::min(lo, math::dvec2(x, y));
            hi = glm::max(hi, math::dvec2(x, y));
        });
        double const widest = std::max(hi.x - lo.x, hi.y - lo.y) * 0.5 + border;
        if (!(hi.x >= lo.x) || widest >= 1.0) return;
        math::dvec2 const middle = (lo + hi) * 0.5;
        view.target_m = view.eye_m + frame.through(middle.x, middle.y) * glm::length(view.target_m - view.eye_m);
        view.fov_y_rad = 2.0 * std::atan(std::max(frame.slope * widest, narrowest_slope));
    }

    /// How much of the image is covered, and how much of that by fronts.
    [[nodiscard]] double worth_outside(dvec3 const& eye, dvec3 const& middle) const {
        Frame const frame = frame_of(eye, middle, outside_fov_rad);
        double covered = 0.0;
        double fronts = 0.0;
        double near = 0.0;
        constexpr int side = 12;
        each_pixel(side, [&](double x, double y) {
            GridHit const hit = grid_.cast(eye, frame.through(x, y));
            if (hit.triangle == none) return;
            covered += 1.0;
            fronts += hit.front ? 1.0 : 0.0;
            near += hit.distance < 0.1 * radius_ ? 1.0 : 0.0;
        });
        return (covered * 0.5 + fronts - 2.0 * near) / (side * side);
    }

    /// A quarter of the way to the nearest thing in the image, and never so near that depth loses its precision.
    void choose_near(SuggestedView& view) const {
        Frame const frame = frame_of(view.eye_m, view.target_m, view.fov_y_rad);
        double nearest = radius_;
        each_pixel(32, [&](double x, double y) {
            // Wider than the image is tall: it may be wider.
            GridHit const hit = grid_.cast(view.eye_m, frame.through(x * 1.8, y));
            if (hit.triangle != none) nearest = std::min(nearest, hit.distance);
        });
        view.near_m = std::max(nearest * 0.25, radius_ * 1e-4);
    }

    CoarseGrid grid_;
    dvec3 lo_;
    dvec3 size_;
    double radius_;
};

}  // namespace

core::Result<math::View, math::ViewError> make_view(Camera const& camera, math::ivec2 const& size_px, math::Depth depth) {
    bool const perspective = camera.kind == CameraKind::perspective;
    auto framed = [&] {
        dvec3 const target = camera.eye_m - camera.back;
        double const aspect = static_cast<double>(size_px.x) / std::max(size_px.y, 1);
        double const half = camera.half_height_m;
        if (perspective)
            return math::make_perspective({camera.eye_m, target, camera.up, camera.fov_y_rad, camera.near_m,
                                           camera.far_m, size_px, depth});
        return math::make_orthographic({camera.eye_m, target, camera.up, {-half * aspect, half * aspect, -half, half},
                                        camera.near_m, camera.far_m, size_px, depth});
    }();
    if (!framed) return framed;
    // The camera's own axes, rather than those that target and up give again, rounded.
    framed->right = camera.right;
    framed->up = camera.up;
    framed->back = camera.back;
    return framed;
}

SuggestedView auto_view(Geometry const& geometry) {
    if (math::is_empty(geometry.bounds)) return SuggestedView{};
    SuggestedView view = Chooser(geometry).run();
    view.eye_m += geometry.origin_m;
    view.target_m += geometry.origin_m;
    return view;
}

SuggestedView auto_view(Scene const& scene) { return auto_view(flatten(scene)); }

}  // namespace gnomon::scene
