// The box test over AVX2 lanes. Every function carries the instruction set as an attribute.

#include "box_job.hpp"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(GNOMON_FORCE_SCALAR) && !defined(GNOMON_SCALAR)

#include "box_lanes_avx2.hpp"
#include "pieces.hpp"

namespace gnomon::raster::detail {

namespace avx2_lanes {

namespace {

#define GNOMON_LANE_FN GNOMON_AVX2_INLINE
#define GNOMON_LANE_BODY GNOMON_AVX2
#include "box_core.hpp"

}  // namespace

}  // namespace avx2_lanes

TestBoxesFn simd_test_boxes() noexcept {
    return __builtin_cpu_supports("avx2") ? &avx2_lanes::test_boxes : nullptr;
}

}  // namespace gnomon::raster::detail

#else

namespace gnomon::raster::detail {

TestBoxesFn simd_test_boxes() noexcept { return nullptr; }

}  // namespace gnomon::raster::detail

#endif
