#include "plan.hpp"

#include "values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace gnomon::command {

namespace {

constexpr std::size_t most_runs = 256;

using Settings = std::vector<pipeline::Setting>;

/// Lower-case letters, digits, dots and hyphens; safe as a file name anywhere.
std::string slug_from(std::string const& label) {
    std::string slug;
    for (char const c : label) {
        bool const plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '-';
        slug += plain ? c : '-';
    }
    return slug;
}

/// All combinations of the values that `params` lists for `technique`.
std::vector<Settings> combinations(std::string const& technique, std::vector<ParamOption> const& params) {
    std::vector<Settings> all(1);
    for (ParamOption const& param : params) {
        if (param.technique != technique) continue;
        std::vector<Settings> longer;
        for (Settings const& settings : all)
            for (std::string const& value : param.values) {
                longer.push_back(settings);
                longer.back().push_back({param.name, value});
                if (longer.size() > most_runs) return longer;
            }
        all = std::move(longer);
    }
    return all;
}

bool same_run(PlannedRun const& a, PlannedRun const& b) {
    auto const equal = [](pipeline::Params::Value const& x, pipeline::Params::Value const& y) {
        return x.text == y.text;
    };
    return a.technique == b.technique && a.lighting == b.lighting && a.backend == b.backend && std::equal(a.params.values.begin(), a.params.values.end(),
                                                    b.params.values.begin(), b.params.values.end(), equal);
}

/// A technique of either kind, or neither.
struct AnyTechnique {
    pipeline::Technique const* shadows = nullptr;
    pipeline::LightingTechnique const* lighting = nullptr;
};

template <class Techniques>
std::string names_in(Techniques const& techniques) {
    std::vector<std::string> names;
    for (auto const& technique : techniques) names.emplace_back(technique.name);
    return join(names, ", ");
}

Outcome<AnyTechnique> find_any(std::string const& option, std::string const& name) {
    if (auto shadows = pipeline::find_technique(name)) return AnyTechnique{*shadows, nullptr};
    if (auto lighting = pipeline::find_lighting_technique(name)) return AnyTechnique{nullptr, *lighting};
    return usage_error(fmt::format("{}: there is no technique '{}'; there are, for shadows, {}; for many lights, {}", option, name,
                                   names_in(pipeline::techniques()), names_in(pipeline::lighting_techniques())));
}

Outcome<PlannedRun> plan_run(std::string const& name, Settings const& settings) {
    auto const technique = find_any("--techniques", name);
    if (!technique) return technique.failure();
    auto params = technique->shadows != nullptr ? pipeline::make_params(*technique->shadows, settings)
                                                : pipeline::make_params(*technique->lighting, settings);
    if (!params) return usage_error("--param: " + params.failure().message);
    PlannedRun run{technique->shadows, technique->lighting, *std::move(params), {}, name, {}};
    for (pipeline::Setting const& setting : settings) run.label += fmt::format(" {}={}", setting.name, setting.text);
    return run;
}

/// Adds the run once for each backend.
Outcome<core::Done> add_on_each(std::vector<std::string> const& backends, PlannedRun const& run,
                                std::vector<PlannedRun>& runs) {
    for (std::string const& backend : backends) {
        PlannedRun placed = run;
        placed.backend = backend;
        if (backends.size() > 1) placed.label += " on " + backend;
        placed.slug = slug_from(placed.label);
        for (PlannedRun const& other : runs)
            if (same_run(other, placed))
                return usage_error(fmt::format("{}: this run is asked for twice; leave one out", placed.label));
        runs.push_back(std::move(placed));
    }
    if (runs.size() > most_runs)
        return usage_error(fmt::format("--param: the lists make more than {} runs; shorten them", most_runs));
    return core::Done{};
}

Outcome<core::Done> check_names(std::vector<std::string> const& techniques, std::vector<ParamOption> const& params) {
    std::string shadows, lighting;
    for (std::string const& name : techniques) {
        auto const found = find_any("--techniques", name);
        if (!found) return found.failure();
        (found->shadows != nullptr ? shadows : lighting) = name;
    }
    if (!shadows.empty() && !lighting.empty())
        return usage_error(fmt::format("--techniques {},{}: the first draws the shadows of one light, the second shades under many; "
                                       "give them to two commands",
                                       shadows, lighting));
    for (std::size_t i = 0; i < params.size(); ++i) {
        ParamOption const& param = params[i];
        std::string const whole = fmt::format("--param {}.{}", param.technique, param.name);
        if (auto found = find_any(whole, param.technique); !found) return found.failure();
        if (std::find(techniques.begin(), techniques.end(), param.technique) == techniques.end())
            return usage_error(fmt::format("{}: {} is not among the techniques to run; add it to --techniques {}",
                                           whole, param.technique, join(techniques, ",")));
        for (std::size_t j = 0; j < i; ++j)
            if (params[j].technique == param.technique && params[j].name == param.name)
                return usage_error(fmt::format("{}: given twice; put all its values into one list", whole));
    }
    return core::Done{};
}

}  // namespace

Outcome<std::vector<PlannedRun>> plan_runs(RunOptions const& options) {
    if (auto names = check_names(options.techniques, options.params); !names) return std::move(names).failure();
    std::vector<PlannedRun> runs;
    for (std::string const& name : options.techniques) {
        for (Settings const& settings : combinations(name, options.params)) {
            auto run = plan_run(name, settings);
            if (!run) return std::move(run).failure();
            if (auto added = add_on_each(options.backends, *run, runs); !added) return std::move(added).failure();
        }
    }
    return runs;
}

bool lights_many(std::vector<PlannedRun> const& plan) noexcept { return !plan.empty() && plan.front().lighting != nullptr; }

}  // namespace gnomon::command
