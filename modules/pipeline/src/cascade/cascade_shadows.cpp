// Cascades over a backend: [CSM Scrolling, 2 and 3], drawn in whole units.

#include "cascade_shadows.hpp"

#include <gnomon/cache/light_bounds.hpp>
#include <gnomon/cascade/scroll.hpp>

#include <algorithm>

namespace gnomon::pipeline {

namespace {

cache::Volume to_cache(cascade::Volume const& v) noexcept {
    return {v.at.x, v.at.y, v.at.z, v.size_px, v.size_px, v.codes};
}

std::uint64_t texels(cascade::Volume const& v) noexcept {
    return static_cast<std::uint64_t>(v.size_px) * static_cast<std::uint64_t>(v.size_px);
}

/// What a cascade's reason is to a cache. Moves within light space are none: the cache sees them in the volume.
std::optional<cache::MapEvent> event_of(cascade::Reason reason) noexcept {
    switch (reason) {
        case cascade::Reason::none:
        case cascade::Reason::first:
        case cascade::Reason::moved_past:
        case cascade::Reason::depth_past: return std::nullopt;
        case cascade::Reason::requested: return cache::MapEvent::redraw_requested;
        case cascade::Reason::light_turned: return cache::MapEvent::light_posed;
        case cascade::Reason::anchor_moved: return cache::MapEvent::settings_changed;
        case cascade::Reason::map_size: return cache::MapEvent::resolution_changed;
        case cascade::Reason::depth_format:
        case cascade::Reason::texel_size:
        case cascade::Reason::depth_unit: return cache::MapEvent::projection_changed;
    }
    return std::nullopt;
}

}  // namespace

void CascadeShadows::forget() noexcept {
    cascades_ = {};
    for (Map& map : maps_) map = Map{};
    working_ = {};
    shape_ = {};
}

void CascadeShadows::fit_targets(Verbs& verbs, CascadeOptions const& options) {
    std::int32_t const size = options.cascades.fit.size_px;
    Shape const wanted{options.reuse, math::ivec2(size, size), options.cascades.splits.count, options.format, options.depth};
    if (shape_ == wanted) return;
    forget();
    backend::TargetConfig config{.size_px = wanted.size_px, .layers = wanted.count, .depth = wanted.format};
    working_ = Held(verbs.device(), verbs(verbs.device().make_target(config)));
    config.layers = 1;
    for (std::uint32_t k = 0; k < wanted.count && wanted.reuse != CascadeReuse::none; ++k)
        for (std::size_t i = 0; i < (wanted.reuse == CascadeReuse::scroll ? 2U : 1U); ++i)
            maps_[k].content[i] = Held(verbs.device(), verbs(verbs.device().make_target(config)));
    if (verbs.good()) shape_ = wanted;
}

backend::OrthoLayer CascadeShadows::layer_of(Frame const& frame, std::uint32_t k) const noexcept {
    cascade::Volume const& v = frame_.cascades[k].volume;
    backend::OrthoLayer layer;
    layer.light = {frame_.light.right, frame_.light.down, frame_.light.away, v.texel_m, v.depth_unit_m, v.at.x, v.at.y, v.at.z};
    layer.origin_m = frame.geometry->origin_m - frame_.anchor_m;
    layer.depth = options_.depth;
    return layer;
}

void CascadeShadows::fit_objects(Map& map, std::uint32_t k, std::span<math::vec3 const> positions) {
    cascade::Volume const& v = frame_.cascades[k].volume;
    cache::LightUnits const units{frame_.light.right, frame_.light.down, frame_.light.away, v.texel_m, v.depth_unit_m};
    bool const same_units = map.objects.size() == casters_.size() && units.right == map.units.right &&
                            units.down == map.units.down && units.away == map.units.away && units.texel_m == map.units.texel_m &&
                            units.depth_unit_m == map.units.depth_unit_m;
    map.units = units;
    map.objects.resize(casters_.size());
    for (std::uint32_t i = 0; i < casters_.size(); ++i) {
        cache::ObjectRecord const& record = casters_.record(i);
        cache::Object& object = map.objects[i];
        cache::Box box = object.box;
        if (!same_units || object.revision != record.revision) {
            // Geometry lies about its origin, which is the anchor.
            cache::LightBounds bounds(units);  // by corners: a box of the world's box reaches into more strips
            casters_.for_corners(i, positions, [&](math::vec3 const& p) { bounds.add(math::to_double(p)); });
            box = bounds.box().value_or(cache::Box{});
        }
        object = cache::make_object(cache::ObjectId(i), record, box);
    }
}

void CascadeShadows::draw_objects(Verbs& verbs, backend::TargetId target, backend::OrthoLayer layer, std::span<std::uint32_t const> objects,
                       CascadeWork& work) {
    resting_places_.clear();
    posed_places_.clear();
    for (std::uint32_t const i : objects) {
        work.triangles += casters_.triangles(i);
        if (i < casters_.first_posed()) resting_places_.push_back(i);
        else posed_places_.push_back(i - static_cast<std::uint32_t>(casters_.first_posed()));
    }
    work.batches += objects.size();
    if (!resting_places_.empty() || layer.load == backend::Load::clear) {
        layer.draws = resting_places_;
        work.draw_calls += verbs(verbs.device().draw_ortho(casters_.resting_list(), target, {&layer, 1})).draw_calls;
        layer.load = backend::Load::keep;
    }
    if (posed_places_.empty()) return;
    layer.draws = posed_places_;
    work.draw_calls += verbs(verbs.device().draw_ortho(casters_.posed_list(), target, {&layer, 1})).draw_calls;
}

void CascadeShadows::tell_changes(Map& map, cascade::CascadePlan const& plan) {
    if (auto const event = event_of(plan.update.reason)) map.cached.notify(*event);
    bool const holds = cache::holds_image(map.cached.state());
    if (shape_.reuse == CascadeReuse::still && holds && map.cached.volume() != to_cache(plan.volume))
        map.cached.notify(cache::MapEvent::projection_changed);
}

void CascadeShadows::plan(Map& map, std::uint32_t k) {
    cache::Volume const volume = to_cache(frame_.cascades[k].volume);
    if (shape_.reuse != CascadeReuse::none) {
        tell_changes(map, frame_.cascades[k]);
        map.plan = map.cached.plan(volume, map.objects);
        return;
    }
    map.all.clear();
    for (std::uint32_t i = 0; i < map.objects.size(); ++i)
        if (map.objects[i].state != cache::ObjectState::absent && cache::may_touch(map.objects[i].box, volume)) map.all.push_back(i);
    map.plan = {};
    map.plan.actives = map.all;
}

void CascadeShadows::follow(Verbs& verbs, Frame const& frame, CascadeOptions const& options, core::ExecutorRef executor) {
    options_ = options;
    options_.cascades.anchor_m = frame.geometry->origin_m;
    fit_targets(verbs, options_);
    if (!casters_.follow(verbs, frame, options_.casters, ++tick_, executor)) return;
    for (Map& map : maps_) {
        // Its members' ids are other objects' now.
        if (cache::holds_image(map.cached.state())) map.cached.notify(cache::MapEvent::content_lost);
        map.objects.clear();
    }
}

Result<core::Done> CascadeShadows::prepare(Frame const& frame) {
    auto planned = cascade::plan(cascades_, options_.cascades, frame.view);
    if (!planned) return core::Failure{Error::bad_view, planned.failure().message};
    frame_ = *planned;
    work_ = {};
    for (std::uint32_t k = 0; k < frame_.count; ++k) {
        fit_objects(maps_[k], k, frame.geometry->positions);
        plan(maps_[k], k);
        work_[k].reason = maps_[k].plan.reason;
    }
    return core::Done{};
}

void CascadeShadows::scroll(Verbs& verbs, std::uint32_t k) {
    Map& map = maps_[k];
    if (map.plan.action != cache::MapAction::scroll) return;
    bool const narrow = shape_.format == backend::DepthFormat::unorm16;
    cache::Shift const& shift = map.plan.shift;
    cascade::MapScroll const move{{shift.x, shift.y, shift.z}, narrow ? cascade::unorm16_codes : cascade::float_codes, shape_.depth};
    auto const constants = cascade::shader_scroll(move, shape_.size_px.x, narrow);
    std::array const from{backend::TargetBinding{map.content[map.shown].get(), backend::Plane::depth}};
    verbs(verbs.device().write_depth(scroll_depth_kernel, {.to = map.content[1 - map.shown].get(),
                                                           .rect = {0, 0, shape_.size_px.x, shape_.size_px.y},
                                                           .targets = from,
                                                           .constants = backend::bytes_of(constants)}));
    map.shown = 1 - map.shown;
    work_[k].texels_scrolled += texels(frame_.cascades[k].volume);
}

void CascadeShadows::draw_statics(Verbs& verbs, Frame const& frame, std::uint32_t k) {
    Map& map = maps_[k];
    backend::OrthoLayer layer = layer_of(frame, k);
    bool const anew = map.plan.action == cache::MapAction::redraw;
    layer.load = anew ? backend::Load::clear : backend::Load::keep;
    work_[k].texels_cleared += anew ? texels(frame_.cascades[k].volume) : 0;
    backend::TargetId const content = map.content[map.shown].get();
    cache::Plan const& plan = map.plan;
    places_.clear();
    for (std::size_t i = 0; i < plan.statics.size(); ++i)
        if (plan.beside[i] == 0) places_.push_back(plan.statics[i]);
    draw_objects(verbs, content, layer, places_, work_[k]);
    // The others only where the map had nothing to keep.
    layer.load = backend::Load::keep;
    cascade::ExposedRects const exposed = cascade::exposed_by({plan.shift.x, plan.shift.y, 0}, shape_.size_px.x);
    for (std::int32_t i = 0; i < exposed.count; ++i) {
        cascade::TexelRect const& strip = exposed.rects[static_cast<std::size_t>(i)];
        layer.scissor = backend::Rect{strip.x, strip.y, strip.width, strip.height};
        cache::TexelRect const shown{plan.volume.x + strip.x, plan.volume.y + strip.y, plan.volume.x + strip.x + strip.width,
                                     plan.volume.y + strip.y + strip.height};
        places_.clear();
        for (std::size_t s = 0; s < plan.statics.size(); ++s)
            if (plan.beside[s] != 0 && !cache::is_empty(cache::intersection(cache::rect_of(map.objects[plan.statics[s]].box), shown)))
                places_.push_back(plan.statics[s]);
        draw_objects(verbs, content, layer, places_, work_[k]);
    }
}

void CascadeShadows::draw_actives(Verbs& verbs, Frame const& frame, std::uint32_t k) {
    Map& map = maps_[k];
    cascade::Volume const& volume = frame_.cascades[k].volume;
    backend::OrthoLayer layer = layer_of(frame, k);
    layer.layer = k;
    bool const cached = shape_.reuse != CascadeReuse::none;
    if (cached && map.plan.compose != cache::Compose::keep) {
        cache::TexelRect const& part = map.plan.copied;
        backend::Rect const rect{static_cast<std::int32_t>(part.x0 - volume.at.x), static_cast<std::int32_t>(part.y0 - volume.at.y),
                                 static_cast<std::int32_t>(part.x1 - part.x0), static_cast<std::int32_t>(part.y1 - part.y0)};
        verbs(verbs.device().copy({map.content[map.shown].get(), 0, backend::Plane::depth, rect}, working_.get(), k,
                                  math::ivec2(rect.x, rect.y)));
        work_[k].texels_copied += static_cast<std::uint64_t>(rect.width) * static_cast<std::uint64_t>(rect.height);
    }
    layer.load = cached ? backend::Load::keep : backend::Load::clear;
    work_[k].texels_cleared += cached ? 0 : texels(volume);
    draw_objects(verbs, working_.get(), layer, map.plan.actives, work_[k]);
}

void CascadeShadows::note_kept(Verbs& verbs, std::vector<MapSteps>& steps) {
    verbs.device().stage("");
    steps.assign(frame_.count, {});
    for (std::uint32_t k = 0; k < frame_.count; ++k) {
        Map const& map = maps_[k];
        bool const keeps = shape_.reuse != CascadeReuse::none && map.plan.action != cache::MapAction::redraw;
        std::int32_t const size = shape_.size_px.x;
        steps[k].exposed = keeps ? cascade::exposed_by({map.plan.shift.x, map.plan.shift.y, 0}, size) : all_exposed(size);
        if (keeps) note(verbs, map.content[map.shown].get(), 0, format(), steps[k].kept);
    }
}

void CascadeShadows::note_drawn(Verbs& verbs, std::vector<MapSteps>& steps) {
    verbs.device().stage("");
    for (std::uint32_t k = 0; k < frame_.count; ++k) {
        if (shape_.reuse != CascadeReuse::none) note(verbs, maps_[k].content[maps_[k].shown].get(), 0, format(), steps[k].content);
        note(verbs, working_.get(), k, format(), steps[k].finished);
    }
}

void CascadeShadows::draw(Verbs& verbs, Frame const& frame, std::vector<MapSteps>* steps) {
    bool const cached = shape_.reuse != CascadeReuse::none;
    if (shape_.reuse == CascadeReuse::scroll) verbs.device().stage("scroll");
    for (std::uint32_t k = 0; k < frame_.count && cached; ++k) scroll(verbs, k);
    if (steps != nullptr) note_kept(verbs, *steps);
    if (cached) verbs.device().stage("static");
    for (std::uint32_t k = 0; k < frame_.count && cached; ++k) draw_statics(verbs, frame, k);
    verbs.device().stage(cached ? "active" : "depth_pass");
    for (std::uint32_t k = 0; k < frame_.count; ++k) {
        draw_actives(verbs, frame, k);
        if (cached) maps_[k].cached.commit();
    }
    if (steps != nullptr) note_drawn(verbs, *steps);
    cascade::commit(cascades_, frame_);
}

}  // namespace gnomon::pipeline
