#pragma once
// Who divides a view: grids of clusters and their planes.

#include <gnomon/cluster/grid.hpp>
#include <gnomon/cluster/grid_view.hpp>
#include <gnomon/cluster/key.hpp>
#include <gnomon/cluster/normal_cells.hpp>
#include <gnomon/cluster/slices.hpp>
#include <gnomon/cluster/unique.hpp>
#include <gnomon/cluster/unique_workspace.hpp>
