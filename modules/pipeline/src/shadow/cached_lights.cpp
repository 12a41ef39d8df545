// Cached maps of a light over a backend: [CSM Scrolling, 2].

#include "cached_lights.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::pipeline {

namespace {

/// Do two layers draw the same triangles to the same texels and depths?
bool same_image(backend::PassLayer const& a, backend::PassLayer const& b) noexcept {
    return a.origin == b.origin && a.clip_from_relative == b.clip_from_relative && a.depth == b.depth && a.range == b.range;
}

bool same_image(std::span<backend::PassLayer const> a, std::span<backend::PassLayer const> b) noexcept {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](auto const& x, auto const& y) { return same_image(x, y); });
}

/// Two draws whose triangles lie in a row become one.
bool join(raster::Draw& a, raster::Draw const& b) noexcept {
    bool const alike = a.alpha_test == nullptr && b.alpha_test == nullptr && a.groups == b.groups && a.cull == b.cull &&
                       a.positions.data() == b.positions.data() && a.positions.size() == b.positions.size() &&
                       a.indices.wide() != nullptr && a.indices.wide() + a.indices.size() == b.indices.wide();
    if (alike) a.indices = std::span(a.indices.wide(), a.indices.size() + b.indices.size());
    return alike;
}

std::uint64_t texels_of(ShadowMaps const& shadow) noexcept {
    return static_cast<std::uint64_t>(shadow.config.size_px.x) * static_cast<std::uint64_t>(shadow.config.size_px.y);
}

}  // namespace

std::optional<cache::MapEvent> change_between(LightState const& before, LightState const& now) noexcept {
    using cache::MapEvent;
    bool const local = now.light.kind != LightKind::directional;
    bool const aimed = now.light.kind != LightKind::point;
    if (before.light.kind != now.light.kind || before.options.depth != now.options.depth) return MapEvent::projection_changed;
    if (before.options.resolution != now.options.resolution) return MapEvent::resolution_changed;
    if (before.options.format != now.options.format || before.options.cull != now.options.cull) return MapEvent::settings_changed;
    if (local && before.light.position_m != now.light.position_m) return MapEvent::light_posed;
    if (aimed && before.light.direction != now.light.direction) return MapEvent::light_posed;
    if (now.light.kind == LightKind::spot && before.light.outer_cone_rad != now.light.outer_cone_rad) return MapEvent::light_cone;
    if (local && before.light.range_m != now.light.range_m) return MapEvent::light_range;
    return std::nullopt;
}

bool may_touch(math::Aabb const& box, backend::PassLayer const& layer) noexcept {
    if (math::is_empty(box)) return false;
    constexpr double slack = 1e-4;  // of the sum of the terms' sizes: floats err by some 1e-6 of it
    math::dvec3 const corner[2] = {math::to_double(box.lo), math::to_double(box.hi)};
    std::array<std::array<double, 4>, 4> row{};
    for (math::axis_t r = 0; r < 4; ++r)
        for (math::axis_t c = 0; c < 4; ++c) row[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] = static_cast<double>(layer.clip_from_relative[c][r]);
    bool const reversed = layer.depth == math::Depth::reversed;
    // Left, right, top, bottom, behind the light, beyond the far plane.
    std::array<bool, 6> outside{true, true, true, true, true, true};
    for (unsigned i = 0; i < 8; ++i) {
        math::dvec3 const p(corner[i & 1U].x, corner[i >> 1U & 1U].y, corner[i >> 2U].z);
        std::array<double, 4> const d{p.x - static_cast<double>(layer.origin.x), p.y - static_cast<double>(layer.origin.y),
                                      p.z - static_cast<double>(layer.origin.z), 1.0};
        std::array<double, 4> clip{};
        std::array<double, 4> size{};
        for (std::size_t r = 0; r < 4; ++r)
            for (std::size_t c = 0; c < 4; ++c) {
                clip[r] += row[r][c] * d[c];
                size[r] += std::abs(row[r][c] * d[c]);
            }
        double const w = clip[3];
        auto const beyond = [&](double over, std::size_t axis) { return over > slack * (size[axis] + size[3]); };
        outside[0] = outside[0] && beyond(-clip[0] - w, 0);
        outside[1] = outside[1] && beyond(clip[0] - w, 0);
        outside[2] = outside[2] && beyond(-clip[1] - w, 1);
        outside[3] = outside[3] && beyond(clip[1] - w, 1);
        outside[4] = outside[4] && beyond(-w, 3);
        outside[5] = outside[5] && beyond(reversed ? -clip[2] : clip[2] - w, 2);
    }
    return std::find(outside.begin(), outside.end(), true) == outside.end();
}

void CachedLights::forget() noexcept {
    maps_.clear();
    content_ = {};
}

void CachedLights::follow(Verbs& verbs, Frame const& frame, ShadowMapOptions const& options, CasterConfig const& casters, core::ExecutorRef executor) {
    CasterConfig config = casters;
    config.cull = options.cull;
    config.keeps_lists = false;
    other_objects_ = casters_.follow(verbs, frame, config, ++tick_, executor);
    if (!casters_.redrawn()) return;
    // They point to triangles that were.
    actives_.kept = {};
    statics_.kept = {};
}

