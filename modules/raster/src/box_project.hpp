#pragma once
// Eight boxes at once: their corners in the image, and what the corners alone decide. Part of box_core.hpp.

/// Corners of eight boxes, in the order of `math::corner`, as the rasterizer has them.
struct Corners {
    F8 clip[4][8];
    I8 x[8], y[8];  // Snapped.
    F8 z[8];        // Depth.
};

/// Lanes by what can be said of them at once.
struct Fates {
    M8 regular;  // All corners are inside all planes: nothing is clipped.
    M8 outside;  // Of one plane, or a side of the view.
};

GNOMON_LANE_FN void to_clip(BoxJob const& job, F8 const (&element)[6], Corners& c) {
    F8 p[3][2];
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) p[axis][side] = element[axis + 3 * side] - all(job.origin[axis]);
    for (int r = 0; r < 4; ++r) {
        F8 part[3][2];
        for (int axis = 0; axis < 3; ++axis)
            for (int side = 0; side < 2; ++side) part[axis][side] = all(job.row[r][axis]) * p[axis][side];
        for (int i = 0; i < 8; ++i)
            c.clip[r][i] = ((part[0][i & 1] + part[1][(i >> 1) & 1]) + part[2][i >> 2]) + all(job.row[r][3]);
    }
}

/// Lanes all of whose corners lie beyond the line sign * (px - limit) > 0.
///
/// L = sign (x half + w (half - limit)) is linear in clip space, so what holds with a margin for the corners holds for
/// all that clipping can leave of the box: cutting works in double and rounds to float once, within 2^-22 of S, the
/// greatest size of a corner's terms; the margin is 2^-18 S.
GNOMON_LANE_FN M8 beyond(F8 const (&x)[8], F8 const (&w)[8], float half, float limit, float sign) {
    F8 least = all(3.0e38F);
    F8 size = all(0.0F);
    for (int i = 0; i < 8; ++i) {
        F8 const a = x[i] * all(half);
        F8 const b = w[i] * all(half - limit);
        least = lesser(all(sign) * (a + b), least);
        size = greater(magnitude(a) + magnitude(w[i]) * all(half + (limit < 0.0F ? -limit : limit)), size);
    }
    return size * all(0x1p-18F) < least;
}

/// Lanes that no side of the view, loosely, has outside.
GNOMON_LANE_FN M8 beyond_a_side(BoxJob const& job, Corners const& c) {
    float const left = static_cast<float>(job.x0) - static_cast<float>(job.offset_x) / 256.0F;
    float const right = static_cast<float>(job.x1) - static_cast<float>(job.offset_x) / 256.0F;
    float const top = static_cast<float>(job.y0) - static_cast<float>(job.offset_y) / 256.0F;
    float const bottom = static_cast<float>(job.y1) - static_cast<float>(job.offset_y) / 256.0F;
    return beyond(c.clip[0], c.clip[3], job.half_width, left, -1.0F) |
           beyond(c.clip[0], c.clip[3], job.half_width, right, 1.0F) |
           beyond(c.clip[1], c.clip[3], job.half_height, top, -1.0F) |
           beyond(c.clip[1], c.clip[3], job.half_height, bottom, 1.0F);
}

/// The outcodes of the rasterizer, over all corners.
GNOMON_LANE_FN Fates fates_of(BoxJob const& job, F8 const (&element)[6], Corners const& c) {
    F8 const limit = all(max_clip_coordinate);
    F8 const zero = all(0.0F);
    M8 const box = (element[0] <= element[3]) & (element[1] <= element[4]) & (element[2] <= element[5]);
    M8 usable = box;
    M8 inside = box;
    M8 low_w = box;
    M8 low_z = box;
    M8 high_z = box;
    for (int i = 0; i < 8; ++i) {
        F8 const& w = c.clip[3][i];
        for (int r = 0; r < 4; ++r) usable = usable & (magnitude(c.clip[r][i]) <= limit);
        low_w = low_w & (w < all(min_w));
        inside = inside & (all(min_w) <= w) & (magnitude(c.clip[0][i]) <= all(job.guard_x) * w) &
                 (magnitude(c.clip[1][i]) <= all(job.guard_y) * w);
        low_z = low_z & (c.clip[2][i] < zero);
        high_z = high_z & (w < c.clip[2][i]);
        if (job.clip_depth) inside = inside & (zero <= c.clip[2][i]) & (c.clip[2][i] <= w);
    }
    M8 const none = without(box, box);
    M8 outside = low_w | (job.clip_depth ? low_z | high_z : none);
    M8 const regular = usable & inside;
    M8 const open = without(usable, regular | outside);
    if (bits_of(open) != 0) outside = outside | (open & beyond_a_side(job, c));
    // Empty boxes and NaN hold nothing; a box of infinite size is left to those who can see it.
    M8 const every = zero <= zero;
    return {regular, (outside & usable) | without(every, box)};
}

