#pragma once
// Umbrella: what of a shadow map can be kept from the last frame, what must be drawn, and why.

#include <gnomon/cache/box.hpp>
#include <gnomon/cache/budget.hpp>
#include <gnomon/cache/cached_map.hpp>
#include <gnomon/cache/light_bounds.hpp>
#include <gnomon/cache/map.hpp>
#include <gnomon/cache/object.hpp>
#include <gnomon/cache/object_table.hpp>
#include <gnomon/cache/plan.hpp>
#include <gnomon/cache/reason.hpp>
