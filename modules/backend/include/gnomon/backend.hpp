#pragma once
// What every backend is given and can do: draws, passes, kernels, the verbs, and a backend that does nothing.

#include <gnomon/backend/check.hpp>
#include <gnomon/backend/check_ortho.hpp>
#include <gnomon/backend/depth_kernel.hpp>
#include <gnomon/backend/draw.hpp>
#include <gnomon/backend/error.hpp>
#include <gnomon/backend/forward.hpp>
#include <gnomon/backend/fragment.hpp>
#include <gnomon/backend/instances.hpp>
#include <gnomon/backend/kernel.hpp>
#include <gnomon/backend/null.hpp>
#include <gnomon/backend/ortho.hpp>
#include <gnomon/backend/pass.hpp>
#include <gnomon/backend/slots.hpp>
#include <gnomon/backend/verbs.hpp>
