#pragma once
// Lights, and which clusters of a grid each of them touches.

#include <gnomon/lights/admit.hpp>
#include <gnomon/lights/bounding_ball.hpp>
#include <gnomon/lights/brute_force.hpp>
#include <gnomon/lights/hierarchical.hpp>
#include <gnomon/lights/hull.hpp>
#include <gnomon/lights/light.hpp>
#include <gnomon/lights/light_tree.hpp>
#include <gnomon/lights/lists.hpp>
#include <gnomon/lights/place.hpp>
#include <gnomon/lights/planes.hpp>
#include <gnomon/lights/shade.hpp>
#include <gnomon/lights/sparse.hpp>
