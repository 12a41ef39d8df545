#pragma once
// What a hierarchy is built over: spheres or boxes, an array per coordinate, as the caller has them.

#include <gnomon/core/contract.hpp>
#include <gnomon/math/formula/touch.glsl>
#include <gnomon/math/lanes.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <span>

namespace gnomon::bvh {

/// `fields` numbers of type formula::Float<S> make one item, or one a lane.
template <class S, std::size_t fields>
using ItemOf = std::array<formula::Float<S>, fields>;

/// Spheres: centres and radii. An item with a negative radius has no point; see `usable`.
struct Spheres {
    static constexpr std::size_t fields = 4;
    static constexpr std::array<float, 4> nothing{0.0F, 0.0F, 0.0F, -1.0F};  ///< What fills a last node.

    std::span<float const> x, y, z, radius;

    [[nodiscard]] std::size_t size() const noexcept { return x.size(); }
    [[nodiscard]] std::array<float const*, 4> arrays() const noexcept {
        GNOMON_EXPECT(y.size() == x.size() && z.size() == x.size() && radius.size() == x.size());
        return {x.data(), y.data(), z.data(), radius.data()};
    }

    template <class S>
    [[nodiscard, gnu::always_inline]] static formula::GnSphere<S> shape(ItemOf<S, 4> const& item) noexcept {
        return {formula::Vec3<S>(item[0], item[1], item[2]), item[3]};
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] static formula::GnBox<S> box(ItemOf<S, 4> const& item) noexcept {
        return gn_box_of(shape<S>(item));
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] static formula::Bool<S> usable(ItemOf<S, 4> const& item) noexcept {
        return gn_is_finite3(shape<S>(item).center) && gn_is_finite(item[3]) && item[3] >= 0.0;
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] static formula::Vec3<S> half_center(ItemOf<S, 4> const& item) noexcept {
        return shape<S>(item).center * formula::Float<S>(0.5);
    }
};

/// Boxes: lowest and highest coordinates.
struct Boxes {
    static constexpr std::size_t fields = 6;
    static constexpr float infinite = std::numeric_limits<float>::infinity();
    static constexpr std::array<float, 6> nothing{infinite, infinite, infinite, -infinite, -infinite, -infinite};

    std::span<float const> lo_x, lo_y, lo_z, hi_x, hi_y, hi_z;

    [[nodiscard]] std::size_t size() const noexcept { return lo_x.size(); }
    [[nodiscard]] std::array<float const*, 6> arrays() const noexcept {
        GNOMON_EXPECT(lo_y.size() == lo_x.size() && lo_z.size() == lo_x.size() && hi_x.size() == lo_x.size() &&
                      hi_y.size() == lo_x.size() && hi_z.size() == lo_x.size());
        return {lo_x.data(), lo_y.data(), lo_z.data(), hi_x.data(), hi_y.data(), hi_z.data()};
    }

    template <class S>
    [[nodiscard, gnu::always_inline]] static formula::GnBox<S> shape(ItemOf<S, 6> const& item) noexcept {
        return {formula::Vec3<S>(item[0], item[1], item[2]), formula::Vec3<S>(item[3], item[4], item[5])};
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] static formula::GnBox<S> box(ItemOf<S, 6> const& item) noexcept {
        return shape<S>(item);
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] static formula::Bool<S> usable(ItemOf<S, 6> const& item) noexcept {
        return gn_is_finite3(shape<S>(item).lo) && gn_is_finite3(shape<S>(item).hi) && !gn_is_empty(shape<S>(item));
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] static formula::Vec3<S> half_center(ItemOf<S, 6> const& item) noexcept {
        formula::Float<S> const quarter(0.25);
        return shape<S>(item).lo * quarter + shape<S>(item).hi * quarter;
    }
};

template <class T>
concept ItemList = std::same_as<T, Spheres> || std::same_as<T, Boxes>;

}  // namespace gnomon::bvh
