// The item of an invocation of a kernel, for its GLSL half.
#ifndef GNOMON_BACKEND_ITEM_GLSL
#define GNOMON_BACKEND_ITEM_GLSL

//     #version 450
//     #extension GL_GOOGLE_include_directive : require
//     #include "gnomon/backend/item.glsl"
//     layout(local_size_x = 64) in;
//     void main() {
//         uint item = GNOMON_ITEM;
//         if (item >= constants.count) return;
//
// gl_GlobalInvocationID.x alone is the item only up to what the device takes in one row: 65535 groups, 4,194,240 items,
// is all that Vulkan promises. A kernel that reads this macro is run on a grid beyond that; others are refused there.

#define GNOMON_ITEM (gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x))

#endif
