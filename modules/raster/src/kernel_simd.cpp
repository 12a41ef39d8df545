// The vector kernel: AVX2, eight vertices, triangles or samples at a time; equal to the reference bit for bit.
//
// Every function here carries the instruction set as an attribute, so nothing compiled for AVX2 can leak into another
// unit, and FMA is never on: products and sums round separately, as in the reference.

#include "kernel.hpp"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(GNOMON_FORCE_SCALAR) && !defined(GNOMON_SCALAR)

#include "avx2_masked.hpp"
#include "avx2_setup.hpp"
#include "avx2_tile.hpp"
#include "avx2_transform.hpp"

namespace gnomon::raster::detail {

KernelTable const* avx2_kernel() noexcept {
    static constexpr KernelTable table{&avx2_transform, &avx2_setup,  &avx2_tile, &avx2_clear,
                                       &avx2_stream,    &avx2_masked, nullptr,    nullptr};
    return __builtin_cpu_supports("avx2") ? &table : nullptr;
}

}  // namespace gnomon::raster::detail

#else

namespace gnomon::raster::detail {

KernelTable const* avx2_kernel() noexcept { return nullptr; }

}  // namespace gnomon::raster::detail

#endif
