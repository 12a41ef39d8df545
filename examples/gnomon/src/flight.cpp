// `flythrough`, and `render` and `compare` along a path: frame after frame, then one report over all of them.

#include "verbs.hpp"

#include "film.hpp"
#include "flight_page.hpp"
#include "json.hpp"
#include "progress.hpp"
#include "run_parts.hpp"
#include "table.hpp"

#include <gnomon/core/executor_tbb.hpp>
#include <gnomon/pipeline.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace gnomon::command {

namespace {

/// What each frame leaves behind beside its numbers.
struct Products {
    bool pictures = false;  ///< A PNG of each frame and run.
    bool films = false;
};

Products products_of(Verb verb) {
    switch (verb) {
        case Verb::render: return {true, false};
        case Verb::compare: return {false, false};
        case Verb::flythrough: break;
    }
    return {true, true};
}

/// The films of one run as they grow.
struct RunFilms {
    Film lit;
    Film wrong;
};

/// Everything that goes on from frame to frame.
class Flight {
  public:
    Flight(RunOptions const& options, std::vector<PlannedRun> const& plan, FolderWriter& folder,
           core::ExecutorRef executor)
        : options_(options), plan_(plan), folder_(folder), executor_(executor), made_(products_of(options.verb)) {}

    Outcome<core::Done> prepare() {
        auto backends = Backends::open(options_, executor_);
        if (!backends) return std::move(backends).failure();
        backends_ = *std::move(backends);
        auto stage = set_stage(options_.scene, options_.motion);
        if (!stage) return std::move(stage).failure();
        stage_ = *std::move(stage);
        auto journey = choose_journey(options_, stage_);
        if (!journey) return std::move(journey).failure();
        journey_ = *std::move(journey);
        move_to(stage_, options_.motion.time_s);
        auto light = choose_lighting(options_, plan_, stage_, journey_.views.front());
        if (!light) return std::move(light).failure();
        light_ = *std::move(light);
        report_ = start_report(options_, stage_);
        report_.many_lights = lights_many(plan_);
        report_.light = light_.text();
        report_.view = journey_.text + stage_.text();
        report_.frames = journey_.views.size();
        FilmConfig const film{report_.size_px, journey_.rate_hz};
        exact_ = std::make_unique<Film>(film);
        for (std::size_t i = 0; i < plan_.size(); ++i) {
            films_.push_back({Film(film), Film(film)});
            workspaces_.push_back(std::make_unique<pipeline::Workspace>());
            report_.runs.push_back(run_of(plan_[i], backends_));
        }
        requests_.emplace(plan_, backends_, workspaces_);
        return core::Done{};
    }

    [[nodiscard]] int frames() const noexcept { return static_cast<int>(journey_.views.size()); }

    Outcome<core::Done> fly(int frame) {
        double const time_s = options_.motion.time_s + frame / journey_.rate_hz;
        bool const moved = stage_.moves() && frame > 0;
        if (moved) move_to(stage_, time_s);
        light_.move_to(stage_);
        pipeline::Shot const shot{journey_.views[static_cast<std::size_t>(frame)], light_.for_frame(),
                                  options_.truth && !report_.many_lights, frame_ && !moved ? &*frame_ : nullptr};
        auto next = pipeline::make_frame(stage_.loaded.scene, stage_.geometry, shot, executor_);
        if (!next) return exit_for(next.failure());
        frame_ = *std::move(next);
        pipeline::CompareConfig config;
        config.repeats = options_.repeats;
        config.images = made_.pictures || made_.films;
        config.truth = options_.truth;
        config.shading.exposure = exposure_;
        config.heat_most = report_.heat_most;
        auto compared = requests_->compare(*frame_, light_, config, executor_);
        if (!compared) return std::move(compared).failure();
        exposure_ = compared->exposure;  // One for the whole film: it must not flicker.
        report_.heat_most = compared->heat_most;
        record(frame, time_s, *compared);
        return keep(frame, *compared);
    }

    Outcome<core::Done> land() {
        report_.truth_ms = truth_build_ms_ + (truth_ms_.empty() ? 0.0 : truth_ms_[truth_ms_.size() / 2]);
        for (std::size_t i = 0; i < plan_.size(); ++i)
            report_.runs[i].result = total_of(report_.runs[i].frames, report_.runs[i].result);
        add_facts(report_, stage_, light_, *frame_);
        FlightFilms films;
        if (made_.films)
            if (auto written = write_films(films); !written) return written;
        if (auto csv = folder_.add("frames.csv", bytes_of(frames_csv(report_))); !csv) return csv;
        if (options_.verb != Verb::render)
            if (auto page = folder_.add("index.html", bytes_of(flight_page_html(report_, films))); !page) return page;
        std::vector<std::string> names = folder_.names();
        names.emplace_back("results.json");
        results_ = bytes_of(json_text(report_, names));
        return folder_.add("results.json", results_);
    }

    [[nodiscard]] Report const& report() const noexcept { return report_; }
    [[nodiscard]] Bytes const& results() const noexcept { return results_; }

