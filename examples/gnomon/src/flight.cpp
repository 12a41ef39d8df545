// `flythrough`, and `render` and `compare` along a path: frame after frame, then one report over all of them.

#include "verbs.hpp"

#include "film.hpp"
#include "flight_page.hpp"
#include "json.hpp"
#include "progress.hpp"
#include "table.hpp"
#include "walk.hpp"

#include <gnomon/core/executor_tbb.hpp>
#include <gnomon/pipeline.hpp>

#include <fmt/format.h>

#include <memory>
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
        case Verb::bench: return {false, false};
        case Verb::flythrough: break;
    }
    return {true, true};
}

/// The films of one run as they grow.
struct RunFilms {
    Film lit;
    Film wrong;
};

/// A film of one of a run's debug pictures.
struct DebugFilm {
    std::string name;
    std::string caption;
    Film film;
};

/// A walk whose frames become pictures and films.
class Flight {
  public:
    Flight(RunOptions const& options, std::vector<PlannedRun> const& plan, FolderWriter& folder,
           core::ExecutorRef executor)
        : options_(options), plan_(plan), folder_(folder), executor_(executor), made_(products_of(options.verb)),
          walk_(options, plan, executor) {}

    Outcome<core::Done> prepare() {
        if (auto ready = walk_.prepare(); !ready) return ready;
        FilmConfig const film{options_.view.size_px, walk_.rate_hz()};
        exact_ = std::make_unique<Film>(film);
        for (std::size_t i = 0; i < plan_.size(); ++i) films_.push_back({Film(film), Film(film)});
        return core::Done{};
    }

    [[nodiscard]] int frames() const noexcept { return walk_.frames(); }

    Outcome<core::Done> fly(int frame) {
        auto compared = walk_.step(frame, made_.pictures || made_.films);
        if (!compared) return std::move(compared).failure();
        if (auto kept = keep(frame, *compared); !kept) return kept;
        return keep_debug(frame, *compared);
    }

    Outcome<core::Done> land() {
        walk_.finish();
        FlightFilms films;
        if (made_.films)
            if (auto written = write_films(films); !written) return written;
        if (auto written = write_debug(films); !written) return written;
        if (auto csv = folder_.add("frames.csv", bytes_of(frames_csv(report()))); !csv) return csv;
        if (options_.verb != Verb::render)
            if (auto page = folder_.add("index.html", bytes_of(flight_page_html(report(), films))); !page) return page;
        std::vector<std::string> names = folder_.names();
        names.emplace_back("results.json");
        results_ = bytes_of(json_text(report(), names));
        return folder_.add("results.json", results_);
    }

    [[nodiscard]] Report const& report() const noexcept { return walk_.report(); }
    [[nodiscard]] Bytes const& results() const noexcept { return results_; }

  private:
    /// Wrong pixels need the truth; lighting computations do not.
    [[nodiscard]] bool has_overlay() const noexcept { return options_.truth || report().many_lights; }

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
                    films.wrong.add(report().many_lights ? picture_of(run.overlay) : thickened(picture_of(run.overlay)));
            }
        });
        for (std::size_t i = 0; i < runs && made_.pictures; ++i)
            if (auto added = folder_.add(fmt::format("{}.{:04}.png", plan_[i].slug, frame), pngs[i]); !added)
                return added;
        return core::Done{};
    }

    /// The same of what shows how the runs got there.
    Outcome<core::Done> keep_debug(int frame, pipeline::Comparison const& compared) {
        debug_.resize(compared.runs.size());
        for (std::size_t i = 0; i < compared.runs.size(); ++i)
            for (std::size_t k = 0; k < compared.runs[i].pictures.size(); ++k) {
                pipeline::DebugPicture const& picture = compared.runs[i].pictures[k];
                Picture const image = picture_of(picture.image);
                if (k == debug_[i].size())
                    debug_[i].push_back({std::string(picture.name), std::string(picture.caption), Film({image.size_px, walk_.rate_hz()})});
                if (options_.verb != Verb::render) debug_[i][k].film.add(image);
                if (auto added = folder_.add(fmt::format("{}.{}.{:04}.png", plan_[i].slug, picture.name, frame), png_from(image)); !added) return added;
            }
        return core::Done{};
    }

    Outcome<core::Done> write(Film& film, std::string const& name, Bytes& kept) {
        kept = film.finish();
        if (kept.empty())
            return failure(fmt::format("{}: the film cannot be encoded; a side of {}x{} px may be too long for WebP "
                                       "(16383), or memory ran out",
                                       name, report().size_px.x, report().size_px.y));
        return folder_.add(name, kept);
    }

    Outcome<core::Done> write_debug(FlightFilms& films) {
        films.runs.resize(plan_.size());
        for (std::size_t i = 0; i < debug_.size() && options_.verb != Verb::render; ++i)
            for (DebugFilm& debug : debug_[i]) {
                films.runs[i].debug.push_back({debug.name, debug.caption, {}});
                if (auto written = write(debug.film, fmt::format("{}.{}.webp", plan_[i].slug, debug.name), films.runs[i].debug.back().file); !written) return written;
            }
        return core::Done{};
    }

    Outcome<core::Done> write_films(FlightFilms& films) {
        if (options_.truth)
            if (auto exact = write(*exact_, "reference.webp", films.exact); !exact) return exact;
        films.runs.resize(plan_.size());
        films.has_runs = true;
        for (std::size_t i = 0; i < plan_.size(); ++i) {
            if (auto lit = write(films_[i].lit, plan_[i].slug + ".webp", films.runs[i].lit); !lit) return lit;
            if (!has_overlay()) continue;
            std::string const name = plan_[i].slug + (report().many_lights ? ".lights.webp" : ".wrong.webp");
            if (auto wrong = write(films_[i].wrong, name, films.runs[i].marks); !wrong) return wrong;
        }
        return core::Done{};
    }

    RunOptions const& options_;
    std::vector<PlannedRun> const& plan_;
    FolderWriter& folder_;
    core::ExecutorRef executor_;
    Products made_;
    Walk walk_;
    std::vector<RunFilms> films_;
    std::vector<std::vector<DebugFilm>> debug_;  ///< Of each run.
    std::unique_ptr<Film> exact_;
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
