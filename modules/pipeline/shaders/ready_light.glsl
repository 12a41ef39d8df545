// Lights ready for rows, as ready_lights leaves them for assign_lights: 68 words each, the members of GnReadySpot in their
// order, then what it is. The C++ halves have a layout of their own in as many words.
#ifndef PIPELINE_SHADERS_READY_LIGHT_GLSL
#define PIPELINE_SHADERS_READY_LIGHT_GLSL

#include <gnomon/lights/formula/assign.glsl>

const uint ready_words = 68u;
const uint ready_kind = 67u;  // 0: takes no part, or is everywhere; 1: a ball; 2: a spot

#endif
