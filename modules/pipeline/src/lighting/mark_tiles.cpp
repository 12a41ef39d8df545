// The kernel `mark_tiles`: its C++ half.

#include <shaders/mark_tiles_comp.hpp>

#include <gnomon/lights/hull.hpp>

#include "tile_kernels.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace gnomon::pipeline {

namespace {

struct Marking {
    MarkTilesStd c;
    std::span<lights::Hull const> hulls;
    lights::HullTiles tiles;
    std::span<std::uint32_t> marks;

    explicit Marking(backend::KernelData const& data)
        : c(data.constant<MarkTilesStd>()), hulls(data.buffer<lights::Hull const>(0)), marks(data.buffer<std::uint32_t>(2)) {
        auto const borders = data.buffer<float const>(1);
        tiles = {borders.subspan(0, c.columns + 1), borders.subspan(c.columns + 1, c.rows + 1), c.orthographic == 0};
    }
    void mark(std::size_t light, std::size_t tile) const noexcept {
        std::uint32_t& word = marks[tile * c.words + light / 32];
        std::atomic_ref<std::uint32_t>(word).fetch_or(1U << (light % 32), std::memory_order_relaxed);
    }
    void draw(std::size_t light, std::uint32_t face, std::uint32_t band) const {
        lights::Hull const& hull = hulls[light];
        std::uint32_t const top = std::min(band * c.band_rows, c.rows), bottom = std::min(top + c.band_rows, c.rows);
        if (hull.kind == static_cast<std::uint32_t>(lights::HullKind::nowhere)) return;
        if (hull.kind == static_cast<std::uint32_t>(lights::HullKind::everywhere)) {
            for (std::size_t tile = std::size_t{c.columns} * top; face == 0 && tile < std::size_t{c.columns} * bottom; ++tile) mark(light, tile);
            return;
        }
        lights::HullTiles const within{tiles.x, tiles.y.subspan(top, bottom - top + 1), tiles.perspective};
        lights::for_each_tile(hull, face, within, [&](std::uint32_t i, std::uint32_t j) { mark(light, std::size_t{top + j} * c.columns + i); });
    }
};

void mark_tiles(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    Marking const work(data);
    for (std::size_t item = begin; item < std::min<std::size_t>(end, work.c.count); ++item) {
        std::size_t const triangle = item / work.c.bands;
        work.draw(triangle / lights::hull_faces, static_cast<std::uint32_t>(triangle % lights::hull_faces), static_cast<std::uint32_t>(item % work.c.bands));
    }
}

}  // namespace

constinit backend::Kernel const mark_tiles_kernel{.name = "mark_tiles",
                                                  .cpu = &mark_tiles,
                                                  .spirv = mark_tiles_comp,
                                                  .buffers = 3,
                                                  .constant_bytes = sizeof(MarkTilesStd),
                                                  .grain = 64 * lights::hull_faces};

}  // namespace gnomon::pipeline
