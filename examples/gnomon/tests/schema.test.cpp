#include "schema.hpp"

#include "json.hpp"
#include "process.hpp"

#include <gnomon/check/check.hpp>

#include <limits>

using namespace gnomon::command;
using nlohmann::json;

namespace {

schema::Validator validator() { return schema::Validator(json::parse(read_text(GNOMON_SCHEMA))); }

/// A report with one run that has everything in it.
Report small_report() {
    Report report;
    report.command = "gnomon compare city";
    report.scene = "city";
    report.view = "--camera air --size 4x4";
    report.light = "--sun 0,-1,0";
    report.machine = this_machine();
    Run run{"ray", "ray", "a processor", {}, {}};
    run.result.technique = "ray";
    run.result.backend = "cpu";
    run.result.params = {{"resolution", "512", 512.0, gnomon::pipeline::ParamKind::integer},
                         {"bias", "0.25", 0.25, gnomon::pipeline::ParamKind::real},
                         {"mode", "auto", 0.0, gnomon::pipeline::ParamKind::choice}};
    run.result.stages = {{"trace", 1.5}};
    run.result.counts = {{"triangles_drawn", 12}};
    run.result.bytes = {{"depth", 1024}};
    report.runs.push_back(run);
    return report;
}

json valid_document() { return json::parse(json_text(small_report(), {"index.html", "results.json"})); }

}  // namespace

TEST_CASE("what the writer writes is what the schema says", "[schema]") {
    json const document = valid_document();
    auto const errors = validator().errors(document);
    CAPTURE(errors.empty() ? std::string() : errors.front());
    CHECK(errors.empty());
    json const params = document["runs"][0]["params"];
    CHECK(params["resolution"].is_number_integer());
    CHECK(params["bias"] == 0.25);
    CHECK(params["mode"] == "auto");
}

TEST_CASE("a distance that does not exist is null, never Infinity or NaN", "[schema]") {
    Report report = small_report();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    report.runs[0].result.error.edge_px = {infinite, infinite, std::numeric_limits<double>::quiet_NaN()};
    json const document = json::parse(json_text(report, {}));
    json const edge = document["runs"][0]["error"]["edge_px"];
    CHECK(edge["mean"].is_null());
    CHECK(edge["p99"].is_null());
    CHECK(edge["max"].is_null());
    CHECK(validator().errors(document).empty());
}

TEST_CASE("names that are not UTF-8 still give a document", "[schema]") {
    Report report = small_report();
    report.scene = "a\xff\xfe.glb";
    CHECK(validator().errors(json::parse(json_text(report, {}))).empty());
}

TEST_CASE("each way of breaking the document is noticed", "[schema]") {
    schema::Validator rules = validator();
    auto const notices = [&](auto damage) {
        json document = valid_document();
        damage(document);
        return !rules.errors(document).empty();
    };
    CHECK(notices([](json& d) { d.erase("machine"); }));
    CHECK(notices([](json& d) { d["extra"] = 1; }));
    CHECK(notices([](json& d) { d["runs"] = json::object(); }));
    CHECK(notices([](json& d) { d["runs"][0].erase("error"); }));
    CHECK(notices([](json& d) { d["runs"][0]["backend"] = "gpu"; }));
    CHECK(notices([](json& d) { d["runs"][0].erase("device"); }));
    CHECK(notices([](json& d) { d["runs"][0]["threads"] = 0; }));
    CHECK(notices([](json& d) { d["runs"][0]["threads"] = 1.5; }));
    CHECK(notices([](json& d) { d["runs"][0]["threads"] = "2"; }));
    CHECK(notices([](json& d) { d["runs"][0]["scene"] = ""; }));
    CHECK(notices([](json& d) { d["runs"][0]["error"]["wrong_fraction"] = 1.5; }));
    CHECK(notices([](json& d) { d["runs"][0]["error"]["wrong_fraction"] = nullptr; }));
    CHECK(notices([](json& d) { d["runs"][0]["error"]["wrong"] = -1; }));
    CHECK(notices([](json& d) { d["runs"][0]["ms"]["stages"]["trace"] = -0.5; }));
    CHECK(notices([](json& d) { d["runs"][0]["params"]["mode"] = nullptr; }));
    CHECK(notices([](json& d) { d["gnomon"]["files"] = json::array({1}); }));
    CHECK(notices([](json& d) { d = json::array(); }));
    CHECK_FALSE(notices([](json&) {}));
}

TEST_CASE("a keyword that the validator does not know is an error", "[schema]") {
    schema::Validator rules(json::parse(R"({"type": "object", "patternProperties": {}})"));
    CHECK_FALSE(rules.errors(json::object()).empty());
}

TEST_CASE("only a results.json lists files of ours", "[schema]") {
    CHECK(files_listed_in(json_text(small_report(), {"a.png", "results.json"})) ==
          std::vector<std::string>{"a.png", "results.json"});
    for (char const* text :
         {"", "[]", "{}", "{\"gnomon\": 1}", "{\"gnomon\": {\"files\": 3}}", "{\"gnomon\": {\"files\": [1]}}", "{"})
        CHECK(files_listed_in(text).empty());
}
