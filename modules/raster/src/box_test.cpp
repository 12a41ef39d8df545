#include <gnomon/raster/box_test.hpp>

#include <gnomon/raster/triangle.hpp>

#include "box_job.hpp"
#include "box_lanes_scalar.hpp"

#include <algorithm>
#include <cstring>

namespace gnomon::raster {

namespace detail {

namespace scalar_lanes {

namespace {

#define GNOMON_LANE_FN inline
#define GNOMON_LANE_BODY
#include "box_core.hpp"

}  // namespace

}  // namespace scalar_lanes

void scalar_test_boxes(BoxJob const& job, std::size_t begin, std::size_t end, std::uint8_t* out) {
    scalar_lanes::test_boxes(job, begin, end, out);
}

}  // namespace detail

namespace {

using detail::BoxJob;

constexpr std::size_t box_grain = 1024;

static_assert(sizeof(math::Aabb) == 6 * sizeof(float));
static_assert(static_cast<std::uint8_t>(BoxVerdict::outside) == detail::scalar_lanes::verdict_outside);
static_assert(static_cast<std::uint8_t>(BoxVerdict::hidden) == detail::scalar_lanes::verdict_hidden);
static_assert(static_cast<std::uint8_t>(BoxVerdict::visible) == detail::scalar_lanes::verdict_visible);

void set_view(BoxJob& job, Layer const& layer, Rect const& viewport) {
    bool const clips = layer.config.range == DepthRange::clip;
    ViewportTransform const v = make_viewport(viewport, clips);
    for (math::axis_t row = 0; row < 4; ++row)
        for (math::axis_t column = 0; column < 4; ++column)
            job.row[row][column] = layer.clip_from_relative[column][row];
    for (math::axis_t axis = 0; axis < 3; ++axis) job.origin[axis] = layer.origin[axis];
    job.half_width = v.half_width_px;
    job.half_height = v.half_height_px;
    job.offset_x = v.offset_x;
    job.offset_y = v.offset_y;
    job.guard_x = v.guard_x;
    job.guard_y = v.guard_y;
    job.clip_depth = clips;
}

void set_image(BoxJob& job, Layer const& layer, DepthPyramid const& pyramid) {
    job.reversed = pyramid.depth() == math::Depth::reversed;
    job.quantize = pyramid.is_unorm16();
    job.levels = pyramid.level_count();
    for (int level = 0; level < job.levels; ++level) {
        ImageView<float const> const farthest = pyramid.farthest(level);
        job.level[level] = {farthest.data, farthest.stride};
    }
    job.width = pyramid.width_px();
    if (job.quantize) {
        job.codes = layer.target.unorm16().data;
        job.stride = layer.target.unorm16().stride;
    } else {
        job.depth = layer.target.f32().data;
        job.stride = layer.target.f32().stride;
    }
}

/// returns: false where no pixel can be seen.
bool set_scissor(BoxJob& job, Layer const& layer, Rect const& whole) {
    Rect const s = layer.config.scissor.value_or(whole);
    auto const end = [](std::int32_t at, std::int32_t size, std::int32_t limit) {
        return static_cast<std::int32_t>(std::min<std::int64_t>(std::int64_t{at} + std::max(size, 0), limit));
    };
    job.x0 = std::max(s.x, 0);
    job.y0 = std::max(s.y, 0);
    job.x1 = end(s.x, s.width, whole.width);
    job.y1 = end(s.y, s.height, whole.height);
    return job.x0 < job.x1 && job.y0 < job.y1;
}

}  // namespace

void test_boxes(std::span<math::Aabb const> boxes, Layer const& layer, DepthPyramid const& pyramid,
                std::span<BoxVerdict> out, core::ExecutorRef executor) {
    GNOMON_EXPECT(out.size() == boxes.size());
    GNOMON_EXPECT(layer.config.depth == pyramid.depth());
    GNOMON_EXPECT(layer.target.is_unorm16() == pyramid.is_unorm16());
    GNOMON_EXPECT(layer.target.width() == pyramid.width_px() && layer.target.height() == pyramid.height_px());
    Rect const whole{0, 0, pyramid.width_px(), pyramid.height_px()};
    Rect const viewport = layer.config.viewport.value_or(whole);
    BoxJob job{};
    if (boxes.empty()) return;
    if (!set_scissor(job, layer, whole) || viewport.width <= 0 || viewport.height <= 0) {
        std::fill(out.begin(), out.end(), BoxVerdict::outside);
        return;
    }
    job.boxes = &boxes[0].lo.x;
    set_view(job, layer, viewport);
    set_image(job, layer, pyramid);
    detail::TestBoxesFn const simd = detail::simd_test_boxes();
    detail::TestBoxesFn const test =
        layer.config.kernel == Kernel::scalar || simd == nullptr ? &detail::scalar_test_boxes : simd;
    auto* const verdicts = reinterpret_cast<std::uint8_t*>(out.data());
    executor.parallel_for(boxes.size(), box_grain,
                          [&](std::size_t begin, std::size_t end) { test(job, begin, end, verdicts); });
}

BoxVerdict test_box(math::Aabb const& box, Layer const& layer, DepthPyramid const& pyramid) {
    BoxVerdict verdict = BoxVerdict::outside;
    core::SerialExecutor serial;
    test_boxes({&box, 1}, layer, pyramid, {&verdict, 1}, serial);
    return verdict;
}

}  // namespace gnomon::raster