/// The snapped corners; lanes that are not regular get numbers without meaning.
GNOMON_LANE_FN void snap_corners(BoxJob const& job, Corners& c) {
    F8 const half_x = all(job.half_width);
    F8 const half_y = all(job.half_height);
    for (int i = 0; i < 8; ++i) {
        F8 const r = all(1.0F) / c.clip[3][i];
        F8 const px = (c.clip[0][i] * r) * half_x + half_x;
        F8 const py = (c.clip[1][i] * r) * half_y + half_y;
        c.z[i] = c.clip[2][i] * r;
        if (job.clip_depth) c.z[i] = lesser(greater(c.z[i], all(0.0F)), all(1.0F));
        c.x[i] = to_nearest(px * all(256.0F)) + all(job.offset_x);
        c.y[i] = to_nearest(py * all(256.0F)) + all(job.offset_y);
    }
}

/// Pixels that the corners' rectangle covers, first and last; and depths that no sample is nearer than.
struct Bounds {
    I8 x0, y0, x1, y1;
    F8 nearest;    // In nearness: reversed depth, or depth times -1.
    F8 range;      // Of the corners' depths.
    F8 rounding;   // Of a sample's depth.
};

/// Eight or so lanes of "greater is nearer".
GNOMON_LANE_FN F8 nearness(BoxJob const& job, F8 z) { return job.reversed ? z : all(0.0F) - z; }

/// A triangle's samples lie at most 1/8 of its depths' range beyond the range (`depth_at`), and a sample's depth errs by
///
///     4e (exact - z0) + 2e max(|z0|, |exact|) + e max |z'| + 2^-26 range < 16e max |z|,  e = 2^-24, range <= 2 max |z|
GNOMON_LANE_FN Bounds bounds_of(BoxJob const& job, Corners const& c) {
    Bounds b{c.x[0], c.y[0], c.x[0], c.y[0], nearness(job, c.z[0]), all(0.0F), magnitude(c.z[0])};
    F8 farthest = b.nearest;
    for (int i = 1; i < 8; ++i) {
        F8 const n = nearness(job, c.z[i]);
        b.x0 = lesser(b.x0, c.x[i]);
        b.y0 = lesser(b.y0, c.y[i]);
        b.x1 = greater(b.x1, c.x[i]);
        b.y1 = greater(b.y1, c.y[i]);
        b.nearest = greater(b.nearest, n);
        farthest = lesser(farthest, n);
        b.rounding = greater(b.rounding, magnitude(n));
    }
    b.range = b.nearest - farthest;
    b.rounding = b.rounding * all(0x1p-19F) + all(1e-37F);
    b.x0 = shifted_down(b.x0 + all(127), fraction_bits);
    b.y0 = shifted_down(b.y0 + all(127), fraction_bits);
    b.x1 = shifted_down(b.x1 - all(129), fraction_bits);
    b.y1 = shifted_down(b.y1 - all(129), fraction_bits);
    return b;
}

/// As a target holds it: clamped, and a code for a 16-bit one. Monotone, so it keeps bounds.
GNOMON_LANE_FN F8 stored(BoxJob const& job, F8 nearer) {
    F8 z = lesser(greater(nearness(job, nearer), all(0.0F)), all(1.0F));
    if (job.quantize) z = (z * all(65535.0F) + all(8388608.0F)) - all(8388608.0F);
    return z;
}

GNOMON_LANE_FN M8 is_nearer(BoxJob const& job, F8 z, F8 held) { return job.reversed ? held < z : z < held; }
