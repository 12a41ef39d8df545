#pragma once
// The test of boxes against a depth pyramid, over lanes of either form. Included inside a namespace that has F8, I8, M8
// and their operations, with GNOMON_LANE_FN for what must be inlined and GNOMON_LANE_BODY for what is called.

#include "box_project.hpp"

#include "box_planes.hpp"

inline constexpr std::uint8_t verdict_outside = 0;
inline constexpr std::uint8_t verdict_hidden = 1;
inline constexpr std::uint8_t verdict_visible = 2;

/// Columns or blocks that are looked at together: their first and last samples, from the rectangle's first.
struct Spans {
    F8 x_low, x_high;
    float y_low, y_high;
};

GNOMON_LANE_FN F8 greatest_of(Line const& line, int box, Spans const& at) {
    float const y = (line.up_y[box] * at.y_high + line.down_y[box] * at.y_low);
    return (all(line.up_x[box]) * at.x_high + all(line.down_x[box]) * at.x_low) + (all(y) + all(line.constant[box]));
}

/// Spans that may hold a sample nearer than `held`.
GNOMON_LANE_FN M8 may_pass(BoxJob const& job, Planes const& p, int box, Spans const& at, F8 held) {
    F8 nearest = all(p.nearest[box]);
    for (Line const& face : p.face) nearest = lesser(greatest_of(face, box, at), nearest);
    F8 inside = greatest_of(p.edge[0], box, at);
    for (int i = 1; i < 6; ++i) inside = lesser(greatest_of(p.edge[i], box, at), inside);
    return is_nearer(job, stored(job, nearest), held) & (all(0.0F) <= inside);
}

/// Eight samples of row y from column x on.
GNOMON_LANE_FN F8 load_samples(BoxJob const& job, std::int32_t x, std::int32_t y) {
    std::ptrdiff_t const at = y * job.stride + x;
    if (x + 8 <= job.width) return job.depth != nullptr ? load(job.depth + at) : load_codes(job.codes + at);
    float held[8] = {};
    for (std::int32_t i = 0; x + i < job.width; ++i)
        held[i] = job.depth != nullptr ? job.depth[at + i] : static_cast<float>(job.codes[at + i]);
    return load(held);
}

/// Whether any of a block's samples may pass.
GNOMON_LANE_BODY bool may_pass_samples(BoxJob const& job, Planes const& p, int box, std::int32_t block_x,
                                       std::int32_t block_y) {
    std::int32_t const x = block_x * 8;
    I8 const columns = lane_numbers() + all(x - p.x0[box]);
    M8 const wanted = without(columns < all(p.x1[box] - p.x0[box] + 1), columns < all(0));
    F8 const at = to_float(columns);
    std::int32_t const first = block_y * 8 > p.y0[box] ? block_y * 8 : p.y0[box];
    std::int32_t const last = block_y * 8 + 7 < p.y1[box] ? block_y * 8 + 7 : p.y1[box];
    for (std::int32_t y = first; y <= last; ++y) {
        float const row = static_cast<float>(y - p.y0[box]);
        M8 const pass = may_pass(job, p, box, {at, at, row, row}, load_samples(job, x, y));
        if (bits_of(pass & wanted) != 0) return true;
    }
    return false;
}

/// Blocks of one level, last ones included.
struct Blocks {
    int level;
    std::int32_t x0, y0, x1, y1;
};

/// Whether any sample of the blocks may pass: eight blocks at a time, those that may by their own parts, three levels
/// down.
GNOMON_LANE_BODY bool may_pass_blocks(BoxJob const& job, Planes const& p, int box, Blocks const& blocks) {
    int const shift = blocks.level + 3;
    std::int32_t const size = 1 << shift;
    BoxJob::Level const& level = job.level[blocks.level];
    for (std::int32_t y = blocks.y0; y <= blocks.y1; ++y) {
        std::int32_t const first = (y << shift) > p.y0[box] ? (y << shift) : p.y0[box];
        std::int32_t const last = (y << shift) + size - 1 < p.y1[box] ? (y << shift) + size - 1 : p.y1[box];
        float const y_low = static_cast<float>(first - p.y0[box]);
        float const y_high = static_cast<float>(last - p.y0[box]);
        for (std::int32_t x = blocks.x0; x <= blocks.x1; x += 8) {
            I8 const start = shifted_up(lane_numbers() + all(x), shift) - all(p.x0[box]);
            I8 const end = lesser(start + all(size - 1), all(p.x1[box] - p.x0[box]));
            Spans const at{to_float(greater(start, all(0))), to_float(end), y_low, y_high};
            M8 const wanted = lane_numbers() < all(blocks.x1 - x + 1);
            M8 const pass = may_pass(job, p, box, at, load(level.farthest + y * level.stride + x));
            for (std::uint32_t left = bits_of(pass & wanted); left != 0; left &= left - 1) {
                std::int32_t const bx = x + __builtin_ctz(left);
                if (blocks.level == 0) {
                    if ((job.depth == nullptr && job.codes == nullptr) || may_pass_samples(job, p, box, bx, y))
                        return true;
                    continue;
                }
                std::int32_t const x_end = p.x1[box] >> (shift - 3);
                std::int32_t const y_end = p.y1[box] >> (shift - 3);
                std::int32_t const x_begin = p.x0[box] >> (shift - 3);
                std::int32_t const y_begin = p.y0[box] >> (shift - 3);
                Blocks const parts{blocks.level - 3, 8 * bx > x_begin ? 8 * bx : x_begin,
                                   8 * y > y_begin ? 8 * y : y_begin, 8 * bx + 7 < x_end ? 8 * bx + 7 : x_end,
                                   8 * y + 7 < y_end ? 8 * y + 7 : y_end};
                if (may_pass_blocks(job, p, box, parts)) return true;
            }
        }
    }
    return false;
}

