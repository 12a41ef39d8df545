#pragma once
// The parts of `town`: its plan, its ground, its buildings, its small things.

#include "generators.hpp"
#include "solid_builder.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::scene::detail {

// Streets cross every 100 m in x and every 60 m in z; the blocks between them take two rows of four plots.
inline constexpr double town_side_m = 600.0;
inline constexpr double town_pitch_x_m = 100.0;
inline constexpr double town_pitch_z_m = 60.0;
inline constexpr int town_blocks_x = 6;
inline constexpr int town_blocks_z = 10;
inline constexpr double street_half_m = 4.0;    ///< To the curb.
inline constexpr double pavement_end_m = 6.0;   ///< From the middle of the street.
inline constexpr double lane_m = 2.0;           ///< From the middle of the street to that of a lane.
inline constexpr double town_loop_s = 40.0;     ///< All that moves is back after this.

enum class Block : std::uint8_t {
    homes,
    park,
    market,  ///< Paved, with the church.
};

/// Which kind the block of this column and row is.
Block town_block(int column, int row) noexcept;

/// The lower corner (least x and z) of a block's cell: the crossing of two street middles.
math::dvec2 town_corner(int column, int row) noexcept;

/// Gentle hills as a lattice of points; what stands on them asks for the same triangles that are drawn.
class TownGround {
public:
    explicit TownGround(std::uint64_t seed);

    /// Height of the surface at a point of the town.
    [[nodiscard]] double height(double x, double z) const noexcept;

    /// Least and greatest height of the surface over a rectangle's corners and middle.
    [[nodiscard]] std::array<double, 2> heights(math::dvec2 const& lo, math::dvec2 const& hi) const noexcept;

    void add_to(Scene& scene) const;

private:
    [[nodiscard]] math::dvec3 point(std::size_t i, std::size_t j) const noexcept;

    std::vector<double> x_;
    std::vector<double> z_;
    std::vector<double> y_;
};

struct TownPaints {
    std::array<std::uint32_t, 8> walls{};
    std::array<std::uint32_t, 4> roofs{};
    std::array<std::uint32_t, 4> doors{};
    std::uint32_t glass = 0;
    std::uint32_t trim = 0;
    std::uint32_t stone = 0;
    std::uint32_t metal = 0;
};

TownPaints add_town_paints(Scene& scene);

/// A building with its front towards +z, its middle at the origin, its ground floor at y = 0 and its foundation 2 m below.
enum class BuildingKind : std::uint8_t {
    cottage,   ///< One or two floors under a gable, 6-10 m.
    terrace,   ///< Three floors, shop below, 11-14 m.
    flats,     ///< Four or five floors under a flat roof, 15-19 m.
    church,    ///< A nave and a tower of 20 m.
};
inline constexpr std::uint32_t building_kinds = 4;

Mesh make_building(BuildingKind kind, TownPaints const& paints, Pcg32& random);

/// Half the size of the ground that a building of this kind can take, at most.
math::dvec2 half_plan(BuildingKind kind) noexcept;

/// Lamps, fences, bare trees, benches, people, cars: 3000 in all. `moving` of them are carried round by nodes.
void add_town_props(Scene& scene, TownGround const& ground, Pcg32& random, std::uint32_t moving);

inline constexpr std::uint32_t town_props = 3000;

}  // namespace gnomon::scene::detail
