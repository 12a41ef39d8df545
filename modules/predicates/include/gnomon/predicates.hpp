#pragma once
// All of predicates.

#include <gnomon/predicates/edge_plane.hpp>
#include <gnomon/predicates/orient.hpp>
#include <gnomon/predicates/sign.hpp>
#include <gnomon/predicates/target.hpp>
#include <gnomon/predicates/triangle_list.hpp>
