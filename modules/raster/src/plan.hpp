#pragma once
// A pass laid out before it runs: what each layer draws, with everything that stays fixed for the pass.

#include <gnomon/core/executor.hpp>
#include <gnomon/raster/layers.hpp>
#include <gnomon/raster/pass.hpp>
#include <gnomon/raster/triangle.hpp>

#include "bins.hpp"
#include "buffer.hpp"
#include "kernel.hpp"
#include "masked.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::raster::detail {

/// One instance of a draw in one layer. Items lie layer by layer, in draw order.
struct Item {
    VertexJob vertex;
    SetupJob setup;
    std::size_t first_triangle;  // In the pass.
    std::size_t triangles;
    std::size_t first_corner;  // In the corners of the batch that transforms it.
    KernelTable const* kernel;
};

/// Which of a draw's positions are transformed.
struct CornerRange {
    std::uint32_t first;
    std::uint32_t count;
};

/// The instances of one draw in one layer.
struct Group {
    std::size_t first_item;
    std::size_t first_triangle;  // In the pass.
    std::size_t triangles;       // Of each instance.
    std::uint32_t draw, layer;
    std::uint32_t first_masked;  // Of the masked draws, plus 1; 0 draws solid triangles.
};

/// One image of the pass.
struct LayerPlan {
    Layer const* layer;
    bool draws_own_view;  // Take `Draw::origin` and its matrix, not the layer's.
    KernelTable const* kernel;
    ViewportTransform viewport;
    bool streams;                 // Tiles are stored past the caches.
    bool summarizes;              // Tiles hand out their blocks of the pyramid.
    std::int32_t x0, y0, x1, y1;  // What is cleared and drawn: scissor and target.
    BinGrid grid;
    std::size_t first_triangle, end_triangle;  // In the pass.

    [[nodiscard]] bool is_empty() const noexcept { return x1 <= x0 || y1 <= y0; }
};

/// All of a pass. The draws and layers that it was made of must stay.
struct Plan {
    std::vector<LayerPlan> layers;
    std::vector<PassStats> stats;  // One for each layer.
    std::vector<Group> groups;
    std::vector<CornerRange> ranges;  // One for each draw.
    std::vector<MaskedDraw> masked;
    Buffer<Item> items;
    std::size_t item_count = 0;
    std::size_t triangles = 0;
    std::size_t pixels = 0;  // Of all targets.

    [[nodiscard]] std::size_t size_bytes() const noexcept {
        return layers.capacity() * sizeof(LayerPlan) + stats.capacity() * sizeof(PassStats) +
               groups.capacity() * sizeof(Group) + ranges.capacity() * sizeof(CornerRange) +
               masked.capacity() * sizeof(MaskedDraw) + items.size_bytes();
    }
};

/// `draws_own_view`: the only layer's view is the draws' own.
void make_plan(Plan& plan, std::span<Draw const> draws, std::span<Layer const> layers, bool draws_own_view,
               core::ExecutorRef executor);

/// Lets layers work in blocks (`TileJob::blocked`) where that is faster: where the machine has such a kernel and no
/// draw is alpha-tested. For callers that leave a tile's inside to the kernel.
void prefer_blocks(Plan& plan);

}  // namespace gnomon::raster::detail
