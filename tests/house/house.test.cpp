#include "formulas.hpp"
#include "includes.hpp"
#include "layout.hpp"
#include "sizes.hpp"
#include "tables.hpp"

#include <gnomon/check/check.hpp>

#include <cstdint>
#include <vector>

namespace {

using house::Finding;
using house::Tree;

std::string const three_modules =
    "module low 0\n"
    "module adapted 0\nadapters gnomon/adapted/tbb.hpp\n"
    "module high 2\ndepends low\n";

Tree good_tree() {
    return {{"modules/low/include/gnomon/low/a.hpp", "#include <cstddef>\n"},
            {"modules/adapted/include/gnomon/adapted/tbb.hpp", "#include <tbb/tbb.h>\n"},
            {"modules/high/include/gnomon/high/b.hpp", "#include <gnomon/low/a.hpp>\n"},
            {"modules/high/src/b.cpp", "#include <tiny_gltf.h>\n#include <gnomon/high/b.hpp>\n"}};
}

/// What the check says after `path` got `text`.
std::string complaint(std::string const& path, std::string const& text) {
    auto tree = good_tree();
    tree[path] += text;
    auto const findings = house::check_includes(house::parse_modules(three_modules), tree);
    return findings.empty() ? "" : findings.front().text;
}

bool mentions(std::string const& text, std::string const& part) { return text.find(part) != std::string::npos; }

std::string lines(std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += "    ++x;\n";
    return text;
}

} // namespace

TEST_CASE("the include check accepts a tree that keeps the rules", "[house]") {
    CHECK(house::check_includes(house::parse_modules(three_modules), good_tree()).empty());
}

TEST_CASE("the include check finds each forbidden include", "[house]") {
    CHECK(mentions(complaint("modules/low/include/gnomon/low/a.hpp", "#include <gnomon/high/b.hpp>\n"), "higher floor"));
    CHECK(mentions(complaint("modules/low/include/gnomon/low/a.hpp", "#  include <tbb/tbb.h>\n"), "above floor 1"));
    CHECK(mentions(complaint("modules/low/include/gnomon/low/a.hpp", "#include <gnomon/nothing/x.hpp>\n"), "no module"));
    CHECK(mentions(complaint("modules/low/include/gnomon/low/a.hpp", "#include <gnomon/adapted/x.hpp>\n"), "does not declare"));
    CHECK(mentions(complaint("modules/low/include/gnomon/low/a.hpp", "#include \"../../x.hpp\"\n"), "climbs out"));
    CHECK(mentions(complaint("modules/low/src/part/a.cpp", "#include \"../../x.hpp\"\n"), "climbs out"));
    CHECK(mentions(complaint("modules/low/src/part/a.cpp", "#include \"../part/../../x.hpp\"\n"), "climbs out"));
    CHECK(mentions(complaint("modules/low/src/a.cpp", "#include \"../x.hpp\"\n"), "climbs out"));
    CHECK_FALSE(mentions(complaint("modules/low/src/part/a.cpp", "#include \"../x.hpp\"\n"), "climbs out"));
    CHECK(mentions(complaint("modules/adapted/include/gnomon/adapted.hpp", "#include <gnomon/adapted/tbb.hpp>\n"), "adapter"));
    CHECK(mentions(complaint("modules/low/tests/a.test.cpp", "#include <gnomon/high/b.hpp>\n"), "TEST_DEPENDS"));
    CHECK(complaint("modules/low/tests/a.test.cpp", "#include <gnomon/check/check.hpp>\n").empty());
}

TEST_CASE("the include check finds a dependency that nothing uses, a missing adapter and a circle", "[house]") {
    auto modules = house::parse_modules(three_modules + "module idle 1\ndepends low\n");
    CHECK(mentions(house::check_includes(modules, good_tree()).front().text, "declares low"));
    auto tree = good_tree();
    tree.erase("modules/adapted/include/gnomon/adapted/tbb.hpp");
    CHECK(mentions(house::check_includes(house::parse_modules(three_modules), tree).front().text, "does not exist"));
    std::vector<Finding> findings;
    house::find_circles(house::parse_modules("module a 0\ndepends b\nmodule b 0\ndepends c\nmodule c 0\ndepends a\nmodule d 0\ndepends a\n"), findings);
    CHECK(findings.size() == 3);
}