/// The whole rectangle, from the level on which it is at most eight blocks wide and high.
GNOMON_LANE_FN bool may_be_seen(BoxJob const& job, Planes const& p, int box) {
    Blocks blocks{0, p.x0[box] >> 3, p.y0[box] >> 3, p.x1[box] >> 3, p.y1[box] >> 3};
    while (blocks.x1 - blocks.x0 > 8 || blocks.y1 - blocks.y0 > 8) {
        blocks.level += 3;
        blocks.x0 >>= 3;
        blocks.y0 >>= 3;
        blocks.x1 >>= 3;
        blocks.y1 >>= 3;
    }
    return may_pass_blocks(job, p, box, blocks);
}

/// Boxes that the pyramid over the whole rectangle does not hide, waiting for the closer look.
struct Queue {
    std::size_t box[8];
    int count = 0;
};

GNOMON_LANE_BODY void look_closer(BoxJob const& job, Queue& queue, std::uint8_t* out) {
    if (queue.count == 0) return;
    float const* box[8];
    for (int i = 0; i < 8; ++i) box[i] = job.boxes + 6 * queue.box[i < queue.count ? i : 0];
    F8 element[6];
    load_boxes(box, element);
    Corners c;
    to_clip(job, element, c);
    snap_corners(job, c);
    Planes planes;
    make_planes(job, c, bounds_of(job, c), planes);
    for (int i = 0; i < queue.count; ++i)
        out[queue.box[i]] = may_be_seen(job, planes, i) ? verdict_visible : verdict_hidden;
    queue.count = 0;
}

/// What eight boxes' rectangles say.
struct Rectangles {
    std::int32_t x0[8], y0[8], x1[8], y1[8];
    float nearest[8];  // As the image holds it.
};

/// Whether a rectangle's 2 x 2 or fewer blocks, on the finest level where they are that few, hide all that is not nearer
/// than `nearest`.
GNOMON_LANE_FN bool hides(BoxJob const& job, Rectangles const& r, int i) {
    std::int32_t const x0 = (r.x0[i] > job.x0 ? r.x0[i] : job.x0) >> 3;
    std::int32_t const y0 = (r.y0[i] > job.y0 ? r.y0[i] : job.y0) >> 3;
    std::int32_t const x1 = (r.x1[i] < job.x1 - 1 ? r.x1[i] : job.x1 - 1) >> 3;
    std::int32_t const y1 = (r.y1[i] < job.y1 - 1 ? r.y1[i] : job.y1 - 1) >> 3;
    std::int32_t const wide = x1 - x0 > y1 - y0 ? x1 - x0 : y1 - y0;
    int const k = wide <= 1 ? 0 : 32 - __builtin_clz(static_cast<std::uint32_t>(wide - 1));
    BoxJob::Level const& level = job.level[k];
    float const* const upper = level.farthest + (y0 >> k) * level.stride;
    float const* const lower = level.farthest + (y1 >> k) * level.stride;
    float const z = r.nearest[i];
    float const a = upper[x0 >> k];
    float const b = upper[x1 >> k];
    float const c = lower[x0 >> k];
    float const d = lower[x1 >> k];
    return job.reversed ? !(z > a) & !(z > b) & !(z > c) & !(z > d) : !(z < a) & !(z < b) & !(z < c) & !(z < d);
}

GNOMON_LANE_FN std::uint8_t first_verdict(BoxJob const& job, Rectangles const& r, int i, bool& open) {
    if (r.x0[i] > r.x1[i] || r.y0[i] > r.y1[i]) return verdict_hidden;  // Between the samples.
    if (r.x0[i] >= job.x1 || r.y0[i] >= job.y1 || r.x1[i] < job.x0 || r.y1[i] < job.y0) return verdict_outside;
    open = !hides(job, r, i);
    return open ? verdict_visible : verdict_hidden;
}

GNOMON_LANE_BODY void test_boxes(BoxJob const& job, std::size_t begin, std::size_t end, std::uint8_t* out) {
    Queue queue;
    for (; begin < end; begin += 8) {
        int const count = end - begin < 8 ? static_cast<int>(end - begin) : 8;
        float const* box[8];
        for (int i = 0; i < 8; ++i) box[i] = job.boxes + 6 * (begin + static_cast<std::size_t>(i < count ? i : 0));
        F8 element[6];
        load_boxes(box, element);
        Corners c;
        to_clip(job, element, c);
        Fates const fates = fates_of(job, element, c);
        std::uint32_t const outside = bits_of(fates.outside);
        std::uint32_t const regular = bits_of(without(fates.regular, fates.outside));
        Rectangles r;
        if (regular != 0) {
            snap_corners(job, c);
            Bounds const b = bounds_of(job, c);
            store(r.x0, b.x0);
            store(r.y0, b.y0);
            store(r.x1, b.x1);
            store(r.y1, b.y1);
            store(r.nearest, stored(job, b.nearest + b.range * all(0.126F) + b.rounding));
        }
        for (int i = 0; i < count; ++i) {
            std::size_t const at = begin + static_cast<std::size_t>(i);
            bool open = false;
            out[at] = (outside >> i & 1U) != 0   ? verdict_outside
                      : (regular >> i & 1U) == 0 ? verdict_visible
                                                 : first_verdict(job, r, i, open);
            if (!open) continue;
            queue.box[queue.count++] = at;
            if (queue.count == 8) look_closer(job, queue, out);
        }
    }
    look_closer(job, queue, out);
}
