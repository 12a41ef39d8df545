#pragma once
// The pipeline's kernels: what stands in their buffers and constants, laid out by std430. The GLSL halves
// (shaders/*.comp) declare the same; both are run over the same samples.

#include <gnomon/backend/kernel.hpp>
#include <gnomon/sample/view_sample.hpp>
#include <gnomon/shadow/lookup.hpp>
#include <gnomon/trace/alpha.hpp>
#include <gnomon/trace/bvh.hpp>

#include <cstddef>
#include <cstdint>

namespace gnomon::pipeline {

// --- What both kernels read of a frame -----------------------------------------------------------------------------
//
// samples   sample::ViewSample[n]: uint triangle, float position[3]; 16 bytes
// reached   uint8[n], four to a word, the first in the lowest bits: 0 where the light's range or cone does not reach

static_assert(sizeof(sample::ViewSample) == 16 && offsetof(sample::ViewSample, position) == 4);

// --- shadow_lookup: how much light arrives at each sample, as the shadow maps see it --------------------------------
//
// buffers   0 samples   1 float normals[n][3]   2 reached   3 shadow::MapView maps[]   4 out float visibility[n]
//           5 out float bias_m[n]
// targets   0 the maps' depths: layer i is maps[i]
// A sample that is not reached gets visibility 0 and bias 0. With six maps, the one that the sample's direction from
// the light picks: projection::face_of.

struct ShadowLookupStd {
    std::uint32_t count;    ///< Samples.
    std::uint32_t maps;     ///< 1, or 6: the faces of a cube.
    std::uint32_t unorm16;  ///< The maps hold codes.
    float light[3];         ///< Work space; of six maps.
    formula::GnShadowConfig config;
};
static_assert(sizeof(ShadowLookupStd) == 56 && offsetof(ShadowLookupStd, config) == 24);

extern backend::Kernel const shadow_lookup_kernel;

// --- ray: whether each sample sees the light, exactly ----------------------------------------------------------------
//
// buffers   0 trace::Node nodes[]     128 bytes: float lo[3][4], hi[3][4], uint child[4] (see trace::Child)
//           1 trace::Block blocks[]   160 bytes: float corner[3][3][4] (corner, axis, lane), uint id[4]
//           2 float positions[][3]    the geometry's, for the sample's own plane
//           3 uint corners[][3]       three indices for each triangle
//           4 samples                 5 reached
//           6 uint material_of[]      for each triangle; shorter than the triangles: the rest is solid
//           7 RayMaterialStd materials[]   8 RayTextureStd textures[]   9 texels: bytes   10 float corner_uv[][2]:
//           three for each triangle 11 out uint answer[n]
// Buffers 6 to 10 are not looked at (and hold nothing) unless `masked`. Sizes beyond what the constants say mean
// nothing.

/// What the kernel says of a sample. The C++ half is never unsure; what another half is unsure of is asked again there.
enum class RayAnswer : std::uint32_t {
    shadow = 0,  ///< Blocked, turned away by its own plane, or not reached.
    lit = 1,
    unsure = 2,
};

/// trace::AlphaMaterial.
struct RayMaterialStd {
    std::uint32_t is_masked;
    float factor;
    float cutoff;
    std::uint32_t texture;  ///< At or beyond `textures`: none.
};

/// math::AlphaTexture.
struct RayTextureStd {
    std::uint32_t first_byte;  ///< Of the texels, a multiple of 4.
    std::int32_t width;
    std::int32_t height;  ///< 0: a texture that is not complete, solid.
    std::uint32_t modes;  ///< wrap_u | wrap_v << 8 | channels << 16; see math::Wrap.
};
static_assert(sizeof(RayMaterialStd) == 16 && sizeof(RayTextureStd) == 16);

struct RayStd {
    std::uint32_t count;      ///< Samples.
    std::uint32_t nodes;      ///< 0: nothing blocks.
    std::uint32_t positions;  ///< Vertices.
    std::uint32_t triangles;  ///< Of `corners`.
    float light[3];           ///< A position, or the direction toward a light at infinity.
    std::uint32_t light_at_infinity;
    float eye[3];
    std::uint32_t eye_at_infinity;
    std::uint32_t masked;       ///< Some triangles have holes: buffers 6 to 10 are there.
    std::uint32_t material_of;  ///< Entries.
    std::uint32_t materials;
    std::uint32_t textures;
    std::uint32_t corner_uv;  ///< Entries: three for each triangle, or fewer.
};
static_assert(sizeof(RayStd) == 68);

extern backend::Kernel const ray_kernel;

}  // namespace gnomon::pipeline