TEST_CASE("comments, literals and directives are no code", "[house]") {
    CHECK(house::code_only("a // {\nb") == "a     \nb");
    CHECK(house::code_only("a /* {\n} */ b") == "a     \n     b");
    CHECK(house::code_only("f(\"{\", '{')") == "f(   ,    )");
    CHECK(house::code_only("#define X {\\\n {\ny") == "            \n  \ny");
    CHECK(house::code_only("1'000 '{'") == "1'000    ");
    CHECK(house::code_only("R\"x({)x\" y") == "R        y");
}

TEST_CASE("functions are found with their length and parameters", "[house]") {
    auto const found = house::functions_of("namespace n {\nstruct S {\n    S(int a) : a_{a}, b_(1) {}\n"
                                           "    int f(std::array<int, 3> x, int y = g(1, 2)) const noexcept {\n        if (x) {\n        }\n    }\n"
                                           "    bool operator()(int a) const { return a; }\n};\nint table[] = {1, 2};\n} // namespace n\n");
    REQUIRE(found.size() == 3);
    CHECK(found[0].name == "S");
    CHECK(found[0].parameters == 1);
    CHECK(found[1].name == "f");
    CHECK(found[1].parameters == 2);
    CHECK(found[1].first_line == 4);
    CHECK(found[1].last_line == 7);
    CHECK(found[2].parameters == 1);
}

TEST_CASE("size limits hold at the limit and are reported above it", "[house]") {
    auto const count = [](std::string const& text, std::string const& exceptions = "") {
        return house::check_sizes({{"modules/a/include/a.hpp", text}}, exceptions).size();
    };
    CHECK(count("void f() {\n" + lines(58) + "}\n") == 0);
    CHECK(count("void f() {\n" + lines(59) + "}\n") == 1);
    CHECK(count("void f(int a, int b, int c, int d, int e) {}\n") == 0);
    CHECK(count("void f(int a, int b, int c, int d, int e, int g) {}\n") == 1);
    CHECK(count(lines(300)) == 0);
    CHECK(count(lines(301)) == 1);
    CHECK(count("TEST_CASE(\"long\") {\n" + lines(80) + "}\n") == 0);
}

TEST_CASE("an exception needs a reason and goes when it is not needed", "[house]") {
    Tree const tree = {{"a.hpp", lines(301)}};
    CHECK(house::check_sizes(tree, "# comment\na.hpp header-lines one long table\n").size() == 0);
    CHECK(house::check_sizes(tree, "a.hpp header-lines\n").size() == 2);
    CHECK(house::check_sizes(tree, "a.hpp header-lines one long table\nb.hpp header-lines one long table\n").size() == 1);
}

TEST_CASE("a row of an equation table must name a function and a test that exist", "[house]") {
    auto const findings = [](std::string const& row) {
        Tree const tree = {{"modules/m/README.md", "| equation | function | test | deviation |\n|---|---|---|---|\n" + row + "\n"},
                           {"modules/m/include/gnomon/m/x.hpp", "int slice_at(int);\n"},
                           {"modules/m/tests/x.test.cpp", "TEST_CASE(\"slices tile the range\") {}\n"}};
        return house::check_tables(tree).size();
    };
    CHECK(findings("| eq. 2 | `m::slice_at(depth)` | \"slices tile the range\" | none |") == 0);
    CHECK(findings("| eq. 2 | `slice_at` | `x.test.cpp` | none |") == 0);
    CHECK(findings("| eq. 2 | `slice` | `x.test.cpp` | none |") == 1);
    CHECK(findings("| eq. 2 | `slice_at` | `y.test.cpp` | none |") == 1);
    CHECK(findings("| eq. 2 | `slice_at` | | none |") == 1);
    CHECK(findings("| eq. 2 | `slice_at` |") == 1);
}