void CachedLights::fit_objects(ShadowMaps const& shadow) {
    bool const same_views = !other_objects_ && same_image(seen_by_, shadow.layers);
    objects_.resize(casters_.size());
    touches_.resize(casters_.size());
    for (std::uint32_t i = 0; i < casters_.size(); ++i) {
        cache::ObjectRecord const& record = casters_.record(i);
        if (!same_views || objects_[i].revision != record.revision) {
            touches_[i] = 0;
            for (std::size_t m = 0; m < shadow.layers.size(); ++m)
                if (may_touch(casters_.box(i), shadow.layers[m])) touches_[i] = static_cast<std::uint8_t>(touches_[i] | 1U << m);
        }
        objects_[i] = cache::make_object(cache::ObjectId(i), record);
    }
    seen_by_ = shadow.layers;
}

void CachedLights::tell_changes(ShadowMaps const& shadow, LightState const& now, bool fresh) {
    maps_.resize(shadow.layers.size());
    auto const change = change_between(state_, now);
    for (std::size_t m = 0; m < maps_.size(); ++m) {
        Map& map = maps_[m];
        if (!cache::holds_image(map.cached.state())) continue;
        if (change) map.cached.notify(*change);
        // The depth range goes with the casters.
        if (!same_image(map.layer, shadow.layers[m])) map.cached.notify(cache::MapEvent::projection_changed);
        bool const right = map.cached.state() != cache::MapState::invalid;
        // Its members' ids are other objects' now, or its memory is new.
        if (other_objects_ || (fresh && right)) map.cached.notify(cache::MapEvent::content_lost);
    }
    state_ = now;
}

LightPlace CachedLights::place(Frame const& frame, LightThresholds const& thresholds) const {
    LightPlace const now = place_of(frame);
    if (other_objects_ || maps_.empty() || (thresholds.move_m <= 0.0 && thresholds.turn_deg <= 0.0)) return now;
    // Posed as before, is it the same light?
    Light as_before = now.light;
    as_before.position_m = at_.light.position_m;
    as_before.direction = at_.light.direction;
    if (change_between({at_.light, {}}, {as_before, {}})) return now;
    bool const near = glm::length(now.light.position_m - at_.light.position_m) <= thresholds.move_m;
    bool const along = turned_at_most(at_.light.direction, now.light.direction, thresholds.turn_deg);
    bool const placed = now.light.kind != LightKind::directional;
    bool const aimed = now.light.kind != LightKind::point;
    if ((placed && !near) || (aimed && !along)) return now;
    LightPlace held = at_;
    held.light = now.light;
    held.light.position_m = at_.light.position_m;
    held.light.direction = at_.light.direction;
    return held;
}

void CachedLights::choose(ShadowMaps& shadow, MapsWanted const& wanted) {
    std::array<cache::Work, 8> works{};
    std::array<std::uint32_t, 8> order{};
    std::size_t count = 0;
    for (std::uint32_t m = 0; m < maps_.size(); ++m) {
        Map const& map = maps_[m];
        if (map.plan.action == cache::MapAction::none) continue;
        bool const nothing_to_see = wanted.fresh || !cache::holds_image(map.cached.state());
        bool const idle = (wanted.looked_into >> m & 1U) == 0;
        cache::Work& work = works[count++];
        work = {m, nothing_to_see ? cache::Priority::mandatory : idle ? cache::Priority::idle : cache::Priority::requested, 0, map.cached.stale_updates()};
        for (std::uint32_t const i : map.plan.statics) work.cost += casters_.triangles(i);
    }
    auto const report = cache::choose(std::span(works).first(count), *wanted.budget, order);
    for (std::size_t i = report.chosen; i < count; ++i) {
        std::size_t const m = works[order[i]].id;
        Map& map = maps_[m];
        map.cached.postpone();
        map.waits = true;
        shadow.layers[m] = map.layer;
        shadow.views[m] = map.view;
        shadow.maps[m] = map.map_view;
    }
    work_.maps_postponed = report.postponed;
}

void CachedLights::fit_content(Verbs& verbs, ShadowMaps const& shadow, bool fresh) {
    if (!fresh && !content_.get().is_none()) return;
    content_ = {};
    content_ = Held(verbs.device(), verbs(verbs.device().make_target(shadow.config)));
}

