#pragma once
// Figures that the papers print, to stand beside ours.

#include <array>
#include <string_view>

namespace gnomon::command::papers {

/// Frame times over an animation, ms.
struct FrameTimes {
    std::string_view technique;  ///< Ours of the same kind.
    std::string_view gbuffer;    ///< "" for forward shading.
    double mean = 0.0;
    double min = 0.0;
    double max = 0.0;
};

/// [Olsson 2014, Paper I, table 2]: 924 static lights, GTX 480, 1920x1080.
inline constexpr std::array<FrameTimes, 8> many_lights{{{"tiled-deferred", "f16", 7.87, 4.19, 15.9},
                                                        {"tiled-deferred", "f32", 10.4, 6.91, 18.2},
                                                        {"tiled-forward", "", 43.0, 11.0, 107.0},
                                                        {"tiled-forward-prez", "", 30.1, 9.31, 72.4},
                                                        {"deferred", "f16", 26.8, 9.36, 64.3},
                                                        {"deferred", "f32", 51.3, 18.2, 121.0},
                                                        {"deferred-stencil", "f16", 12.2, 4.98, 26.6},
                                                        {"deferred-stencil", "f32", 20.2, 9.55, 43.8}}};

/// [Olsson 2014, Paper I, table 3]: 11 moving lights, the same card and size.
inline constexpr std::array<FrameTimes, 8> few_lights{{{"tiled-deferred", "f16", 3.34, 2.36, 4.48},
                                                       {"tiled-deferred", "f32", 6.34, 4.68, 8.98},
                                                       {"tiled-forward", "", 4.03, 1.39, 9.95},
                                                       {"tiled-forward-prez", "", 4.56, 3.22, 9.82},
                                                       {"deferred", "f16", 4.17, 2.12, 7.41},
                                                       {"deferred", "f32", 9.36, 5.29, 15.5},
                                                       {"deferred-stencil", "f16", 3.65, 1.65, 5.81},
                                                       {"deferred-stencil", "f32", 8.05, 4.07, 12.4}}};

/// [Olsson 2014, Paper II, table 2]: light assignment on a GTX 480, ms.
struct Assignment {
    int lights = 0;
    double clustered_ms = 0.0;
    double tiled_ms = 0.0;
};
inline constexpr std::array<Assignment, 4> assignment{
    {{32, 0.71, 0.24}, {1024, 0.73, 0.51}, {32768, 1.42, 9.31}, {1048576, 5.73, 341.56}}};

}  // namespace gnomon::command::papers
