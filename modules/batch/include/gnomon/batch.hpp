#pragma once
// All of batch.

#include <gnomon/batch/batches.hpp>
#include <gnomon/batch/build.hpp>
#include <gnomon/batch/refit.hpp>
#include <gnomon/batch/validate.hpp>
