#pragma once
// The CPU rasterizer: exact coverage, a depth with a stated bound, the same image from any number of threads.

#include <gnomon/raster/alpha_map.hpp>
#include <gnomon/raster/box_test.hpp>
#include <gnomon/raster/conservative.hpp>
#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/raster/depth_pyramid.hpp>
#include <gnomon/raster/draw.hpp>
#include <gnomon/raster/instances.hpp>
#include <gnomon/raster/layers.hpp>
#include <gnomon/raster/ortho.hpp>
#include <gnomon/raster/pass.hpp>
#include <gnomon/raster/sample_query.hpp>
#include <gnomon/raster/target.hpp>
#include <gnomon/raster/tile_workspace.hpp>
#include <gnomon/raster/triangle.hpp>
