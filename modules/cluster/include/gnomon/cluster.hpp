#pragma once
// Who divides a view: grids of clusters and their planes.

#include <gnomon/cluster/grid.hpp>
#include <gnomon/cluster/grid_view.hpp>
#include <gnomon/cluster/slices.hpp>