  private:
    /// Wrong pixels need the truth; lighting computations do not.
    [[nodiscard]] bool has_overlay() const noexcept { return options_.truth || report_.many_lights; }

    void record(int frame, double time_s, pipeline::Comparison const& compared) {
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
            report_.runs[i].frames.push_back({static_cast<std::uint32_t>(frame), time_s, run.ms.median, run.stages,
                                              run.error, run.counts});
            if (frame > 0) continue;
            pipeline::RunReport& first = report_.runs[i].result;
            first = run;
            first.lit = {};
            first.overlay = {};
        }
    }

    /// Adds the frame's pictures to the films and the folder. Films and PNG files are compressed side by side.
    Outcome<core::Done> keep(int frame, pipeline::Comparison const& compared) {
        std::size_t const runs = compared.runs.size();
        std::vector<Bytes> pngs(runs);
        executor_.parallel_for(runs * 3 + 1, 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t job = begin; job < end; ++job) {
                if (job == runs * 3) {
                    if (made_.films && options_.truth) exact_->add(picture_of(compared.exact));
                    continue;
                }
                pipeline::RunReport const& run = compared.runs[job / 3];
                RunFilms& films = films_[job / 3];
                if (job % 3 == 0 && made_.pictures) pngs[job / 3] = png_from(picture_of(run.lit));
                if (job % 3 == 1 && made_.films) films.lit.add(picture_of(run.lit));
                if (job % 3 == 2 && made_.films && has_overlay())
                    films.wrong.add(report_.many_lights ? picture_of(run.overlay) : thickened(picture_of(run.overlay)));
            }
        });
        for (std::size_t i = 0; i < runs && made_.pictures; ++i)
            if (auto added = folder_.add(fmt::format("{}.{:04}.png", plan_[i].slug, frame), pngs[i]); !added)
                return added;
        return core::Done{};
    }

    Outcome<core::Done> write_films(FlightFilms& films) {
        auto const write = [&](Film& film, std::string const& name, Bytes& kept) -> Outcome<core::Done> {
            kept = film.finish();
            if (kept.empty())
                return failure(fmt::format("{}: the film cannot be encoded; a side of {}x{} px may be too long for WebP "
                                           "(16383), or memory ran out",
                                           name, report_.size_px.x, report_.size_px.y));
            return folder_.add(name, kept);
        };
        if (options_.truth)
            if (auto exact = write(*exact_, "reference.webp", films.exact); !exact) return exact;
        films.runs.resize(plan_.size());
        for (std::size_t i = 0; i < plan_.size(); ++i) {
            if (auto lit = write(films_[i].lit, plan_[i].slug + ".webp", films.runs[i].lit); !lit) return lit;
            if (!has_overlay()) continue;
            std::string const name = plan_[i].slug + (report_.many_lights ? ".lights.webp" : ".wrong.webp");
            if (auto wrong = write(films_[i].wrong, name, films.runs[i].marks); !wrong) return wrong;
        }
        return core::Done{};
    }

    RunOptions const& options_;
    std::vector<PlannedRun> const& plan_;
    FolderWriter& folder_;
    core::ExecutorRef executor_;
    Products made_;
    Backends backends_;
    Stage stage_;
    Journey journey_;
    Lighting light_;
    std::optional<pipeline::Frame> frame_;
    std::vector<std::unique_ptr<pipeline::Workspace>> workspaces_;
    std::optional<Requests> requests_;
    std::vector<RunFilms> films_;
    std::unique_ptr<Film> exact_;
    float exposure_ = 0.0F;
    double truth_build_ms_ = 0.0;
    std::vector<double> truth_ms_;
    Report report_;
    Bytes results_;
};

}  // namespace

Outcome<core::Done> fly(RunOptions const& options) {
    auto plan = plan_runs(options);
    if (!plan) return std::move(plan).failure();
    if (auto outputs = check_outputs(options); !outputs) return outputs;
    auto folder = FolderWriter::begin(out_folder(options));
    if (!folder) return std::move(folder).failure();
    core::TbbExecutor executor(options.threads);
    ProgressBar bar(is_terminal(2));
    bar.show(0, 1, "reading " + options.scene.config.name);
    Flight flight(options, *plan, *folder, executor);
    if (auto ready = flight.prepare(); !ready) return ready;
    for (int frame = 0; frame < flight.frames(); ++frame) {
        bar.show(frame, flight.frames() + 1, fmt::format("frame {}", frame));
        if (auto flown = flight.fly(frame); !flown) return flown;
    }
    bar.show(flight.frames(), flight.frames() + 1, "writing " + out_folder(options));
    if (auto landed = flight.land(); !landed) return landed;
    if (auto there = folder->commit(); !there) return there;
    bar.clear();
    std::string const where = out_folder(options) + (options.verb == Verb::render ? "/" : "/index.html");
    bool const styled = is_terminal(options.json == "-" ? 2 : 1);
    return conclude(options, flight.results(), table_text(flight.report(), styled) + "\nwritten: " + where + '\n');
}

}  // namespace gnomon::command
