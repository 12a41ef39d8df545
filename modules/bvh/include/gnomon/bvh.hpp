#pragma once
// Umbrella: the wide Morton hierarchy over boxes or spheres.

#include <gnomon/bvh/build.hpp>
#include <gnomon/bvh/cost.hpp>
#include <gnomon/bvh/items.hpp>
#include <gnomon/bvh/query.hpp>
#include <gnomon/bvh/refit.hpp>
#include <gnomon/bvh/region.hpp>
#include <gnomon/bvh/tree.hpp>
#include <gnomon/bvh/validate.hpp>
