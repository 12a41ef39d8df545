#pragma once
// Which lights take part: what is bad or on other layers is left out, and counted.

#include <gnomon/core/contract.hpp>
#include <gnomon/cull/rows.hpp>
#include <gnomon/lights/light.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::lights {

/// The largest coordinate, range and half axis that culling takes: 2^60 m, whose square is a float.
inline constexpr float max_size_m = 1152921504606846976.0F;

/// What became of a list of lights.
struct Report {
    std::uint32_t taken = 0;     ///< took part, whether or not they touch a cluster
    std::uint32_t bad = 0;       ///< left out: NaN, infinite, beyond 2^60 m, or a range (a box's size) not above 0,
                               ///< an axis shorter than 2^-20, an angle that is none
    std::uint32_t masked = 0;    ///< left out: on none of the layers asked for
    friend bool operator==(Report const&, Report const&) = default;
};

/// The radius of the ball about a light's centre that holds it; 0 for a directional one.
///
///     box: the longest of the four diagonals u + v + w, u + v - w, ...
[[nodiscard]] inline float bounding_radius_m(Light const& l) noexcept {
    if (l.kind == Kind::directional) return 0.0F;
    if (l.kind != Kind::box) return l.range_m;
    float longest_sq = 0.0F;
    for (int signs = 0; signs < 4; ++signs) {
        float const v = (signs & 1) != 0 ? -1.0F : 1.0F, w = (signs & 2) != 0 ? -1.0F : 1.0F;
        math::vec3 const d = l.axis + l.side * v + l.other * w;
        float const square = d.x * d.x + d.y * d.y + d.z * d.z;
        longest_sq = square > longest_sq || std::isnan(square) ? square : longest_sq;
    }
    return std::sqrt(longest_sq);
}

namespace detail {

[[nodiscard]] inline bool is_sound(math::vec3 const& v) noexcept {  // false for NaN
    return std::abs(v.x) <= max_size_m && std::abs(v.y) <= max_size_m && std::abs(v.z) <= max_size_m;
}

}  // namespace detail

[[nodiscard]] inline bool is_sound(Light const& l) noexcept {
    if (l.kind == Kind::directional) return true;
    if (!detail::is_sound(l.center)) return false;
    if (l.kind == Kind::box && !(detail::is_sound(l.axis) && detail::is_sound(l.side) && detail::is_sound(l.other))) return false;
    if (l.kind == Kind::spot) {
        float const axis_sq = l.axis.x * l.axis.x + l.axis.y * l.axis.y + l.axis.z * l.axis.z;
        if (!(axis_sq >= 0x1p-40F && axis_sq <= 0x1p60F)) return false;
        if (!(std::abs(l.cos_half) <= 1.0F && l.sin_half >= 0.0F && l.sin_half <= 1.0F)) return false;
        if (l.cos_half * l.cos_half + l.sin_half * l.sin_half < 0.5F) return false;
    }
    float const r = bounding_radius_m(l);
    return r > 0.0F && r <= max_size_m;
}

/// Neighbouring clusters of one row that a light touches: columns `first` to `first + count - 1`.
struct Run {
    std::uint32_t row;  ///< of the whole grid: slice * rows + row
    std::uint32_t first;
    std::uint32_t count;
    std::uint32_t light;
};

/// Up to 32 columns of a row, some of which have lists, and the row's runs.
struct RowPart {
    std::uint32_t start, end;  ///< of the runs by rows
    std::uint32_t column;
    std::uint32_t touched;     ///< a bit a column from that on, not 0
    std::uint64_t list_end;    ///< where the last of the lists ends
};

/// Runs by rows, in each row by lights, in arrays that may be read in 32s: for lights that 16 bits can count.
struct RowRuns {
    bool used = false;
    std::size_t lights = 0;               ///< of the caller's list
    std::vector<std::uint32_t> start;     ///< of each row's runs; one more, their end, and another for the sort
    std::vector<std::uint16_t> first, count, light;
    std::vector<RowPart> parts;
    std::size_t part_count = 0;
};

/// How many clusters a light touches.
struct LightPairs {
    std::uint32_t light;
    float importance;
    std::uint64_t pairs;
};

/// Memory of the assignment. Keeps what it has from frame to frame, so that nothing is allocated after the first.
struct Workspace {
    std::vector<float> x, y, depth, radius;  ///< of the points and spots that take part; 64 more may be read
    std::vector<float> axis[3], cosine, sine;  ///< of the narrow spots among them; the others have a cosine of -1
    bool cones = false;                      ///< there are such spots
    std::vector<std::uint32_t> index;        ///< which they are in the caller's list, ascending; padded too
    std::size_t count = 0;
    std::vector<std::uint32_t> others;       ///< directional lights and boxes that take part: they go one by one
    std::vector<Run> runs;                   ///< lists: what each light touches, by lights
    std::size_t run_count = 0;
    std::uint32_t columns = 0;               ///< lists: of the grid
    std::vector<std::uint32_t> cursors;      ///< lists: how many lights a cluster has, then where its next one goes
    RowRuns by_rows;                         ///< lists by wide lanes: in the place of `cursors`
    std::vector<LightPairs> pairs;           ///< lists: used where a fixed capacity overflows
};

namespace detail {

inline void admit_cone(Light const& l, std::size_t n, Workspace& work) noexcept {
    work.cosine[n] = -1.0F;
    if (l.kind != Kind::spot || !cull::is_narrow(l.cos_half, l.sin_half)) return;
    work.axis[0][n] = l.axis.x;
    work.axis[1][n] = l.axis.y;
    work.axis[2][n] = l.axis.z;
    work.cosine[n] = l.cos_half;
    work.sine[n] = l.sin_half;
    work.cones = true;
}

}  // namespace detail

/// Fills the lists of what takes part.
///
/// cost: O(lights)
[[nodiscard]] inline Report admit(std::span<Light const> lights, std::uint32_t layers, Workspace& work) {
    GNOMON_EXPECT(lights.size() < 0xFFFFFFFFU);
    std::size_t const padded = lights.size() + 64;
    for (auto* list : {&work.x, &work.y, &work.depth, &work.radius, &work.axis[0], &work.axis[1], &work.axis[2], &work.cosine, &work.sine})
        list->resize(padded);
    work.index.resize(padded);
    work.cones = false;
    work.others.clear();
    Report report;
    std::size_t n = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        Light const& l = lights[i];
        if ((l.layers & layers) == 0) {
            ++report.masked;
        } else if (!is_sound(l)) {
            ++report.bad;
        } else if (l.kind == Kind::directional || l.kind == Kind::box) {
            work.others.push_back(static_cast<std::uint32_t>(i));
        } else {
            work.x[n] = l.center.x;
            work.y[n] = l.center.y;
            work.depth[n] = l.center.z;
            work.radius[n] = bounding_radius_m(l);
            detail::admit_cone(l, n, work);
            work.index[n++] = static_cast<std::uint32_t>(i);
        }
    }
    report.taken = static_cast<std::uint32_t>(n + work.others.size());
    work.count = n;
    for (std::size_t i = n; i < padded; ++i) {
        work.index[i] = 0;
        work.cosine[i] = -1.0F;
        work.x[i] = work.y[i] = 0.0F;
        work.depth[i] = work.radius[i] = 1.0F;
    }
    return report;
}

}  // namespace gnomon::lights
