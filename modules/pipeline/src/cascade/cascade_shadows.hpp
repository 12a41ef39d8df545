#pragma once
// The maps of cascades from frame to frame: what is kept of each, and what is drawn.

#include <gnomon/cache/cached_map.hpp>
#include <gnomon/cascade/cascades.hpp>

#include "casters.hpp"
#include "map_pictures.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::pipeline {

/// What may be kept.
enum class CascadeReuse : std::uint8_t {
    none,    ///< All casters are drawn in every frame.
    still,   ///< A map of static casters, while its volume stays where it is.
    scroll,  ///< That map, moved with its volume.
};

struct CascadeOptions {
    CascadeReuse reuse = CascadeReuse::none;
    cascade::CascadeConfig cascades;
    backend::DepthFormat format = backend::DepthFormat::unorm16;
    math::Depth depth = math::Depth::forward;
    CasterConfig casters;
};

/// What one map cost in one frame.
struct CascadeWork {
    std::uint64_t triangles = 0;
    std::uint64_t batches = 0;
    std::uint64_t draw_calls = 0;
    std::uint64_t texels_scrolled = 0;
    std::uint64_t texels_copied = 0;
    std::uint64_t texels_cleared = 0;
    cache::Reason reason = cache::Reason::none;
};

/// The maps of all cascades of one camera.
class CascadeShadows {
  public:
    /// Follows the frame's geometry and the options; stages what must be, once.
    void follow(Verbs& verbs, Frame const& frame, CascadeOptions const& options, core::ExecutorRef executor);
    /// Places the maps of a frame and decides what of each is kept.
    ///
    /// expects: `follow` of the same frame before, and `draw` of it afterwards.
    /// returns: what is wrong with the configuration or the camera, if anything is.
    Result<core::Done> prepare(Frame const& frame);
    /// Brings the maps up to date, in stages "scroll", "static" and "active", or "depth_pass" alone.
    ///
    /// expects: `prepare` of the same frame before.
    /// `steps`: where not null, what each map holds on the way is read back into it, in no stage; filled by `finish`.
    void draw(Verbs& verbs, Frame const& frame, std::vector<MapSteps>* steps = nullptr);
    /// Gives up all maps: after a failure nobody knows what they hold.
    void forget() noexcept;

    [[nodiscard]] cascade::CascadeFrame const& frame() const noexcept { return frame_; }
    /// Layer k: the finished map of cascade k.
    [[nodiscard]] backend::TargetId target() const noexcept { return working_.get(); }
    [[nodiscard]] MapFormat format() const noexcept { return {shape_.size_px.x, shape_.format, shape_.depth}; }
    [[nodiscard]] std::span<CascadeWork const> work() const noexcept { return {work_.data(), frame_.count}; }

  private:
    /// C, what C becomes when it scrolls, and what is known of them.
    struct Map {
        cache::CachedMap cached{};
        std::array<Held<backend::TargetId>, 2> content;
        std::uint32_t shown = 0;  ///< Which of the two is C.
        cache::LightUnits units;
        std::vector<cache::Object> objects;  ///< Boxes in these units.
        std::vector<std::uint32_t> all;      ///< Without a cache: what touches the volume.
        cache::Plan plan;                    ///< Points into `cached`, or to `all`.
    };

    /// The targets' shape and what may be in them.
    struct Shape {
        CascadeReuse reuse = CascadeReuse::none;
        math::ivec2 size_px{0, 0};
        std::uint32_t count = 0;
        backend::DepthFormat format = backend::DepthFormat::unorm16;
        math::Depth depth = math::Depth::forward;

        friend bool operator==(Shape const&, Shape const&) noexcept = default;
    };

    /// Cascade k of a frame, for `draw_ortho`.
    [[nodiscard]] backend::OrthoLayer layer_of(Frame const& frame, std::uint32_t k) const noexcept;
    void fit_targets(Verbs& verbs, CascadeOptions const& options);
    void fit_objects(Map& map, std::uint32_t k, std::span<math::vec3 const> positions);
    /// What is not a move in light space makes a cached map useless.
    void tell_changes(Map& map, cascade::CascadePlan const& plan);
    void plan(Map& map, std::uint32_t k);
    void draw_objects(Verbs& verbs, backend::TargetId target, backend::OrthoLayer layer, std::span<std::uint32_t const> objects,
                      CascadeWork& work);
    void scroll(Verbs& verbs, std::uint32_t k);
    void draw_statics(Verbs& verbs, Frame const& frame, std::uint32_t k);
    void draw_actives(Verbs& verbs, Frame const& frame, std::uint32_t k);
    void note_kept(Verbs& verbs, std::vector<MapSteps>& steps);
    void note_drawn(Verbs& verbs, std::vector<MapSteps>& steps);

    CascadeOptions options_;
    Casters casters_;
    std::uint64_t tick_ = 0;
    cascade::Cascades cascades_;
    cascade::CascadeFrame frame_;
    std::array<Map, cascade::max_cascades> maps_;
    std::array<CascadeWork, cascade::max_cascades> work_{};
    Held<backend::TargetId> working_;
    std::vector<std::uint32_t> places_, resting_places_, posed_places_;
    Shape shape_;
};

/// Scrolls a map into another target: constants GnScroll, target 0 the map as it was.
extern backend::DepthKernel const scroll_depth_kernel;

}  // namespace gnomon::pipeline
