#pragma once
// The tightest box of a caster whose corners are known: fewer casters then reach into a strip.

#include <gnomon/cache/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace gnomon::cache {

/// Collects corners in 1/256 units, rounded as orthographic passes in whole units round them.
///
///     x = rne(((right.x p.x + right.y p.y) + right.z p.z) * (256 / texel_m)), y and z alike
///
/// A texel is drawn where its centre is covered. Texels whose centre is within 1/16 texel of the corners' extent are in the
/// box, too, for devices that project in float; depths reach one unit beyond the extent.
class LightBounds {
public:
    /// expects: the units are > 0.
    explicit LightBounds(LightUnits const& light) noexcept
        : light_(light), per_texel_(256.0 / light.texel_m), per_unit_(256.0 / light.depth_unit_m) {
        GNOMON_EXPECT(light.texel_m > 0.0 && light.depth_unit_m > 0.0);
    }

    /// A corner: its world position minus the anchor. One that is NaN, infinite, or beyond 2^50 units is left out and counted.
    void add(math::dvec3 const& p_m) noexcept {
        double const at[3] = {along(light_.right, p_m) * per_texel_, along(light_.down, p_m) * per_texel_,
                              along(light_.away, p_m) * per_unit_};
        for (double const c : at)
            if (!(std::abs(c) <= 0x1p58)) {
                ++left_out_;
                return;
            }
        for (int i = 0; i < 3; ++i) {
            low_[i] = std::min(low_[i], at[i]);
            high_[i] = std::max(high_[i], at[i]);
        }
    }
    /// returns: nothing if no corner was added. A box that covers no texel's centre is empty.
    [[nodiscard]] std::optional<Box> box() const noexcept {
        if (!(low_[0] <= high_[0])) return std::nullopt;
        return Box{first_centre(low_[0]), first_centre(low_[1]), floor_of(low_[2]) - 1,
                   last_centre(high_[0]) + 1, last_centre(high_[1]) + 1, -floor_of(-high_[2]) + 1};
    }
    [[nodiscard]] std::uint64_t left_out() const noexcept { return left_out_; }

private:
    [[nodiscard]] static double along(math::dvec3 const& axis, math::dvec3 const& p) noexcept {
        return (axis.x * p.x + axis.y * p.y) + axis.z * p.z;
    }
    /// In whole units, of 1/256 units that are rounded here: half of 1/256 is far less than the slack.
    [[nodiscard]] static std::int64_t floor_of(double sub) noexcept {
        return static_cast<std::int64_t>(std::floor(sub * 0x1p-8));
    }
    /// The first texel whose centre is not before `low` - 1/16: t + 1/2 >= low - 1/16.
    [[nodiscard]] static std::int64_t first_centre(double low) noexcept {
        return -floor_of(-(low - slack - 128.0));
    }
    [[nodiscard]] static std::int64_t last_centre(double high) noexcept { return floor_of(high + slack - 128.0); }

    static constexpr double slack = 16.0;  ///< 1/16 texel.

    LightUnits light_;
    double per_texel_;
    double per_unit_;
    double low_[3] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                      std::numeric_limits<double>::infinity()};
    double high_[3] = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                       -std::numeric_limits<double>::infinity()};
    std::uint64_t left_out_ = 0;
};

}  // namespace gnomon::cache
