#pragma once
// How often this program has called operator new.

#include <cstddef>

std::size_t allocations();
