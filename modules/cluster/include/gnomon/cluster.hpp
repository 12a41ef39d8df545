#pragma once
// Who divides a view: depth slices, grids of clusters, keys of samples, unique clusters and their bounds.

#include <gnomon/cluster/bounds.hpp>
#include <gnomon/cluster/grid.hpp>
#include <gnomon/cluster/grid_view.hpp>
#include <gnomon/cluster/key.hpp>
#include <gnomon/cluster/make_keys.hpp>
#include <gnomon/cluster/normal_cells.hpp>
#include <gnomon/cluster/reduce.hpp>
#include <gnomon/cluster/slices.hpp>
#include <gnomon/cluster/tile_depth.hpp>
#include <gnomon/cluster/unique.hpp>
#include <gnomon/cluster/unique_workspace.hpp>
