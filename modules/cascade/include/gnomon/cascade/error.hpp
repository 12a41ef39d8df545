#pragma once
// Why cascades cannot be placed.

#include <cstdint>

namespace gnomon::cascade {

enum class Error : std::uint8_t {
    not_finite,    ///< A position, direction, length or fraction is NaN or infinite: give a finite one.
    no_direction,  ///< The light's direction has no length: give one, such as (0, -1, 0).
    bad_count,     ///< No cascade, or more than `max_cascades`.
    bad_range,     ///< Depths that do not rise, or are not above 0 where the scheme needs it.
    bad_fraction,  ///< Lambda or overlap beyond [0, 1], or steps that are no power of two.
    bad_size,      ///< A map of no texels or too many, or one that filter and guard band leave no texel of.
    bad_depth,     ///< Scene bounds that are empty, or a length or guard of depth that is not a length.
    too_far,       ///< A coordinate beyond `max_light_units`: move the anchor nearer.
};

}  // namespace gnomon::cascade
