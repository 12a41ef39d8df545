#pragma once
// Depth slices: a table of planes, and which slice holds a depth. The table is the only owner: key and bounds read the
// same floats, so they cannot disagree, and no logarithm decides anything.
//
// source: [Olsson 2014, Paper II, 3.1, eq. 1-2, figure 2]

#include <gnomon/cluster/formula/slices.glsl>
#include <gnomon/core/result.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::cluster {

inline constexpr std::uint32_t max_slices = 65536;

enum class SliceError : std::uint8_t {
    not_finite,      ///< A depth or extent is NaN or infinite where it cannot be: give a finite one.
    bad_range,       ///< Depths that do not rise, or are not above 0 where the scheme needs it.
    bad_count,       ///< No slice, or more than `max_slices`: fewer or thicker ones.
    bad_field,       ///< Extent or number of tiles of an exponential scheme not above 0.
    too_thin,        ///< Two planes are the same float: fewer slices, or a wider range.
};

/// Self-similar slices, as deep as a tile is high, so that clusters are as cubical as can be. As many as reach `far_m`;
/// the last has its full depth.
///
///     near_k = near (1 + (tan up + tan down) / S_y)^k
///
/// source:  [Olsson 2014, Paper II, eq. 1]: 2 tan(theta) is the extent of a centred view; S_y is the NUMBER of tiles
struct ExponentialSlices {
    double near_m = 0.1;
    double far_m = 100.0;
    double extent_y = 1.1547005383792515;  ///< tan up + tan down: window.top - window.bottom of a perspective view.
    std::uint32_t tiles_y = 1;
    bool open_end = false;  ///< The last plane is infinite: for views that reach farther.
};

/// Equal steps of metres. The one for orthographic views, which may begin at or behind the eye.
struct UniformSlices {
    double near_m = 0.1;
    double far_m = 100.0;
    std::uint32_t count = 1;
    bool open_end = false;
};

/// Equal steps of the depth buffer of a perspective view; the same planes for forward and reversed depth.
struct UniformDepthSlices {
    double near_m = 0.1;
    double far_m = std::numeric_limits<double>::infinity();
    std::uint32_t count = 1;
    bool open_end = false;
};

/// A first slice as deep as one likes, then exponential ones.
///
///     near_k = last (last / first)^((k - count) / (count - 1))   for k of 1 and above
struct FirstThenExponentialSlices {
    double near_m = 0.1;
    double first_end_m = 5.0;
    double last_m = 100.0;
    std::uint32_t count = 16;
    bool open_end = false;
};

/// What a shader gets in a uniform or push constant, beside `DepthSlices::words()`.
using SliceTable = formula::GnSliceTable;

static_assert(sizeof(SliceTable) == 24 && std::is_trivially_copyable_v<SliceTable>);

/// Planes and the search table over them. Made by `make_slices`; never empty.
class DepthSlices {
public:
    [[nodiscard]] std::uint32_t count() const noexcept { return table_.slices; }
    /// Strictly ascending; slice k is from plane k to plane k + 1. Only the last may be infinite.
    [[nodiscard]] std::span<float const> planes_m() const noexcept { return planes_m_; }
    [[nodiscard]] SliceTable const& table() const noexcept { return table_; }
    [[nodiscard]] std::span<std::uint32_t const> words() const noexcept { return words_; }

    /// expects: what `make_slices` makes.
    DepthSlices(std::vector<float> planes_m, SliceTable const& table, std::vector<std::uint32_t> words) noexcept
        : planes_m_(std::move(planes_m)), table_(table), words_(std::move(words)) {}

private:
    std::vector<float> planes_m_;
    SliceTable table_;
    std::vector<std::uint32_t> words_;
};

using SliceResult = core::Result<DepthSlices, SliceError>;

/// Planes are computed in double by products and quotients, the same on every machine, and rounded to float.
///
/// cost:    O(slices); allocates the tables
[[nodiscard]] SliceResult make_slices(ExponentialSlices const& config);
[[nodiscard]] SliceResult make_slices(UniformSlices const& config);
[[nodiscard]] SliceResult make_slices(UniformDepthSlices const& config);
[[nodiscard]] SliceResult make_slices(FirstThenExponentialSlices const& config);

/// Any planes of one's own, strictly ascending, at least two, only the last one infinite.
[[nodiscard]] SliceResult make_slices(std::span<float const> planes_m);

/// Slice that holds a point `depth_m` metres in front of the eye.
///
///     the number of planes, but for the first and the last, that are <= depth
///
/// Eq. 2's k = floor( ln(depth / near) / ln(1 + 2 tan(theta) / S_y) ), with the rounding errors of logarithms left out.
///
/// returns: any float is a legal depth: 0 before the first plane, behind the eye and for NaN; the last slice from its
///          first plane on, at infinity too
/// cost:    O(log planes in a part of the table), mostly one comparison
/// source:  [Olsson 2014, Paper II, eq. 2]
[[nodiscard]] inline std::uint32_t slice_at(DepthSlices const& slices, float depth_m) noexcept {
    return gn_slice_at(slices.table(), formula::Words{slices.words().data()}, formula::Float<float>(depth_m)).v;
}

}  // namespace gnomon::cluster

#include <gnomon/cluster/detail/make_slices.hpp>
