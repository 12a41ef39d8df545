#pragma once
// How samples look into cascades: the kernel `cascade_lookup`.
//
// buffers   0 samples   1 float normals[n][3]   2 reached   3 shadow::MapView maps[]   4 out float visibility[n]
//           5 out float bias_m[n]   6 cascade::CascadeDepths
// targets   0 the maps' depths: layer k is cascade k
// A sample beyond the last cascade is lit; one that is not reached gets visibility 0.

#include "../detail.hpp"
#include "../shadow/kernels.hpp"

#include <cstddef>
#include <cstdint>

namespace gnomon::pipeline {

struct CascadeLookupStd {
    std::uint32_t count;    ///< Samples.
    std::uint32_t unorm16;  ///< The maps hold codes.
    float eye[3];           ///< Of the camera, in work space.
    float sight[3];         ///< Unit vector.
    formula::GnShadowConfig config;
};
static_assert(sizeof(CascadeLookupStd) == 64 && offsetof(CascadeLookupStd, config) == 32);

extern backend::Kernel const cascade_lookup_kernel;

}  // namespace gnomon::pipeline
