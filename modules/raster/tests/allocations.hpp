#pragma once

#include <cstdint>

/// How often the program has asked for memory so far.
[[nodiscard]] std::uint64_t allocations_made() noexcept;
