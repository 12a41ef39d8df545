#include "detail/atrium_parts.hpp"

#include "detail/turn.hpp"

#include <array>
#include <vector>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;

constexpr std::uint32_t column_sides = 40;

/// A half-round moulding from `y_m` up, bulging by half its height.
void add_torus(std::vector<Level>& profile, double radius_m, double y_m, double height_m) {
    constexpr int steps = 4;
    for (int i = 0; i <= steps; ++i) {
        SinCos const a = sin_cos(-0.25 + 0.5 * i / steps);
        profile.push_back({radius_m + 0.5 * height_m * a.cos, y_m + 0.5 * height_m * (1.0 + a.sin)});
    }
}

}  // namespace

Solid column_solid(double height_m, double radius_m) {
    double const r = radius_m;
    Solid out;
    double const block = r * 1.45;
    std::array<Storey, 4> const plinth{
        {{block, block, -0.05}, {block, block, 0.2}, {block * 0.96, block * 0.96, 0.24}, {block * 0.9, block * 0.9, 0.25}}};
    add_stack(out, dvec3(0.0), plinth);
    std::vector<Level> profile{{r * 1.2, 0.2}};
    add_torus(profile, r * 1.18, 0.26, 0.14);
    profile.push_back({r * 1.12, 0.42});
    add_torus(profile, r * 1.06, 0.45, 0.09);
    double const neck = height_m - 0.95;
    for (double const t : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0})  // a shaft that swells a little, then tapers
        profile.push_back({r * (1.0 + 0.06 * t - 0.2 * t * t), 0.57 + (neck - 0.57) * t});
    add_torus(profile, r * 0.9, neck + 0.02, 0.08);
    for (double const t : {0.0, 0.25, 0.5, 0.75, 1.0})
        profile.push_back({r * (0.9 + 0.06 * t + 0.34 * t * t * t), neck + 0.14 + 0.5 * t});
    profile.push_back({r * 1.2, height_m - 0.26});
    add_lathe(out, dvec3(0.0), profile, column_sides);
    std::array<Storey, 5> const abacus{{{block * 0.85, block * 0.85, height_m - 0.28},
                                        {block * 0.98, block * 0.98, height_m - 0.2},
                                        {block * 0.98, block * 0.98, height_m - 0.12},
                                        {block * 1.06, block * 1.06, height_m - 0.08},
                                        {block * 1.06, block * 1.06, height_m}}};
    add_stack(out, dvec3(0.0), abacus);
    return out;
}

Solid pier_solid(double height_m) {
    Solid out;
    std::array<Storey, 11> const storeys{{{0.62, 0.62, -0.05},
                                          {0.62, 0.62, 0.4},
                                          {0.54, 0.54, 0.5},
                                          {0.5, 0.5, 0.52},
                                          {0.5, 0.5, height_m * 0.35},
                                          {0.5, 0.5, height_m * 0.7},
                                          {0.5, 0.5, height_m - 0.5},
                                          {0.56, 0.56, height_m - 0.45},
                                          {0.56, 0.56, height_m - 0.25},
                                          {0.62, 0.62, height_m - 0.2},
                                          {0.62, 0.62, height_m}}};
    add_stack(out, dvec3(0.0), storeys);
    return out;
}

Solid spandrel_solid(double inner_m, double top_m) {
    Solid out;
    add_spandrel(out, {dvec3(0.0), inner_m, inner_m + 0.3, 0.6, 32}, bay_m * 0.5, top_m);
    return out;
}

Solid archivolt_solid(double inner_m) {
    Solid out;
    add_arch(out, {dvec3(0.0), inner_m - 0.04, inner_m + 0.12, 0.68, 28});
    add_arch(out, {dvec3(0.0), inner_m + 0.1, inner_m + 0.3, 0.78, 28});
    std::array<Storey, 3> const keystone{
        {{0.13, 0.43, inner_m - 0.1}, {0.2, 0.43, inner_m + 0.36}, {0.23, 0.46, inner_m + 0.45}}};
    add_stack(out, dvec3(0.0), keystone);
    return out;
}

