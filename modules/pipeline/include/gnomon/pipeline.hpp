#pragma once
// Everything of the pipeline: techniques over a backend, measured against the exact truth.

#include <gnomon/pipeline/error.hpp>
#include <gnomon/pipeline/frame.hpp>
#include <gnomon/pipeline/image.hpp>
#include <gnomon/pipeline/light.hpp>
#include <gnomon/pipeline/lighting.hpp>
#include <gnomon/pipeline/measures.hpp>
#include <gnomon/pipeline/report.hpp>
#include <gnomon/pipeline/shade.hpp>
#include <gnomon/pipeline/technique.hpp>
