#include "walk.hpp"

#include <algorithm>
#include <utility>

namespace gnomon::command {

Outcome<core::Done> Walk::prepare() {
    auto backends = Backends::open(options_, executor_);
    if (!backends) return std::move(backends).failure();
    backends_ = *std::move(backends);
    auto stage = set_stage(options_.scene, options_.motion);
    if (!stage) return std::move(stage).failure();
    stage_ = *std::move(stage);
    auto journey = choose_journey(options_, stage_);
    if (!journey) return std::move(journey).failure();
    journey_ = *std::move(journey);
    time_s_ = options_.motion.time_s;
    move_to(stage_, time_s_);
    auto light = choose_lighting(options_, plan_, stage_, journey_.views.front());
    if (!light) return std::move(light).failure();
    light_ = *std::move(light);
    for (std::size_t i = 0; i < plan_.size(); ++i) workspaces_.push_back(std::make_unique<pipeline::Workspace>());
    requests_.emplace(plan_, backends_, workspaces_);
    restart(light_.text());
    return core::Done{};
}

void Walk::stand() { std::fill(journey_.views.begin(), journey_.views.end(), journey_.views.front()); }

void Walk::restart(std::string light) {
    report_ = start_report(options_, stage_);
    report_.many_lights = lights_many(plan_);
    report_.light = std::move(light);
    report_.view = journey_.text + stage_.text();
    report_.frames = 0;
    for (PlannedRun const& planned : plan_) report_.runs.push_back(run_of(planned, backends_));
}

Outcome<pipeline::Comparison> Walk::step(int frame, bool images) {
    double const time_s = options_.motion.time_s + frame / journey_.rate_hz;
    bool const moved = stage_.moves() && time_s != time_s_;
    if (moved) {
        move_to(stage_, time_s);
        time_s_ = time_s;
        light_.move_to(stage_);
    }
    pipeline::Shot const shot{journey_.views[static_cast<std::size_t>(frame)], light_.for_frame(),
                              options_.truth && !report_.many_lights, frame_ && !moved ? &*frame_ : nullptr, light_.rule()};
    auto next = pipeline::make_frame(stage_.loaded.scene, stage_.geometry, shot, executor_);
    if (!next) return exit_for(next.failure());
    frame_ = *std::move(next);
    pipeline::CompareConfig config;
    config.repeats = options_.repeats;
    config.images = images;
    config.debug = options_.debug;
    config.truth = options_.truth;
    config.shading.exposure = exposure_;
    config.heat_most = report_.heat_most;
    auto compared = requests_->compare(*frame_, light_, config, executor_);
    if (!compared) return compared;
    exposure_ = compared->exposure;  // One for the whole film: it must not flicker.
    report_.heat_most = compared->heat_most;
    record(frame, time_s, *compared);
    return compared;
}

void Walk::record(int frame, double time_s, pipeline::Comparison const& compared) {
    bool const first = report_.frames++ == 0;
    report_.samples += compared.samples;
    report_.truly_lit += compared.truly_lit;
    report_.reaching += compared.reaching;
    for (pipeline::StageTime const& stage : frame_->stages) {
        if (stage.name == "truth_trace") truth_ms_.push_back(stage.ms);
        // Taken over from the frame before, it costs nothing there; a frame of its own pays for it.
        if (stage.name == "truth_build") truth_build_ms_ = std::max(truth_build_ms_, stage.ms);
    }
    for (std::size_t i = 0; i < compared.runs.size(); ++i) {
        pipeline::RunReport const& run = compared.runs[i];
        report_.runs[i].frames.push_back(
            {static_cast<std::uint32_t>(frame), time_s, run.ms.median, run.stages, run.error, run.counts, run.redraw_reasons});
        if (!first) continue;
        report_.runs[i].result = run;
        report_.runs[i].result.lit = {};
        report_.runs[i].result.overlay = {};
        report_.runs[i].result.pictures.clear();
    }
}

void Walk::finish() {
    report_.truth_ms = truth_build_ms_ + (truth_ms_.empty() ? 0.0 : truth_ms_[truth_ms_.size() / 2]);
    for (Run& run : report_.runs) run.result = total_of(run.frames, run.result);
    add_facts(report_, stage_, light_, *frame_);
}

}  // namespace gnomon::command
