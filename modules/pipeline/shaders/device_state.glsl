// What the kernels of light lists share: see DeviceStateStd in device_kernels.hpp.
#ifndef PIPELINE_SHADERS_DEVICE_STATE_GLSL
#define PIPELINE_SHADERS_DEVICE_STATE_GLSL

struct DeviceState {
    uint clusters;
    uint usable;
    uint everywhere;
    uint masked;
    uint bad;
    uint background;
    uint invalid;
    uint levels;
    int places[6];
    uint item_slots;
    uint node_slots;
    uint count[12];
    uint first[12];
    uint longest;
};

#endif
