#pragma once
// Copies of one draw, as every backend is given them: see gnomon/backend/instances.hpp.

#include <gnomon/backend/instances.hpp>

namespace gnomon::raster {

using backend::clip_from_instance;
using backend::InstanceSpan;
using backend::Rows3x4;

}  // namespace gnomon::raster