Solid baluster_solid(double height_m) {
    double const h = height_m;
    std::array<Level, 12> const profile{{{0.07, -0.02}, {0.07, 0.08 * h}, {0.04, 0.12 * h}, {0.05, 0.18 * h}, {0.085, 0.3 * h},
                                         {0.075, 0.42 * h}, {0.045, 0.6 * h}, {0.035, 0.75 * h}, {0.055, 0.8 * h},
                                         {0.035, 0.84 * h}, {0.07, 0.9 * h}, {0.07, h + 0.02}}};
    Solid out;
    add_lathe(out, dvec3(0.0), profile, 16);
    return out;
}

Solid lantern_solid(double chain_m) {
    Solid out;
    std::array<dvec3, 2> const chain{{{0.0, 0.1, 0.0}, {0.0, -chain_m, 0.0}}};
    std::array<double, 2> const thin{0.015, 0.015};
    add_tube(out, chain, thin, 6);
    std::array<Level, 11> const body{{{0.0, -0.72}, {0.05, -0.7}, {0.06, -0.64}, {0.14, -0.6}, {0.17, -0.56}, {0.22, -0.16},
                                      {0.26, -0.12}, {0.2, -0.06}, {0.1, -0.01}, {0.04, 0.02}, {0.0, 0.06}}};
    add_lathe(out, dvec3(0.0, -chain_m, 0.0), body, 14);
    return out;
}

Solid urn_solid() {
    Solid out;
    std::array<Storey, 6> const pedestal{
        {{0.4, 0.4, -0.05}, {0.4, 0.4, 0.2}, {0.32, 0.32, 0.26}, {0.32, 0.32, 0.9}, {0.38, 0.38, 0.96}, {0.38, 0.38, 1.05}}};
    add_stack(out, dvec3(0.0), pedestal);
    std::vector<Level> profile{{0.2, 1.0}, {0.2, 1.1}, {0.1, 1.16}, {0.08, 1.24}};
    for (int i = 0; i <= 8; ++i) {
        SinCos const a = sin_cos(-0.22 + 0.36 * i / 8);
        profile.push_back({0.12 + 0.24 * a.cos, 1.58 + 0.32 * a.sin});
    }
    for (Level const level : {Level{0.24, 1.93}, {0.36, 2.0}, {0.38, 2.04}, {0.34, 2.05}, {0.2, 1.9}, {0.0, 1.86}})
        profile.push_back(level);
    add_lathe(out, dvec3(0.0), profile, 32);
    return out;
}

Solid fountain_solid() {
    Solid out;
    std::array<Level, 12> const pool{{{2.3, -0.05}, {2.3, 0.1}, {2.2, 0.14}, {2.12, 0.2}, {2.12, 0.5}, {2.24, 0.56},
                                      {2.26, 0.64}, {2.2, 0.68}, {2.0, 0.68}, {1.94, 0.62}, {1.94, 0.35}, {0.0, 0.34}}};
    add_lathe(out, dvec3(0.0), pool, 56);
    std::array<Level, 14> const basin{{{0.5, 0.3}, {0.46, 0.5}, {0.3, 0.62}, {0.22, 0.8}, {0.2, 1.1}, {0.28, 1.25}, {0.7, 1.4},
                                       {1.1, 1.62}, {1.2, 1.74}, {1.2, 1.8}, {1.12, 1.81}, {0.98, 1.68}, {0.5, 1.58}, {0.0, 1.56}}};
    add_lathe(out, dvec3(0.0), basin, 48);
    std::array<Level, 14> const top{{{0.22, 1.5}, {0.18, 1.66}, {0.1, 1.8}, {0.09, 2.1}, {0.14, 2.2}, {0.38, 2.32}, {0.56, 2.5},
                                     {0.58, 2.56}, {0.52, 2.57}, {0.36, 2.44}, {0.14, 2.42}, {0.1, 2.6}, {0.13, 2.7}, {0.0, 2.84}}};
    add_lathe(out, dvec3(0.0), top, 36);
    return out;
}

Solid portal_stone_solid() {
    Solid out;
    for (double const x : {-1.12, 1.12}) {
        std::array<Storey, 7> const jamb{{{0.24, 0.2, -0.05}, {0.24, 0.2, 0.35}, {0.18, 0.14, 0.42}, {0.18, 0.14, 1.5},
                                          {0.18, 0.14, 2.55}, {0.24, 0.2, 2.62}, {0.24, 0.2, 2.8}}};
        add_stack(out, {x, 0.0, 0.0}, jamb);
    }
    add_arch(out, {{0.0, 2.75, 0.0}, 0.92, 1.3, 0.3, 16});
    add_arch(out, {{0.0, 2.75, 0.0}, 1.22, 1.42, 0.42, 16});
    std::array<Storey, 2> const key{{{0.12, 0.24, 3.6}, {0.2, 0.26, 4.28}}};
    add_stack(out, dvec3(0.0), key);
    return out;
}

