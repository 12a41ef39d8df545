#include <gnomon/check/check.hpp>
#include <gnomon/pipeline.hpp>

#include <array>
#include <string>
#include <vector>

namespace {

using namespace gnomon;
using pipeline::Error;
using pipeline::Setting;

pipeline::Technique const& technique(std::string_view name) { return **pipeline::find_technique(name); }

std::string refusal(Setting const& setting, Error code) {
    auto const params = pipeline::make_params(technique("shadow-map"), std::array{setting});
    REQUIRE_FALSE(params);
    CHECK(params.failure().code == code);
    return params.failure().message;
}

bool says(std::string const& message, std::string_view word) { return message.find(word) != std::string::npos; }

}  // namespace

TEST_CASE("every technique's defaults are legal and describe themselves", "[pipeline][technique]") {
    for (pipeline::Technique const& t : pipeline::techniques()) {
        CHECK_FALSE(t.summary.empty());
        CHECK(t.run != nullptr);
        auto const params = pipeline::make_params(t);
        REQUIRE(params);
        REQUIRE(params->values.size() == t.params.size());
        for (std::size_t i = 0; i < t.params.size(); ++i) {
            CHECK_FALSE(t.params[i].doc.empty());
            CHECK(params->values[i].name == t.params[i].name);
            // A report's text reads back as the same value.
            std::array const again{Setting{std::string(t.params[i].name), params->values[i].text}};
            CHECK(pipeline::make_params(t, again)->values[i].number == params->values[i].number);
        }
    }
}

TEST_CASE("an unknown technique is refused with the list of those there are", "[pipeline][technique]") {
    auto const found = pipeline::find_technique("shadowmap");
    REQUIRE_FALSE(found);
    CHECK(found.failure().code == Error::unknown_technique);
    for (char const* const word : {"'shadowmap'", "shadow-map", "ray"}) CHECK(says(found.failure().message, word));
}

TEST_CASE("an unknown parameter is refused with the list of those there are", "[pipeline][technique]") {
    std::string const message = refusal({"size", "3"}, Error::unknown_parameter);
    for (char const* const word : {"'size'", "resolution", "pcf", "bias"}) CHECK(says(message, word));
    auto const none = pipeline::make_params(technique("ray"), std::array{Setting{"resolution", "3"}});
    REQUIRE_FALSE(none);
    CHECK(says(none.failure().message, "none"));
}

TEST_CASE("a bad value is refused with what is legal", "[pipeline][technique]") {
    for (char const* const bad : {"", "15", "16385", "-1", "nan", "inf", "2048x", " 2048", "1e99", "1024.5", "0x400"}) {
        std::string const message = refusal({"resolution", bad}, Error::bad_value);
        CAPTURE(message);
        CHECK(says(message, "resolution"));
        CHECK(says(message, "16 to 16384"));
        CHECK(says(message, std::string("'") + bad + "'"));
    }
    for (char const* const bad : {"nan", "1e5", "one", "inf", "--1"})
        CHECK(says(refusal({"slope", bad}, Error::bad_value), bad));
    CHECK(says(refusal({"format", "f16"}, Error::bad_value), "f32, unorm16"));
}

TEST_CASE("settings override defaults in order", "[pipeline][technique]") {
    std::vector<Setting> const settings{
        {"resolution", "512"}, {"resolution", "1024"}, {"format", "unorm16"}, {"slope", "-1.5"}};
    auto const params = pipeline::make_params(technique("shadow-map"), settings);
    REQUIRE(params);
    CHECK(params->integer("resolution") == 1024);
    CHECK(params->word("format") == "unorm16");
    CHECK(params->number("slope") == -1.5);
    CHECK(params->word("bias") == "auto");
}
