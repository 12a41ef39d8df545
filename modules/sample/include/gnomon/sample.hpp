#pragma once
// All of sample.

#include <gnomon/sample/image_samples.hpp>
#include <gnomon/sample/reconstruct.hpp>
#include <gnomon/sample/view_sample.hpp>
