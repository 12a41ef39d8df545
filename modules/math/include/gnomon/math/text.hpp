#pragma once
// Numbers and vectors in sentences of failures.

#include <gnomon/core/sentence.hpp>
#include <gnomon/math/vec.hpp>

#include <string>

namespace gnomon::math {

using core::text_of;

/// "(1, 0.5, 1e-12)"
[[nodiscard]] inline std::string text_of(dvec3 const& v) {
    return core::sentence({"(", text_of(v.x), ", ", text_of(v.y), ", ", text_of(v.z), ")"});
}

}  // namespace gnomon::math
