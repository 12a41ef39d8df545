#pragma once
// Conservative visibility of boxes: a depth pyramid against the boxes' real faces and outline, many boxes at a time.
//
// The rule is one-sided: a box that would pass the depth test at any sample, drawn exactly (`any_sample_passing`), is
// never called hidden or outside. The other way round a test may miss: a visible verdict is "may be".

#include <gnomon/core/executor.hpp>
#include <gnomon/math/bounds.hpp>
#include <gnomon/raster/depth_pyramid.hpp>
#include <gnomon/raster/layers.hpp>

#include <cstdint>
#include <span>

namespace gnomon::raster {

enum class BoxVerdict : std::uint8_t {
    outside,  ///< Nothing of it is in the view: beyond a side, the near or the far plane, or empty or NaN.
    hidden,   ///< In the view, but no sample of the image is farther than it, or it lies between the samples.
    visible,  ///< May be seen. Also every box that the near plane, the far plane or the guard band cuts.
};

/// Tests each box as it would be drawn into `layer` by `box_indices`: `out[i]` for `boxes[i]`.
///
/// Eight boxes are projected at once, with the rasterizer's own arithmetic. What a look at the pyramid over a box's
/// rectangle cannot call hidden is tested by its outline and the planes of the faces that look at the eye, from coarse
/// blocks down to 8 x 8 samples and then, where `layer.target` has the image, sample by sample.
///
/// source:  hierarchical depth after [Greene 1993]; the faces' planes in place of the box's nearest depth are ours.
/// expects: `pyramid` is that of `layer.target` or of an image of its size and kind; `out` as long as `boxes`. A float
///          target without data ends the test at the blocks. `config.depth` is the pyramid's.
/// cost:    some tens of nanoseconds a box; nothing is allocated. For boxes of one local space (instances, oriented
///          boxes) pass a layer whose matrix is `clip_from_relative * relative_from_local` and whose origin is 0.
void test_boxes(std::span<math::Aabb const> boxes, Layer const& layer, DepthPyramid const& pyramid,
                std::span<BoxVerdict> out, core::ExecutorRef executor);

/// The same for one box.
[[nodiscard]] BoxVerdict test_box(math::Aabb const& box, Layer const& layer, DepthPyramid const& pyramid);

}  // namespace gnomon::raster
