#pragma once
// A scene's casters as a cache sees them: batches of triangles that move as a whole, each with its state, its box and its
// draw.

#include <gnomon/batch/batches.hpp>
#include <gnomon/cache/object.hpp>
#include <gnomon/cache/plan.hpp>
#include <gnomon/core/executor.hpp>

#include "../detail.hpp"
#include "../staged.hpp"

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

namespace gnomon::pipeline {

/// Draws of one kept list.
struct CasterList {
    std::vector<raster::Draw> draws;
    Held<backend::DrawListId> kept;
};

struct CasterConfig {
    cache::RestConfig rest;               ///< In frames.
    std::uint32_t batch_triangles = 128;  ///< At most; the fewer, the less is drawn to fill a strip.
    raster::Cull cull = raster::Cull::none;  ///< Never of double-sided materials.
    bool keeps_lists = true;                 ///< Off: whoever draws keeps lists of `draw`s for itself.
};

/// Objects are batches: those of instances that cannot move come first, then the others, in two kept lists.
class Casters {
  public:
    /// Follows a frame's geometry at tick `now`: makes the batches of another one, moves those of an updated one.
    ///
    /// returns: whether these are other objects than before.
    bool follow(Verbs& verbs, Frame const& frame, CasterConfig const& config, std::uint64_t now, core::ExecutorRef executor);

    [[nodiscard]] std::size_t size() const noexcept { return batches_.batches.size(); }
    [[nodiscard]] cache::ObjectRecord const& record(std::size_t i) const noexcept { return records_[i]; }
    [[nodiscard]] math::Aabb const& box(std::size_t i) const noexcept { return batches_.boxes[i]; }
    [[nodiscard]] std::uint32_t triangles(std::size_t i) const noexcept { return batches_.batches[i].count; }
    /// Whether some `draw` is another one since the last `follow`: an object moved, or is culled otherwise.
    [[nodiscard]] bool redrawn() const noexcept { return redrawn_; }
    [[nodiscard]] raster::Draw const& draw(std::size_t i) const noexcept {
        return i < first_posed_ ? resting_.draws[i] : posed_.draws[i - first_posed_];
    }
    [[nodiscard]] std::size_t first_posed() const noexcept { return first_posed_; }
    [[nodiscard]] backend::DrawListId resting_list() const noexcept { return resting_.kept.get(); }
    [[nodiscard]] backend::DrawListId posed_list() const noexcept { return posed_.kept.get(); }

    /// f(position) for the corners of object `i`'s triangles.
    template <class F>
    void for_corners(std::size_t i, std::span<math::vec3 const> positions, F const& f) const {
        batch::Batch const& batch = batches_.batches[i];
        for (std::size_t k = std::size_t{batch.first} * 3; k < (std::size_t{batch.first} + batch.count) * 3; ++k) f(positions[vertices_of_[i].first + indices_[k]]);
    }

  private:
    /// The geometry's vertices that an object's triangles may use: those of its primitive.
    struct Vertices {
        std::uint32_t first = 0;
        std::uint32_t count = 0;
    };

    [[nodiscard]] std::span<std::uint32_t const> triangles_of(std::size_t i) const noexcept {
        return std::span(batches_.triangles).subspan(batches_.batches[i].first, batches_.batches[i].count);
    }
    void build(Frame const& frame, core::ExecutorRef executor);
    void build_draws(Frame const& frame);
    void add_alpha_test(Frame const& frame, scene::Material const& material, Vertices const& own);
    void keep(Verbs& verbs, bool all);
    bool move_posed(Frame const& frame, std::uint64_t now);

    std::shared_ptr<void const> identity_;  ///< Of the geometry; kept, so that no other has it.
    scene::Geometry const* geometry_ = nullptr;
    batch::Batches batches_;  ///< In the order of the objects.
    std::vector<std::uint32_t> indices_;      ///< Of the objects' triangles, into their own vertices.
    std::vector<std::uint32_t> instance_of_;  ///< Of each object.
    std::vector<Vertices> vertices_of_;
    std::vector<std::uint32_t> revisions_;    ///< Of each instance, as they were seen last.
    std::vector<cache::ObjectRecord> records_;
    std::vector<raster::AlphaTest> alpha_tests_;
    std::deque<raster::AlphaMap> alpha_maps_;  ///< Of those, one for each that differs.
    CasterConfig config_;
    std::size_t first_posed_ = 0;
    bool redrawn_ = false;
    CasterList resting_, posed_;
};

}  // namespace gnomon::pipeline
