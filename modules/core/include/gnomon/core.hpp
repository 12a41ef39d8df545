#pragma once
// All of core, but for the adapters.

#include <gnomon/core/contract.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/core/id.hpp>
#include <gnomon/core/result.hpp>
#include <gnomon/core/sentence.hpp>
#include <gnomon/core/strided_span.hpp>
