#pragma once
// The atrium's sets of lights.

#include "generators.hpp"

#include <vector>

namespace gnomon::scene::detail {

inline constexpr double lantern_chain_m = 1.6;
inline constexpr double lantern_drop_m = 0.85;  ///< From the chain's end to the light, just below the lantern.

/// Where the lights of the galleries' lanterns are: 24 on each storey, those of the lower one first.
[[nodiscard]] std::vector<math::dvec3> lantern_places();

/// `sun`, `sponza65`, `million`, or any number of lamps, uniform in the hall.
void add_atrium_lights(Scene& scene, ProceduralConfig const& config);

}  // namespace gnomon::scene::detail
