#include "options.hpp"

#include <gnomon/check/check.hpp>

#include <initializer_list>

using namespace gnomon::command;

namespace {

Outcome<Command> parse(std::initializer_list<char const*> arguments) {
    std::vector<char const*> argv = {"gnomon"};
    argv.insert(argv.end(), arguments);
    return parse_command_line(static_cast<int>(argv.size()), argv.data());
}

RunOptions run_of(std::initializer_list<char const*> arguments) {
    auto command = parse(arguments);
    REQUIRE(command);
    REQUIRE(std::holds_alternative<RunOptions>(*command));
    return std::get<RunOptions>(*command);
}

/// The sentence of a usage error.
std::string refused(std::initializer_list<char const*> arguments) {
    auto const command = parse(arguments);
    if (command) return "accepted";
    CHECK(command.failure().code == Exit::usage);
    return command.failure().message;
}

bool has(std::string const& text, char const* part) {
    INFO(text);
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("negative directions are values, not options", "[options]") {
    RunOptions const run =
        run_of({"compare", "city", "--sun", "-0.45,-0.8,-0.4", "--eye", "-1,2,3", "--look", "-.5,0,0"});
    CHECK(run.verb == Verb::compare);
    CHECK(run.light.sun == gnomon::math::dvec3(-0.45, -0.8, -0.4));
    CHECK(run.view.eye_m == gnomon::math::dvec3(-1.0, 2.0, 3.0));
    CHECK(run.view.look_m == gnomon::math::dvec3(-0.5, 0.0, 0.0));
    CHECK(run_of({"render", "city", "--sun=-1,0,0"}).light.sun == gnomon::math::dvec3(-1.0, 0.0, 0.0));
}

TEST_CASE("techniques come as a list or one by one, parameters with lists of values", "[options]") {
    RunOptions const run = run_of({"compare", "city", "--techniques", "shadow-map,ray", "--param",
                                   "shadow-map.resolution=512,1024", "--param", "shadow-map.taps=1"});
    CHECK(run.techniques == std::vector<std::string>{"shadow-map", "ray"});
    REQUIRE(run.params.size() == 2);
    CHECK(run.params[0].technique == "shadow-map");
    CHECK(run.params[0].name == "resolution");
    CHECK(run.params[0].values == std::vector<std::string>{"512", "1024"});
    CHECK(run_of({"render", "city", "--technique", "a", "--technique", "b"}).techniques ==
          std::vector<std::string>{"a", "b"});
    CHECK(run_of({"compare", "city"}).techniques == std::vector<std::string>{"shadow-map", "ray"});
    CHECK(run_of({"compare", "city"}).threads >= 1);
}

TEST_CASE("a scene may come after options", "[options]") {
    CHECK(run_of({"render", "--techniques", "ray", "--param", "ray.x=1", "city"}).scene.config.name == "city");
    RunOptions const run = run_of({"render", "sheet", "--offset", "-8192", "--triangles", "5", "--seed", "0"});
    CHECK(run.scene.config.offset_m == -8192.0);
    CHECK(run.scene.config.triangles == 5);
    CHECK(run.scene.tuned_by.has_value());
}

TEST_CASE("a point has a range or none", "[options]") {
    CHECK_FALSE(run_of({"render", "city", "--point", "1,2,3"}).light.point->range_m.has_value());
    CHECK(run_of({"render", "city", "--point", "1,2,3,40"}).light.point->range_m == 40.0);
    CHECK(has(refused({"render", "city", "--point", "1,2"}), "1,2"));
    CHECK(has(refused({"render", "city", "--point", "1,2,3,0"}), "range 0"));
    CHECK(has(refused({"render", "city", "--point", "1,2,3,-4"}), "range -4"));
}

TEST_CASE("every bad value is named, with what to do", "[options]") {
    CHECK(has(refused({}), "verb"));
    CHECK(has(refused({"rendr", "city"}), "did you mean 'render'?"));
    CHECK(has(refused({"render"}), "needs a scene"));
    CHECK(has(refused({"render", "city", "--siz", "1x1"}), "did you mean --size?"));
    CHECK(has(refused({"render", "city", "extra"}), "extra"));
    CHECK(has(refused({"--nonsense"}), "--nonsense"));
    CHECK(has(refused({"render", "city", "--size"}), "--size"));
    CHECK(has(refused({"render", "city", "--size", "0x0"}), "0x0"));
    CHECK(has(refused({"render", "city", "--size", "1024"}), "1024"));
    CHECK(has(refused({"render", "city", "--size", "1x1", "--size", "2x2"}), "--size"));
    CHECK(has(refused({"render", "city", "--threads", "0"}), "--threads 0"));
    CHECK(has(refused({"render", "city", "--threads", "-1"}), "--threads -1"));
    CHECK(has(refused({"render", "city", "--threads", "100000"}), "--threads 100000"));
    CHECK(has(refused({"render", "city", "--threads", "2k"}), "--threads 2k"));
    CHECK(has(refused({"render", "city", "--repeats", "0"}), "--repeats 0"));
    CHECK(has(refused({"render", "city", "--sun", "0,0,0"}), "zero length"));
    CHECK(has(refused({"render", "city", "--sun", "nan,0,0"}), "'nan'"));
    CHECK(has(refused({"render", "city", "--sun", "1,0,0", "--point", "1,2,3"}), "one light"));
    CHECK(has(refused({"render", "city", "--eye", "nan,0,0", "--look", "1,2,3"}), "'nan'"));
    CHECK(has(refused({"render", "city", "--eye", "1e10,0,0", "--look", "1,2,3"}), "too far"));
    CHECK(run_of({"render", "city", "--sun", "1e300,0,0"}).light.sun.has_value());
    CHECK(has(refused({"render", "city", "--eye", "0,0,0"}), "--look"));
    CHECK(has(refused({"render", "city", "--eye", "1,1,1", "--look", "1,1,1"}), "same point"));
    CHECK(has(refused({"render", "city", "--fov", "60"}), "--eye"));
    CHECK(has(refused({"render", "city", "--eye", "0,0,0", "--look", "1,0,0", "--fov", "180"}), "--fov 180"));
    CHECK(has(refused({"render", "city", "--eye", "0,0,0", "--look", "1,0,0", "--camera", "A"}), "one of them"));
    CHECK(has(refused({"render", "city", "--near", "2", "--far", "1"}), "near must be less"));
    CHECK(has(refused({"render", "city", "--near", "0"}), "--near 0"));
    CHECK(has(refused({"render", "city", "--far", "inf"}), "--far inf"));
    CHECK(has(refused({"render", "city", "--backend", "vulkam"}), "vulkan"));
    CHECK(run_of({"render", "city"}).backends == std::vector<std::string>{"cpu"});
    CHECK(run_of({"render", "city", "--backend", "vulkan,cpu"}).backends == std::vector<std::string>{"vulkan", "cpu"});
    CHECK(run_of({"render", "city", "--backend", "vulkan", "--device", "2"}).device == "2");
    CHECK(has(refused({"render", "city", "--param", "resolution=5"}), "technique.name=value"));
    CHECK(has(refused({"render", "city", "--param", "a.b=1,"}), "missing"));
    CHECK(has(refused({"render", "city", "--out", ""}), "--out"));
    CHECK(has(refused({"render", "city", "--triangles", "0"}), "--triangles 0"));
    CHECK(has(refused({"scenes", "--write", "a.glb"}), "name the scene"));
    CHECK(has(refused({"scenes", "--triangles", "5"}), "name the scene"));
    CHECK(has(refused({"info", "extra"}), "extra"));
}

TEST_CASE("help and version are answers, not errors", "[options]") {
    for (auto arguments : {std::initializer_list<char const*>{"--help"},
                           {"--version"},
                           {"render", "--help"},
                           {"compare", "--help"},
                           {"scenes", "--help"},
                           {"info", "--help"},
                           {"-h"}}) {
        auto const command = parse(arguments);
        REQUIRE(command);
        REQUIRE(std::holds_alternative<HelpText>(*command));
        CHECK(std::get<HelpText>(*command).text.size() > 8);
    }
}
