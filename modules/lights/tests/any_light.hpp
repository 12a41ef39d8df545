#pragma once
// Lights of every kind, sound and not, near a cluster of a grid.

#include "../../cull/tests/hard_pairs.hpp"

#include <gnomon/cull/rows.hpp>
#include <gnomon/lights/light.hpp>

namespace gnomon::test {

inline lights::Light make_any_light(Draw& draw, HardGrid const& hard, cull::RowGrid const& grid) {
    Cell const cell{draw.below(grid.columns), draw.below(grid.rows), draw.below(grid.slices)};
    HardLight const l = make_hard_light(draw, hard, cell);
    unsigned const kind = draw.below(16);
    lights::Light light = lights::make_point(l.center, l.range);
    if (kind == 0) light = lights::make_directional();
    if (kind == 1) light = lights::make_box(l.center, l.half[0], l.half[1], l.half[2]);
    if (kind == 2) light = lights::make_spot(l.center, l.range, l.axis, 2.0F);
    if (kind == 3) light.range_m = -1.0F;
    if (kind > 8) {
        light.kind = lights::Kind::spot;
        light.axis = l.axis;
        light.cos_half = l.cosine;
        light.sin_half = l.sine;
    }
    light.layers = draw.below(9) == 0 ? 2U : 5U;
    return light;
}

}  // namespace gnomon::test
