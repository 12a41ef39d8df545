#pragma once
// Cascades of shadow maps that scroll: splits, light space in whole texels and depth units, and what becomes of each
// map from frame to frame.

#include <gnomon/cascade/cascades.hpp>
#include <gnomon/cascade/error.hpp>
#include <gnomon/cascade/fit.hpp>
#include <gnomon/cascade/guard.hpp>
#include <gnomon/cascade/light_frame.hpp>
#include <gnomon/cascade/place.hpp>
#include <gnomon/cascade/scroll.hpp>
#include <gnomon/cascade/select.hpp>
#include <gnomon/cascade/splits.hpp>
#include <gnomon/cascade/step.hpp>
#include <gnomon/cascade/sub_frustum.hpp>
#include <gnomon/cascade/toroidal.hpp>
#include <gnomon/cascade/view.hpp>
#include <gnomon/cascade/volume.hpp>
