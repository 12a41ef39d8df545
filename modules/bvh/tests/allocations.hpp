#pragma once

#include <cstdint>

/// How often the program has asked for memory so far, the driver and the layers included.
[[nodiscard]] std::uint64_t allocations_made() noexcept;