Solid portal_door_solid() {
    Solid out;
    for (double const side : {-1.0, 1.0}) {
        add_box(out, {side < 0.0 ? -1.0 : 0.012, -0.02, -0.1}, {side < 0.0 ? -0.012 : 1.0, 2.8, 0.05});
        for (double const y : {0.25, 1.1, 1.95}) {
            std::array<Storey, 3> const panel{{{0.32, 0.07, y}, {0.32, 0.07, y + 0.62}, {0.28, 0.05, y + 0.66}}};
            add_stack(out, {side * 0.5, 0.0, 0.02}, panel);
        }
        std::array<Level, 4> const knob{{{0.0, 1.28}, {0.035, 1.3}, {0.035, 1.34}, {0.0, 1.36}}};
        add_lathe(out, {side * 0.1, 0.0, 0.09}, knob, 8);
    }
    Ring front;
    Ring back;
    for (int i = 0; i <= 10; ++i) {
        SinCos const a = sin_cos(0.5 * i / 10);
        front.push_back({1.0 * a.cos, 2.78 + 1.0 * a.sin, 0.03});
        back.push_back({1.0 * a.cos, 2.78 + 1.0 * a.sin, -0.1});
    }
    std::array<Ring, 2> const light{back, front};
    add_loft(out, light);
    return out;
}

Solid curtain_solid(double drop_m) {
    constexpr int steps = 44;
    constexpr double width_m = 3.2;
    std::vector<Ring> rings;
    for (int i = 0; i <= steps; ++i) {
        double const t = static_cast<double>(i) / steps;
        double const fold = sin_cos(7.0 * t).sin + 0.35 * sin_cos(3.0 * t + 0.2).sin;
        double const x = width_m * (t - 0.5);
        double const hem = 0.12 * sin_cos(2.0 * t).cos;
        dvec3 const top(x, 0.0, 0.04 * fold);
        dvec3 const middle(x * 0.97, -0.5 * drop_m, 0.1 * fold);
        dvec3 const low(x * 0.92, -drop_m + hem, 0.14 * fold);
        dvec3 const half(0.0, 0.0, 0.012);
        rings.push_back({low - half, middle - half, top - half, top + half, middle + half, low + half});
    }
    Solid out;
    add_loft(out, rings);
    return out;
}

Solid tiles_solid(bool even) {
    Solid out;
    for (int i = 0; i < 25; ++i) {
        if ((i % 2 == 0) != even) continue;
        std::array<Storey, 3> const tile{{{0.495, 0.495, -0.1}, {0.495, 0.495, 0.02}, {0.48, 0.48, 0.03}}};
        add_stack(out, {i % 5 - 2.0, 0.0, i / 5 - 2.0}, tile);
    }
    return out;
}

Solid bench_solid() {
    Solid out;
    std::array<Storey, 4> const seat{{{0.9, 0.25, 0.42}, {0.95, 0.28, 0.45}, {0.95, 0.28, 0.5}, {0.92, 0.25, 0.53}}};
    add_stack(out, dvec3(0.0), seat);
    std::array<Storey, 5> const leg{{{0.12, 0.22, -0.05}, {0.12, 0.22, 0.1}, {0.08, 0.17, 0.15}, {0.08, 0.17, 0.35}, {0.12, 0.22, 0.44}}};
    for (double const x : {-0.65, 0.65}) add_stack(out, {x, 0.0, 0.0}, leg);
    return out;
}

Solid tub_solid() {
    Solid out;
    std::array<Level, 9> const profile{
        {{0.62, -0.05}, {0.62, 0.06}, {0.56, 0.1}, {0.68, 0.5}, {0.76, 0.54}, {0.76, 0.62}, {0.7, 0.64}, {0.66, 0.56}, {0.0, 0.54}}};
    add_lathe(out, dvec3(0.0), profile, 32);
    return out;
}

}  // namespace gnomon::scene::detail
