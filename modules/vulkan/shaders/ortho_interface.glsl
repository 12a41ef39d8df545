// What the shaders of an integer pass share: the layouts of src/ortho_layout.hpp.

#include "pass_items.glsl"

struct Light {
    dvec4 right;     // w: 256 units a texel, over its metres
    dvec4 down;
    dvec4 away;      // w: of depth
    dvec4 origin_m;  // w: the last code
    dvec4 image;     // Where it begins, in units.
    dvec4 unused[3];
};

layout(set = 0, binding = 0, std140) uniform Lights { Light lights[24]; };

layout(push_constant) uniform Push {
    ivec4 area_px;    // Left, top, right, bottom of what is drawn.
    ivec2 centre_px;  // Of the viewport, whose side is a power of two.
    float per_unit;   // Of clip space: 1 / (128 sides)
    float per_code;   // Of depth.
    int most_units;   // From the centre, and
    int most_size;    // of a triangle's bounds: beyond, the fragment shader finds out what is covered.
    uint light;
    uint cull;        // backend::Cull
    uint flags;
} push;

const uint is_reversed = 1u;
const uint clips_range = 2u;

// How a triangle is drawn.
const uint by_device = 0u;
const uint by_cover = 1u;      // A triangle about its bounds; which samples it covers is tested.
const uint by_far_cover = 2u;  // The same in 128 bits.

// Which triangles a call draws.
const uint all_triangles = 0u;
const uint gentle_triangles = 1u;  // Those whose depths the device interpolates.
const uint other_triangles = 2u;   // The rest, exactly.
const double gentle_units = 8388608.0LF;  // 2^15 codes, of which 8 e are 2^-6
