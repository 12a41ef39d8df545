// What a draw list holds, in every pass: the layouts of src/pass_layout.hpp.

const uint none = 0xFFFFFFFFu;

/// An instance of a draw.
struct Item {
    uint first_triangle;
    uint matrix;    // Among the instanced, or none.
    uint alpha;     // Its alpha test, or none.
    uint uv_shift;  // From a corner's place in the positions to its place in the coordinates; wraps.
    uvec2 groups;
    uint first_index;
    uint first_position;
};

struct AlphaTest {
    uint first_texel;  // A byte.
    int width;
    int height;
    uint wrap_u;
    uint wrap_v;
    float least;  // Of alpha in [0, 255]: what passes.
    uvec2 least_exact;  // The same in double: the low word first.
};
