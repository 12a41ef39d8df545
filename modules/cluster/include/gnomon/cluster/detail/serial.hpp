#pragma once
// The executor of whoever names none.

#include <gnomon/core/executor.hpp>

namespace gnomon::cluster::detail {

inline constexpr core::SerialExecutor serial{};

}  // namespace gnomon::cluster::detail
