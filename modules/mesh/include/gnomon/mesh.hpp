#pragma once
// All of mesh.

#include <gnomon/mesh/deviation.hpp>
#include <gnomon/mesh/fans.hpp>
#include <gnomon/mesh/half_edges.hpp>
#include <gnomon/mesh/validate.hpp>
#include <gnomon/mesh/weld.hpp>
