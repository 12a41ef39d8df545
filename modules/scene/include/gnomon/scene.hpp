#pragma once
// All of scene.

#include <gnomon/scene/animation.hpp>
#include <gnomon/scene/batches.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/load.hpp>
#include <gnomon/scene/path.hpp>
#include <gnomon/scene/pose.hpp>
#include <gnomon/scene/procedural.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/scene/suggest.hpp>
#include <gnomon/scene/write.hpp>
