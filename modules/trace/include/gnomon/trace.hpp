#pragma once
// All of trace.

#include <gnomon/trace/alpha.hpp>
#include <gnomon/trace/build.hpp>
#include <gnomon/trace/bvh.hpp>
#include <gnomon/trace/filter.hpp>
#include <gnomon/trace/query.hpp>
#include <gnomon/trace/segment.hpp>
#include <gnomon/trace/validate.hpp>
#include <gnomon/trace/visibility.hpp>