TEST_CASE("the layout check knows the top level and the parts of a module", "[house]") {
    std::vector<Finding> findings;
    auto names = house::top_level;
    names.insert(".ci");
    house::check_top_level(names, findings);
    CHECK(findings.empty());
    names.insert("scripts");
    names.erase("LICENSE");
    house::check_top_level(names, findings);
    CHECK(findings.size() == 2);

    findings.clear();
    Tree tree = {{"modules/m/CMakeLists.txt", ""}, {"modules/m/README.md", ""}, {"modules/m/include/x.hpp", ""}, {"modules/m/tests/x.test.cpp", ""}};
    house::check_module_parts(tree, findings);
    CHECK(findings.empty());
    tree["modules/m/tools/x.cpp"] = "";
    tree.erase("modules/m/README.md");
    house::check_module_parts(tree, findings);
    CHECK(findings.size() == 2);
}

TEST_CASE("a formula file has a guard for two languages", "[house]") {
    auto const findings = [](std::string const& text) {
        std::vector<Finding> found;
        house::check_formula_start("modules/m/include/gnomon/m/formula/x.glsl", text, found);
        return found.size();
    };
    CHECK(findings("// A thing.\n\n#ifndef GNOMON_M_FORMULA_X_GLSL\n#define GNOMON_M_FORMULA_X_GLSL\n#endif\n") == 0);
    CHECK(findings("// A thing.\n\n#ifndef X\n#define X\n#endif\n") == 1);
    CHECK(findings("#pragma once\n") == 3);
}

TEST_CASE("no two formula files declare a type of the same name", "[house]") {
    house::Tree tree = {{"modules/a/include/gnomon/a/formula/x.glsl", "struct GnX {\n};\nGN_STRUCT(GnY) {\n};\n"},
                        {"modules/b/include/gnomon/b/formula/y.glsl", "struct GnZ {\n};\n"},
                        {"modules/b/shaders/z.glsl", "struct GnX {\n};\n"}};
    auto const findings = [&] {
        std::vector<Finding> found;
        house::check_formula_types(tree, found);
        return found.size();
    };
    CHECK(findings() == 0);
    tree["modules/b/include/gnomon/b/formula/y.glsl"] += "GN_STRUCT(GnX) {\n};\nstruct GnY {\n};\n";
    CHECK(findings() == 2);
}

TEST_CASE("arithmetic that a driver may fuse is found in SPIR-V", "[house]") {
    // %4 = OpFMul %1 %2 %3, with and without OpDecorate %4 NoContraction; %5 = OpExtInst %1 %9 Fma.
    std::vector<std::uint32_t> words = {0x07230203, 0x10000, 0, 6, 0, (5U << 16U) | 133, 1, 4, 2, 3};
    auto const findings = [&] {
        std::string const bytes(reinterpret_cast<char const*>(words.data()), words.size() * 4);
        return house::check_formulas({{"x.spv", bytes}}).size();
    };
    CHECK(findings() == 1);
    words.insert(words.begin() + 5, {(3U << 16U) | 71, 4, 42});
    CHECK(findings() == 0);
    words.insert(words.end(), {(8U << 16U) | 12, 1, 5, 9, 50, 2, 3, 4});
    CHECK(findings() == 1);
    words.push_back(7U << 16U);  // an instruction beyond the end
    CHECK(findings() == 2);
    CHECK(house::check_formulas({{"y.spv", "no SPIR-V"}}).size() == 1);
    CHECK(house::check_formulas({}).size() == 1);
}

TEST_CASE("an example begins with what it shows and includes umbrellas only", "[house]") {
    auto const findings = [](std::string const& text) {
        std::vector<Finding> found;
        house::check_example("examples/a.cpp", text, found);
        return found.size();
    };
    CHECK(findings("// Shows: a thing.\n#include <gnomon/math.hpp>\n#include <vector>\n") == 0);
    CHECK(findings("#include <gnomon/math.hpp>\n") == 1);
    CHECK(findings("// Shows: a thing.\n#include <gnomon/math/vec.hpp>\n") == 1);
    CHECK(findings("// Shows: a thing.\n" + lines(120)) == 1);
    CHECK(findings("// Shows: a thing.\n" + lines(119)) == 0);
}
