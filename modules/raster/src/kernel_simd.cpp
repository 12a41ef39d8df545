#include "kernel.hpp"
namespace gnomon::raster::detail {
KernelTable const* simd_kernel() noexcept { return nullptr; }
}
