#pragma once
// A twig with leaves, painted pixel by pixel.

#include <gnomon/scene/scene.hpp>

namespace gnomon::scene::detail {

/// Nine pointed leaves on a stem that enters in the middle of the lower border; alpha 0 between them. Green everywhere, so
/// that filtered borders stay green.
///
/// expects: side_px > 0.
[[nodiscard]] Image paint_leaves(int side_px);

}  // namespace gnomon::scene::detail
