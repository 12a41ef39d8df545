#include "json.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace gnomon::command {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json ms_json(pipeline::RunReport const& run) {
    Json stages = Json::object();
    for (pipeline::StageTime const& stage : run.stages) stages[std::string(stage.name)] = number(stage.ms);
    return {{"median", number(run.ms.median)},
            {"min", number(run.ms.min)},
            {"max", number(run.ms.max)},
            {"stages", stages}};
}

Json lighting_error_json(pipeline::Measures const& error) {
    return {{"samples", error.samples},
            {"wrong", error.wrong},
            {"wrong_fraction", number(error.wrong_fraction)},
            {"radiance_error", number(error.radiance_error)}};
}

Json error_json(pipeline::Measures const& error) {
    Json const edge = {
        {"mean", number(error.edge_px.mean)}, {"p99", number(error.edge_px.p99)}, {"max", number(error.edge_px.max)}};
    return {{"samples", error.samples},
            {"wrong", error.wrong},
            {"wrong_fraction", number(error.wrong_fraction)},
            {"false_lit", error.false_lit},
            {"false_shadow", error.false_shadow},
            {"acne", error.acne},
            {"detachment", error.detachment},
            {"edge_px", edge},
            {"visibility_error",
             {{"mean", number(error.visibility_error_mean)}, {"p99", number(error.visibility_error_p99)}}},
            {"radiance_error", number(error.radiance_error)}};
}

Json counts_json(std::vector<pipeline::Count> const& counts) {
    Json object = Json::object();
    for (pipeline::Count const& count : counts) object[std::string(count.name)] = count.value;
    return object;
}

Json params_json(std::vector<pipeline::Params::Value> const& params) {
    Json object = Json::object();
    for (pipeline::Params::Value const& value : params) {
        Json& field = object[std::string(value.name)];
        switch (value.kind) {
            case pipeline::ParamKind::integer: field = static_cast<std::int64_t>(value.number); break;
            case pipeline::ParamKind::real: field = number(value.number); break;
            case pipeline::ParamKind::choice: field = value.text; break;
        }
    }
    return object;
}

/// What went wrong is not known without the truth: then there is no error at all.
Json error_or_null(Report const& report, pipeline::Measures const& error) {
    if (!report.has_truth) return nullptr;
    return report.many_lights ? lighting_error_json(error) : error_json(error);
}

Json frame_json(Report const& report, FrameRecord const& frame) {
    Json json = {{"frame", frame.frame},
                 {"time_s", number(frame.time_s)},
                 {"ms", number(frame.ms)},
                 {"error", error_or_null(report, frame.error)},
                 {"counts", counts_json(frame.counts)}};
    if (!frame.redraw_reasons.empty()) json["redraw_reasons"] = counts_json(frame.redraw_reasons);
    return json;
}

Json run_json(Report const& report, Run const& run) {
    Json json = {{"scene", report.scene},
            {"view", report.view},
            {"light", report.light},
            {"backend", run.result.backend},
            {"device", run.device},
            {"threads", report.threads},
            {"technique", run.result.technique},
            {"params", params_json(run.result.params)},
            {"ms", ms_json(run.result)},
            {"error", error_or_null(report, run.result.error)},
            {"counts", counts_json(run.result.counts)},
            {"bytes", counts_json(run.result.bytes)}};
    if (!run.result.redraw_reasons.empty()) json["redraw_reasons"] = counts_json(run.result.redraw_reasons);
    for (double const texel_m : run.result.map_texel_m) json["map_texel_m"].push_back(number(texel_m));
    for (FrameRecord const& frame : run.frames) json["frames"].push_back(frame_json(report, frame));
    return json;
}

}  // namespace

std::string json_text(Report const& report, std::vector<std::string> const& files) {
    return json_text(std::vector<Report const*>{&report}, files);
}

std::string json_text(std::vector<Report const*> const& reports, std::vector<std::string> const& files) {
    Report const& report = *reports.front();
    Machine const& machine = report.machine;
    Json document = {{"gnomon", {{"version", GNOMON_VERSION}, {"command", report.command}, {"files", files}}},
                     {"machine",
                      {{"cpu", machine.cpu},
                       {"logical_cores", machine.logical_cores},
                       {"simd", machine.simd},
                       {"system", machine.system},
                       {"compiler", machine.compiler},
                       {"build", machine.build}}},
                     {"runs", Json::array()}};
    for (Report const* const each : reports)
        for (Run const& run : each->runs) document["runs"].push_back(run_json(*each, run));
    // File and camera names may hold any bytes: what is not UTF-8 is replaced, never thrown over.
    return document.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::vector<std::string> files_listed_in(std::string const& text) {
    Json const document = Json::parse(text, nullptr, false);
    std::vector<std::string> files;
    if (!document.is_object() || !document.contains("gnomon") || !document["gnomon"].is_object()) return files;
    Json const listed = document["gnomon"].value("files", Json::array());
    for (Json const& file : listed)
        if (file.is_string()) files.push_back(file.get<std::string>());
    return files;
}

}  // namespace gnomon::command
