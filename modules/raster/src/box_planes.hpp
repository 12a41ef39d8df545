#pragma once
// Eight boxes' outlines and faces, as bounds that hold whatever rounding does. Part of box_core.hpp.

/// Bounds over a box's samples, in pixels from its rectangle's first sample; arrays of eight lanes. A line is kept as the
/// positive and the negative part of its slopes, so that its greatest value over a rectangle takes no branch.
struct Line {
    float up_x[8], down_x[8], up_y[8], down_y[8], constant[8];
};
struct Planes {
    Line edge[6];         // No sample is where one of them is negative.
    Line face[3];         // Nor nearer than any of them.
    float nearest[8];     // Nor than this.
    std::int32_t x0[8], y0[8], x1[8], y1[8];  // Pixels of the rectangle within the view, last ones included.
};

/// Corners in pixels from the rectangle's first sample; exact.
struct Local {
    F8 x[8], y[8], n[8];
    F8 size_x, size_y;  // No coordinate is greater, of corners and of samples.
};

GNOMON_LANE_FN void store_line(Line& line, F8 a, F8 b, F8 constant) {
    F8 const zero = all(0.0F);
    store(line.up_x, greater(a, zero));
    store(line.down_x, lesser(a, zero));
    store(line.up_y, greater(b, zero));
    store(line.down_y, lesser(b, zero));
    store(line.constant, constant);
}

/// The least c with a x_i + b y_i + c >= height_i at all corners, and what rounding may take from the line anywhere:
/// products and sums of here and of the evaluation, each within e = 2^-24, are below 2^-20 (|a| X + |b| Y) and
/// 2^-21 |height|, twice over; the heights' part is in `rounding_of` of the depths.
GNOMON_LANE_FN F8 supporting(Local const& p, F8 a, F8 b, bool with_height) {
    F8 c = all(-3.0e38F);
    for (int i = 0; i < 8; ++i) {
        F8 const at = a * p.x[i] + b * p.y[i];
        c = greater(with_height ? p.n[i] - at : all(0.0F) - at, c);
    }
    return c + (magnitude(a) * p.size_x + magnitude(b) * p.size_y) * all(0x1p-19F);
}

/// How far one triangle's samples may be nearer than the corners' own convex hull, for that snapping moves its depths
/// along its plane: by slope / 512 px, slope |dz/dx| + |dz/dy| of the plane before snapping, and at most 9/8 of its
/// depths' range.
///
/// Snapping moves a corner by at most d = 1/512 px on either axis, and with it the edges e1, e2 by 2d. With G the slopes
/// before and Q after, (Q - G) . e_k <= 2d |G|, so |Q - G| <= 2d |G| (|e1| + |e2|) / area = k |G|: where k <= 1/2, |G| is at
/// most 2 |Q|. Otherwise the triangle is thin, and only its range counts.
GNOMON_LANE_FN F8 lift_of(Local const& p, int i, int j, int k) {
    F8 const x1 = p.x[j] - p.x[i];
    F8 const y1 = p.y[j] - p.y[i];
    F8 const n1 = p.n[j] - p.n[i];
    F8 const x2 = p.x[k] - p.x[i];
    F8 const y2 = p.y[k] - p.y[i];
    F8 const n2 = p.n[k] - p.n[i];
    F8 const length1 = magnitude(x1) + magnitude(y1);
    F8 const length2 = magnitude(x2) + magnitude(y2);
    F8 const products = magnitude(x1 * y2) + magnitude(y1 * x2);
    F8 const area = magnitude(x1 * y2 - y1 * x2) - products * all(0x1p-22F);
    F8 const rounding = (magnitude(n1) * length2 + magnitude(n2) * length1) * all(0x1p-22F);
    F8 const slopes = magnitude(n1 * y2 - n2 * y1) + magnitude(n2 * x1 - n1 * x2) + rounding;
    F8 const low = lesser(lesser(n1, n2), all(0.0F));
    F8 const high = greater(greater(n1, n2), all(0.0F));
    F8 const most = (high - low) * all(1.13F);
    M8 const thin = area < (length1 + length2) * all(0x1p-7F) + all(1e-30F);
    F8 const lift = choose(thin, most, lesser(slopes / area * all(0x1.01p-8F), most));
    // Two corners in one place cover nothing.
    F8 const between = magnitude(x2 - x1) + magnitude(y2 - y1);
    return choose(lesser(lesser(length1, length2), between) <= all(0.0F), all(0.0F), lift);
}

/// Corner numbers of a face: bit `axis` is `side`, the others run.
constexpr int face_corner(int axis, int side, int k) {
    int const u = (axis + 1) % 3;
    int const v = (axis + 2) % 3;
    return side << axis | (k & 1) << u | (k >> 1) << v;
}

/// The greatest lift of all twelve triangles, which are those of `box_indices`.
GNOMON_LANE_FN F8 greatest_lift(Local const& p) {
    F8 lift = all(0.0F);
    for (int f = 0; f < 6; ++f) {
        int const c0 = face_corner(f / 2, f & 1, 0);
        int const c1 = face_corner(f / 2, f & 1, 1);
        int const c2 = face_corner(f / 2, f & 1, 2);
        int const c3 = face_corner(f / 2, f & 1, 3);
        lift = greater(lift, greater(lift_of(p, c0, c1, c3), lift_of(p, c3, c2, c0)));
    }
    return lift;
}

