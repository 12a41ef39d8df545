#pragma once
// One pass into many images: cube faces, cascades, the tiles of an atlas.

#include <gnomon/core/executor.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/raster/draw.hpp>
#include <gnomon/raster/pass.hpp>
#include <gnomon/raster/target.hpp>

#include <cstdint>
#include <span>

namespace gnomon::raster {

/// An image of a layered pass, its view, and how it is drawn.
struct Layer {
    DepthTarget target;                        ///< Often a part of an atlas: `ImageView::sub`.
    ImageView<std::uint32_t> triangle{};       ///< With data: takes the triangles' ids. As large as a float `target`.
    math::vec3 origin{0.0F, 0.0F, 0.0F};       ///< In place of `Draw::origin`.
    math::mat4 clip_from_relative{1.0F};       ///< In place of `Draw::clip_from_relative`.
    std::uint64_t groups = ~std::uint64_t{0};  ///< Takes the draws that share a bit with it: `Draw::groups`.
    PassConfig config{};
};

/// Draws `draws` into every layer, each with its own view: what a pass per layer gives, bit for bit.
///
/// All layers' vertices, triangles and tiles are shared out together, so that many small layers keep many threads busy.
/// A draw's own `origin` and `clip_from_relative` are not read; one with a transform has an instance.
/// expects: what `depth_pass` does of each layer, and no pixel in two layers.
/// returns: each layer's counts, in `workspace` until its next pass. Allocates only what `workspace` lacks.
/// cost:    as the passes one by one.
std::span<PassStats const> layered_pass(std::span<Draw const> draws, std::span<Layer const> layers,
                                        Workspace& workspace, core::ExecutorRef executor);

}  // namespace gnomon::raster
