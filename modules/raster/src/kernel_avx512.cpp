// The vector kernel for AVX-512: sixteen samples at a time, in blocks of 4 x 4; equal to the reference bit for bit.
//
// As in kernel_simd.cpp every function carries the instruction set, and products and sums round separately.

#include "kernel.hpp"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(GNOMON_FORCE_SCALAR) && !defined(GNOMON_SCALAR)

#if !defined(__clang__)  // GCC 12 takes the intrinsics' own "undefined" registers for mistakes (its bug 105593).
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "avx512_layout.hpp"
#include "avx512_tile.hpp"
#include "masked.hpp"

namespace gnomon::raster::detail {

namespace {

KernelTable make_table(KernelTable const& narrower) noexcept {
    KernelTable table = narrower;  // Vertices and set-up are AVX2's.
    table.tile = &avx512_tile;
    table.clear = &avx512_clear;
    table.stream = &avx512_stream;
    table.masked = &draw_masked;
    table.to_rows = &avx512_to_rows;
    table.from_rows = &avx512_from_rows;
    return table;
}

}  // namespace

KernelTable const* avx512_kernel() noexcept {
    static bool const runs = avx2_kernel() != nullptr && __builtin_cpu_supports("avx512f") &&
                             __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
                             __builtin_cpu_supports("avx512vl");
    static KernelTable const table = make_table(runs ? *avx2_kernel() : scalar_kernel());
    return runs ? &table : nullptr;
}

}  // namespace gnomon::raster::detail

#else

namespace gnomon::raster::detail {

KernelTable const* avx512_kernel() noexcept { return nullptr; }

}  // namespace gnomon::raster::detail

#endif
