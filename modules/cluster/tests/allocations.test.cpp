#include <gnomon/check/allocations.hpp>

GNOMON_COUNT_ALLOCATIONS;
