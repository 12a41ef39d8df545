#pragma once
// All of math, but for the test generators.

#include <gnomon/math/bounds.hpp>
#include <gnomon/math/cone.hpp>
#include <gnomon/math/formula.hpp>
#include <gnomon/math/frustum.hpp>
#include <gnomon/math/half.hpp>
#include <gnomon/math/interval.hpp>
#include <gnomon/math/lanes.hpp>
#include <gnomon/math/morton.hpp>
#include <gnomon/math/plane.hpp>
#include <gnomon/math/plane_set.hpp>
#include <gnomon/math/scalar.hpp>
#include <gnomon/math/texel.hpp>
#include <gnomon/math/text.hpp>
#include <gnomon/math/touch.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/math/view.hpp>
