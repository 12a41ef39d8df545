// house_lint includes MODULES_TXT ROOT | sizes EXCEPTIONS_TXT ROOT | tables ROOT | layout ROOT | formulas SPIRV_FOLDER
// Prints what breaks a rule of the house, one line each; exit code 1 if there is any.

#include "formulas.hpp"
#include "includes.hpp"
#include "layout.hpp"
#include "sizes.hpp"
#include "tables.hpp"

#include <iostream>

namespace {

house::Tree read_tree(std::string const& root, std::vector<std::string> const& suffixes) {
    house::Tree tree;
    for (auto const* folder : {"modules", "examples", "tests"}) house::read_into(tree, root, folder, suffixes);
    return tree;
}

/// The top level's names; the folders that builds and demos leave there are ignored by git and here.
std::set<std::string> top_level_names(std::string const& root) {
    std::set<std::string> names;
    for (auto const& entry : std::filesystem::directory_iterator(root)) names.insert(entry.path().filename().string());
    for (auto const* ignored : {"build", "demo", "compile_commands.json", "CMakeUserPresets.json"}) names.erase(ignored);
    return names;
}

int report(std::vector<house::Finding> const& findings) {
    for (auto const& finding : findings) {
        std::cout << finding.path;
        if (finding.line != 0) std::cout << ':' << finding.line;
        std::cout << ": " << finding.text << '\n';
    }
    std::cout << findings.size() << " findings\n";
    return findings.empty() ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    std::vector<std::string> const args(argv + 1, argv + argc);
    if (args.size() == 3 && args[0] == "includes")
        return report(house::check_includes(house::parse_modules(house::read_file(args[1])), read_tree(args[2], {".hpp", ".cpp", ".glsl"})));
    if (args.size() == 3 && args[0] == "sizes")
        return report(house::check_sizes(read_tree(args[2], {".hpp", ".cpp", ".glsl"}), house::read_file(args[1])));
    if (args.size() == 2 && args[0] == "tables") return report(house::check_tables(read_tree(args[1], {".hpp", ".cpp", ".glsl", ".md"})));
    if (args.size() == 2 && args[0] == "layout")
        return report(house::check_layout(read_tree(args[1], {".hpp", ".cpp", ".glsl", ".md", ".txt"}), top_level_names(args[1])));
    if (args.size() == 2 && args[0] == "formulas") {
        house::Tree spirv;
        house::read_into(spirv, args[1], "", {".spv"});
        return report(house::check_formulas(spirv));
    }
    std::cerr << "usage: house_lint includes MODULES_TXT ROOT | sizes EXCEPTIONS_TXT ROOT | tables ROOT | layout ROOT | "
                 "formulas SPIRV_FOLDER\n";
    return 2;
}