/// The plane along the nearer of an axis's two faces, moved in front of all corners.
GNOMON_LANE_FN void store_face(Local const& p, int axis, F8 slack, Line& line) {
    F8 sum[2] = {all(0.0F), all(0.0F)};
    for (int side = 0; side < 2; ++side)
        for (int k = 0; k < 4; ++k) sum[side] = sum[side] + p.n[face_corner(axis, side, k)];
    M8 const high = sum[0] < sum[1];
    F8 x[4];
    F8 y[4];
    F8 n[4];
    for (int k = 0; k < 4; ++k) {
        int const a = face_corner(axis, 0, k);
        int const b = face_corner(axis, 1, k);
        x[k] = choose(high, p.x[b], p.x[a]);
        y[k] = choose(high, p.y[b], p.y[a]);
        n[k] = choose(high, p.n[b], p.n[a]);
    }
    // Along the two diagonals. Any slopes are legal: only how tight the plane is depends on them.
    F8 const x1 = x[3] - x[0];
    F8 const y1 = y[3] - y[0];
    F8 const n1 = n[3] - n[0];
    F8 const x2 = x[2] - x[1];
    F8 const y2 = y[2] - y[1];
    F8 const n2 = n[2] - n[1];
    F8 const area = x1 * y2 - y1 * x2;
    M8 const flat = magnitude(area) < all(0x1p-10F);
    F8 const a = choose(flat, all(0.0F), (n1 * y2 - n2 * y1) / area);
    F8 const b = choose(flat, all(0.0F), (n2 * x1 - n1 * x2) / area);
    store_line(line, a, b, supporting(p, a, b, true) + slack);
}

/// The two outermost of an axis's four edges, as half-planes that hold all corners.
GNOMON_LANE_FN void store_edges(Local const& p, int axis, Line& first, Line& last) {
    F8 dx[4];
    F8 dy[4];
    F8 mean_x = all(0.0F);
    F8 mean_y = all(0.0F);
    for (int k = 0; k < 4; ++k) {
        int const a = face_corner(axis, 0, k);
        int const b = face_corner(axis, 1, k);
        dx[k] = p.x[b] - p.x[a];
        dy[k] = p.y[b] - p.y[a];
        mean_x = mean_x + dx[k];
        mean_y = mean_y + dy[k];
    }
    F8 low = all(3.0e38F);
    F8 high = all(-3.0e38F);
    F8 low_x = all(0.0F);
    F8 low_y = all(0.0F);
    F8 high_x = all(0.0F);
    F8 high_y = all(0.0F);
    for (int k = 0; k < 4; ++k) {
        int const a = face_corner(axis, 0, k);
        int const b = face_corner(axis, 1, k);
        F8 const across = mean_x * (p.y[a] + p.y[b]) - mean_y * (p.x[a] + p.x[b]);
        M8 const lower = across < low;
        M8 const higher = high < across;
        low = choose(lower, across, low);
        low_x = choose(lower, dx[k], low_x);
        low_y = choose(lower, dy[k], low_y);
        high = choose(higher, across, high);
        high_x = choose(higher, dx[k], high_x);
        high_y = choose(higher, dy[k], high_y);
    }
    F8 const zero = all(0.0F);
    store_line(first, zero - low_y, low_x, supporting(p, zero - low_y, low_x, false));
    store_line(last, high_y, zero - high_x, supporting(p, high_y, zero - high_x, false));
}

GNOMON_LANE_FN void make_planes(BoxJob const& job, Corners const& c, Bounds const& b, Planes& planes) {
    I8 const x0 = greater(b.x0, all(job.x0));
    I8 const y0 = greater(b.y0, all(job.y0));
    I8 const x1 = lesser(b.x1, all(job.x1 - 1));
    I8 const y1 = lesser(b.y1, all(job.y1 - 1));
    store(planes.x0, x0);
    store(planes.y0, y0);
    store(planes.x1, x1);
    store(planes.y1, y1);
    Local p;
    p.size_x = to_float(x1 - x0);
    p.size_y = to_float(y1 - y0);
    I8 const from_x = shifted_up(x0, fraction_bits) + all(half_pixel);
    I8 const from_y = shifted_up(y0, fraction_bits) + all(half_pixel);
    for (int i = 0; i < 8; ++i) {
        p.x[i] = to_float(c.x[i] - from_x) * all(1.0F / 256.0F);
        p.y[i] = to_float(c.y[i] - from_y) * all(1.0F / 256.0F);
        p.n[i] = nearness(job, c.z[i]);
        p.size_x = greater(magnitude(p.x[i]), p.size_x);
        p.size_y = greater(magnitude(p.y[i]), p.size_y);
    }
    F8 const lift = greatest_lift(p);
    F8 const slack = lift + b.rounding;
    store(planes.nearest, b.nearest + lesser(lift, b.range * all(0.126F)) + b.rounding);
    for (int axis = 0; axis < 3; ++axis) {
        store_face(p, axis, slack, planes.face[axis]);
        store_edges(p, axis, planes.edge[2 * axis], planes.edge[2 * axis + 1]);
    }
}