void CachedLights::plan(ShadowMaps& shadow, MapsWanted const& wanted) {
    GNOMON_EXPECT(shadow.layers.size() <= 8);  // bits of `touches_`
    fit_objects(shadow);
    work_ = {};
    at_ = shadow.at;
    tell_changes(shadow, wanted.light, wanted.fresh);
    statics_.maps.assign(objects_.size(), 0);
    actives_.maps.assign(objects_.size(), 0);
    for (std::size_t m = 0; m < maps_.size(); ++m) {
        maps_[m].plan = maps_[m].cached.plan_fixed(objects_, [&](std::uint32_t i) { return (touches_[i] >> m & 1U) != 0; });
        maps_[m].waits = false;
    }
    if (wanted.budget) choose(shadow, wanted);
    for (std::size_t m = 0; m < maps_.size(); ++m) {
        Map& map = maps_[m];
        if (map.waits) continue;
        auto const bit = static_cast<std::uint8_t>(1U << m);
        map.layer = shadow.layers[m];
        map.view = shadow.views[m];
        map.map_view = shadow.maps[m];
        for (std::uint32_t const i : map.plan.statics) statics_.maps[i] |= bit;
        for (std::uint32_t const i : map.plan.actives) actives_.maps[i] |= bit;
    }
}

void CachedLights::keep(Verbs& verbs, MaskedList& list) {
    if (!list.kept.get().is_none() && list.kept_maps == list.maps) return;
    list.kept = {};
    list.draws.clear();
    for (std::size_t i = 0; i < list.maps.size(); ++i) {
        if (list.maps[i] == 0) continue;
        raster::Draw draw = casters_.draw(i);
        if (draw.indices.empty()) continue;
        draw.groups = list.maps[i];
        if (list.draws.empty() || !join(list.draws.back(), draw)) list.draws.push_back(draw);
    }
    list.kept = Held(verbs.device(), verbs(verbs.device().keep(list.draws)));
    list.kept_maps = list.maps;
}

void CachedLights::draw_statics(Verbs& verbs, ShadowMaps const& shadow) {
    layers_.clear();
    for (std::size_t m = 0; m < maps_.size(); ++m) {
        cache::MapAction const action = maps_[m].plan.action;
        bool const anew = action == cache::MapAction::redraw;
        if (maps_[m].waits || (!anew && action != cache::MapAction::add)) continue;
        layers_.push_back(shadow.layers[m]);
        layers_.back().groups = std::uint64_t{1} << m;
        layers_.back().load = anew ? backend::Load::clear : backend::Load::keep;
        work_.texels_cleared += anew ? texels_of(shadow) : 0;
    }
    if (layers_.empty()) return;
    keep(verbs, statics_);
    auto const drawn = verbs(verbs.device().draw(statics_.kept.get(), content_.get(), layers_));
    work_.static_triangles += drawn.triangles;
    work_.draw_calls += drawn.draw_calls;
}

void CachedLights::draw_actives(Verbs& verbs, ShadowMaps const& shadow) {
    layers_.clear();
    for (std::size_t m = 0; m < maps_.size(); ++m) {
        cache::Compose const compose = maps_[m].plan.compose;
        if (maps_[m].waits || compose == cache::Compose::keep) continue;
        auto const layer = static_cast<std::uint32_t>(m);
        backend::Rect const whole{0, 0, shadow.config.size_px.x, shadow.config.size_px.y};
        verbs(verbs.device().copy({content_.get(), layer, backend::Plane::depth, whole}, shadow.target.get(), layer, math::ivec2(0, 0)));
        work_.texels_copied += texels_of(shadow);
        if (compose == cache::Compose::copy) continue;
        layers_.push_back(shadow.layers[m]);
        layers_.back().groups = std::uint64_t{1} << m;
        layers_.back().load = backend::Load::keep;
    }
    if (layers_.empty()) return;
    keep(verbs, actives_);
    auto const drawn = verbs(verbs.device().draw(actives_.kept.get(), shadow.target.get(), layers_));
    work_.active_triangles += drawn.triangles;
    work_.draw_calls += drawn.draw_calls;
}

void CachedLights::note_kept(Verbs& verbs, ShadowMaps const& shadow, std::vector<MapSteps>& steps) {
    steps.assign(maps_.size(), {});
    for (std::uint32_t m = 0; m < maps_.size(); ++m) {
        bool const anew = !maps_[m].waits && maps_[m].plan.action == cache::MapAction::redraw;
        if (anew) steps[m].exposed = all_exposed(shadow.config.size_px.x);
        else note(verbs, content_.get(), m, format_of(shadow), steps[m].kept);
    }
}

void CachedLights::note_drawn(Verbs& verbs, ShadowMaps const& shadow, std::vector<MapSteps>& steps) {
    verbs.device().stage("");
    for (std::uint32_t m = 0; m < maps_.size(); ++m) {
        note(verbs, content_.get(), m, format_of(shadow), steps[m].content);
        note(verbs, shadow.target.get(), m, format_of(shadow), steps[m].finished);
    }
}

void CachedLights::draw(Verbs& verbs, ShadowMaps const& shadow, std::vector<MapSteps>* steps) {
    if (steps != nullptr) note_kept(verbs, shadow, *steps);
    verbs.device().stage("static");
    draw_statics(verbs, shadow);
    verbs.device().stage("active");
    draw_actives(verbs, shadow);
    if (steps != nullptr) note_drawn(verbs, shadow, *steps);
    for (Map& map : maps_)
        if (!map.waits) map.cached.commit();
}

}  // namespace gnomon::pipeline
