#pragma once
// The maps of one light from frame to frame: of each the image of its static casters is kept, and drawn again only when one of
// them or the light changed; the others are drawn over a copy of it.
//
// source: [CSM Scrolling, 2], the cache of maps that do not scroll

#include <gnomon/cache/budget.hpp>
#include <gnomon/cache/cached_map.hpp>

#include "../cascade/casters.hpp"
#include "../cascade/map_pictures.hpp"
#include "shadow_map.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::pipeline {

/// What one frame of all maps cost.
struct CachedWork {
    std::uint64_t static_triangles = 0;
    std::uint64_t active_triangles = 0;
    std::uint64_t draw_calls = 0;
    std::uint64_t texels_copied = 0;
    std::uint64_t texels_cleared = 0;
    std::uint64_t maps_postponed = 0;
};

/// All that a light's image depends on besides its casters.
struct LightState {
    Light light;
    ShadowMapOptions options;
};

/// How far a light may go before its maps are drawn anew.
struct LightThresholds {
    double move_m = 0.0;
    double turn_deg = 0.0;  ///< Small.
};

/// What a frame asks of its maps.
struct MapsWanted {
    LightState light;
    bool fresh = false;  ///< Their target was made anew.
    std::optional<cache::BudgetConfig> budget{};  ///< Of the static casters' triangles; none: all that is due is drawn.
    std::uint8_t looked_into = 0xFF;              ///< Maps that a sample looks into, as bits; the others are idle.
};

/// Why maps that were drawn under `before` are not right under `now`; none if only the lookup changed.
[[nodiscard]] std::optional<cache::MapEvent> change_between(LightState const& before, LightState const& now) noexcept;

/// Whether a box may have a texel of the map: never a false no, whatever the pass rounds.
///
/// Casters beyond the far plane have none that differ from a cleared map's; those before the near plane are clamped to it.
[[nodiscard]] bool may_touch(math::Aabb const& box, backend::PassLayer const& layer) noexcept;

class CachedLights {
  public:
    /// Follows the frame's casters.
    void follow(Verbs& verbs, Frame const& frame, ShadowMapOptions const& options, CasterConfig const& casters, core::ExecutorRef executor);
    /// Where the light is to be for its maps: where it was for them, if it went no farther than `thresholds` since.
    ///
    /// expects: `follow` of the same frame before.
    [[nodiscard]] LightPlace place(Frame const& frame, LightThresholds const& thresholds) const;
    /// Makes the maps of the static casters, like those of `shadow`, where there are none or those were made anew.
    void fit_content(Verbs& verbs, ShadowMaps const& shadow, bool fresh);
    /// Decides what of each map is kept, and which maps wait. Of those `shadow` has the views that they were drawn with.
    ///
    /// expects: `follow` and `fit_content` of the same frame before; `shadow` has the layers of that light; `draw` afterwards.
    void plan(ShadowMaps& shadow, MapsWanted const& wanted);
    /// Brings the maps up to date, in stages "static" and "active".
    /// `steps`: where not null, what each map holds on the way is read back into it, in no stage; filled by `finish`.
    void draw(Verbs& verbs, ShadowMaps const& shadow, std::vector<MapSteps>* steps = nullptr);
    /// Gives up all maps: after a failure nobody knows what they hold.
    void forget() noexcept;

    [[nodiscard]] CachedWork const& work() const noexcept { return work_; }
    [[nodiscard]] std::size_t maps() const noexcept { return maps_.size(); }
    /// Why a map was drawn to; none of a map that waits.
    [[nodiscard]] cache::Reason reason(std::size_t map) const noexcept { return maps_[map].waits ? cache::Reason::none : maps_[map].plan.reason; }

  private:
    struct Map {
        cache::CachedMap cached{};
        backend::PassLayer layer;  ///< As C was drawn; and the same as a view, and for the lookup.
        math::View view;
        shadow::MapView map_view{};
        bool waits = false;
        cache::Plan plan;          ///< Points into `cached`.
    };
    /// A list of some objects, each with the maps that it is drawn to as its groups.
    struct MaskedList {
        std::vector<std::uint8_t> maps;  ///< Of each object.
        std::vector<raster::Draw> draws;
        Held<backend::DrawListId> kept;
        std::vector<std::uint8_t> kept_maps;
    };

    void fit_objects(ShadowMaps const& shadow);
    void tell_changes(ShadowMaps const& shadow, LightState const& now, bool fresh);
    /// Postpones maps beyond the budget, of which `shadow` then has what they show.
    void choose(ShadowMaps& shadow, MapsWanted const& wanted);
    /// Keeps the list for `list.maps`, unless it is there.
    void keep(Verbs& verbs, MaskedList& list);
    void draw_statics(Verbs& verbs, ShadowMaps const& shadow);
    void draw_actives(Verbs& verbs, ShadowMaps const& shadow);
    void note_kept(Verbs& verbs, ShadowMaps const& shadow, std::vector<MapSteps>& steps);
    void note_drawn(Verbs& verbs, ShadowMaps const& shadow, std::vector<MapSteps>& steps);

    Casters casters_;
    std::uint64_t tick_ = 0;
    bool other_objects_ = true;
    LightState state_;
    LightPlace at_;
    std::vector<Map> maps_;
    std::vector<backend::PassLayer> seen_by_;  ///< The layers that `touches_` are of.
    std::vector<std::uint8_t> touches_;        ///< Of each object: the maps that may show it, as bits.
    std::vector<cache::Object> objects_;
    Held<backend::TargetId> content_;  ///< C: a layer for each map.
    std::vector<backend::PassLayer> layers_;
    MaskedList statics_, actives_;
    CachedWork work_;
};

}  // namespace gnomon::pipeline
