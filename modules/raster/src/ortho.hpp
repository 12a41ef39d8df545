#pragma once
// The records and rules of the orthographic integer pass, for the frame of tiled.hpp.

#include <gnomon/raster/ortho.hpp>

#include "tiled.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::raster::detail {

/// A triangle in units from the image's corner. Turned so that the area is positive; corner 0 stays the first.
struct OrthoRecord {
    std::int64_t x[3], y[3], z[3];
    std::uint16_t min_x, min_y, max_x, max_y;
    std::uint32_t draw;
    std::uint32_t uv[3];  // Places in the draw's texture coordinates; of use in alpha-tested draws only.
};

/// One tile's codes, as floats: whole numbers up to 2^24. Rows of `tile_size`.
struct OrthoTile {
    TileRect rect;
    float* code;
};

class OrthoRules {
  public:
    using Record = OrthoRecord;
    struct Extra {};
    using Counts = OrthoStats;
    using Chunk = TiledChunk<OrthoRules>;

    OrthoRules(std::span<OrthoDraw const> draws, std::span<std::size_t const> ends, IntegerOrtho const& light,
               OrthoConfig const& config, DepthTarget const& target);

    [[nodiscard]] TiledArea area() const;
    void set_up(std::size_t begin, std::size_t end, Chunk& chunk) const;
    template <class ForEach>
    std::uint64_t draw(TileRect const& rect, bool first_batch, ForEach const& for_each) const;
    void add(OrthoStats const& counts);

    OrthoStats stats;

  private:
    void set_up_triangle(std::uint32_t draw, std::size_t triangle, Chunk& chunk) const;
    [[nodiscard]] bool read_corner(OrthoDraw const& draw, std::uint32_t index, LightVertex& corner, Chunk& chunk) const;
    void add_record(OrthoRecord& record, Chunk& chunk) const;
    void load(OrthoTile const& tile) const;
    void store(OrthoTile const& tile) const;

    std::span<OrthoDraw const> draws_;
    std::span<std::size_t const> ends_;  // Triangles up to and with each draw.
    IntegerOrtho const& light_;
    OrthoConfig const& config_;
    DepthTarget const& target_;
    float last_code_;
    std::int32_t x0_, y0_, x1_, y1_;
};

}  // namespace gnomon::raster::detail
