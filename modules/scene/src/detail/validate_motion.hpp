#pragma once
// The part of `validate` that looks at what moves: nodes, joints, morph targets, clips.

#include <gnomon/scene/scene.hpp>

namespace gnomon::scene::detail {

Result<core::Done> validate_motion(Scene const& scene);

}  // namespace gnomon::scene::detail
