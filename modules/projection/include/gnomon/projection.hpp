#pragma once
// The views that lights look through: fitted suns, spots, and the six faces of a point light.

#include <gnomon/projection/cube.hpp>
#include <gnomon/projection/directional.hpp>
#include <gnomon/projection/error.hpp>
#include <gnomon/projection/range.hpp>
#include <gnomon/projection/spot.hpp>
