#pragma once
// Conservative tests of lights against clusters.

#include <gnomon/cull/depth_range.hpp>
#include <gnomon/cull/normal_cone.hpp>
#include <gnomon/cull/box_rows.hpp>
#include <gnomon/cull/rows.hpp>
#include <gnomon/cull/screen_bounds.hpp>
#include <gnomon/cull/shapes.hpp>
#include <gnomon/cull/tile_planes.hpp>
