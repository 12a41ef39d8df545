#pragma once
// The conservative pass's records, and how its triangles and tiles are drawn in the frame of tiled.hpp.

#include <gnomon/raster/conservative.hpp>

#include "conservative.hpp"
#include "plan.hpp"
#include "tiled.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace gnomon::raster::detail {

/// What is left of a clipped triangle, snapped.
struct SnappedPolygon {
    std::array<SnappedVertex, 10> corner;
    int count;
};

struct ConservativeRecord {
    SnappedTriangle corner;
    std::uint16_t min_x, min_y, max_x, max_y;
    std::uint32_t polygon;  // 1 + its place in the chunk's extras, in place of `corner`; or 0.
};

/// Steps from a row's first pixel, both ends included.
struct PixelSpan {
    std::int32_t first, last;
};

class ConservativeRules {
  public:
    using Record = ConservativeRecord;
    using Extra = SnappedPolygon;
    using Counts = ConservativeStats;
    using Chunk = TiledChunk<ConservativeRules>;

    ConservativeRules(ConservativeConfig const& config, Plan const& plan);

    void set_up(std::size_t begin, std::size_t end, Chunk& chunk) const;
    template <class ForEach>
    std::uint64_t draw(TileRect const& tile, bool first_batch, ForEach const& for_each) const;
    void add(ConservativeStats const& counts);

    [[nodiscard]] ConservativeStats const& stats() const noexcept { return stats_; }

  private:
    void set_up_triangle(Item const& item, std::size_t triangle, Chunk& chunk) const;
    void add_polygon(SnappedPolygon const& polygon, Item const& item, Chunk& chunk) const;
    [[nodiscard]] bool is_culled(SnappedPolygon const& polygon, Facing facing) const;
    [[nodiscard]] std::uint64_t draw_triangle(TileJob const& job, Record const& record) const;
    /// One row of a triangle's pixels within a tile.
    struct Row {
        PixelTriangle const* t;
        float* held;     // The image at the first pixel.
        std::int32_t x;  // The first pixel.
        double y;        // Of the squares' centres.
        float best;      // No pixel gets anything better.
        EdgeValues at;   // At the first square's centre.
    };
    [[nodiscard]] std::uint64_t draw_touched(Row const& row, PixelSpan const& span) const;
    [[nodiscard]] std::uint64_t draw_covered(Row const& row, PixelSpan const& span) const;
    [[nodiscard]] std::uint64_t draw_polygon(TileJob const& job, Record const& record,
                                             SnappedPolygon const& polygon) const;
    [[nodiscard]] float best_of(SnappedTriangle const& t) const;
    [[nodiscard]] bool improves_any(float best, float const* held, std::int32_t count) const;
    /// A bound as the image holds it: in [0, 1], or a code that is not inside the bound.
    [[nodiscard]] float stored(double bound) const {
        double const z = sign_ * bound;
        double const depth = z < 0.0 ? 0.0 : z > 1.0 ? 1.0 : z;
        return quantize_ ? stored_code(depth) : static_cast<float>(depth);
    }
    [[nodiscard]] float stored_code(double depth) const;
    [[nodiscard]] bool improves(float depth, float held) const { return keeps_least_ ? depth < held : depth > held; }

    ConservativeConfig const& config_;
    Plan const& plan_;
    bool quantize_;
    double sign_;  // 1 where the wanted bound is the least, -1 where it is the greatest.
    bool keeps_least_;
    ConservativeStats stats_;
};

}  // namespace gnomon::raster::detail
