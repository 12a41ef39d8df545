#pragma once
// Conservative tests of lights against clusters.

#include <gnomon/cull/rows.hpp>
