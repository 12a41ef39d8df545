#pragma once
// The include graph: what a module includes is what its CMake call declares, floors only look down, nothing runs in a circle.

#include "house.hpp"

#include <set>

namespace house {

struct Module {
    int floor = 0;
    bool made = true; ///< false: declared, but its packages are missing here
    std::set<std::string> depends;
    std::set<std::string> test_depends;
    std::set<std::string> adapters; ///< headers that no other header includes
};
using Modules = std::map<std::string, Module>;

/// Lines `module NAME FLOOR`, then `depends|test_depends|adapters NAME...` of that module.
inline Modules parse_modules(std::string const& text) {
    Modules modules;
    Module* module = nullptr;
    for (auto const& line : split(text, '\n')) {
        auto const parts = words(line);
        if (parts.size() == 3 && parts[0] == "module") {
            module = &modules[parts[1]];
            module->floor = std::stoi(parts[2]);
        } else if (!parts.empty() && module != nullptr) {
            auto& list = parts[0] == "depends" ? module->depends : parts[0] == "adapters" ? module->adapters : module->test_depends;
            list.insert(parts.begin() + 1, parts.end());
        }
    }
    return modules;
}

struct Include {
    std::size_t line;
    std::string header;
};

inline std::vector<Include> includes_of(std::string const& text) {
    std::vector<Include> found;
    std::size_t line = 0;
    for (auto const& raw : split(text, '\n')) {
        ++line;
        std::string rest = trim(raw);
        if (!rest.starts_with("#")) continue;
        rest = trim(std::string_view(rest).substr(1));
        if (!rest.starts_with("include")) continue;
        auto const open = rest.find_first_of("<\"");
        auto const close = open == std::string::npos ? open : rest.find_first_of(">\"", open + 1);
        if (close != std::string::npos) found.push_back({line, rest.substr(open + 1, close - open - 1)});
    }
    return found;
}

/// `gnomon/x/y.hpp` and `gnomon/x.hpp` belong to module x; anything else to none.
inline std::string module_of(std::string const& header) {
    if (!header.starts_with("gnomon/")) return {};
    std::string const rest = header.substr(7);
    auto const slash = rest.find('/');
    return slash != std::string::npos ? rest.substr(0, slash) : rest.substr(0, rest.find('.'));
}

inline bool is_upper_floor_package(std::string const& header) {
    static constexpr std::string_view starts[] = {"OpenMesh/", "tiny_gltf", "tbb/",      "oneapi/", "vulkan/", "png.h", "spng",
                                                  "stb_",      "stb/",      "embree",    "fmt/",    "CLI/",    "nlohmann/"};
    return std::any_of(std::begin(starts), std::end(starts), [&](auto s) { return header.starts_with(s); });
}

/// Checks one file of a module. `part` is its folder in the module: include, src, tests, bench or fuzz.
class IncludeCheck {
public:
    IncludeCheck(Modules const& modules, std::vector<Finding>& findings) : modules_(modules), findings_(findings) {}

    void file(std::string const& path, std::string const& text) {
        auto const parts = split(path, '/'); // modules/NAME/PART/...
        if (parts.size() < 4 || !modules_.contains(parts[1])) return;
        name_ = parts[1];
        path_ = path;
        bool const tests = parts[2] == "tests" || parts[2] == "bench" || parts[2] == "fuzz";
        std::string const own = parts[2] == "include" ? path.substr(path.find("/include/") + 9) : std::string();
        bool const adapter = modules_.at(name_).adapters.contains(own);
        for (auto const& include : includes_of(text)) {
            if (tests) check_in_tests(include); // tests may share an oracle by its path
            else if (stays_in_sources(parts, include.header)) continue; // a folder of src/ may use what all of src/ shares
            else if (include.header.find("..") != std::string::npos) report(include, "climbs out of its folder");
            else if (!adapter) check_in_module(include);
            if (adapter || !tests) note_use(include);
        }
    }

    /// Declared dependencies that no file uses, and adapters that are not there.
    void leftovers(Tree const& tree) {
        for (auto const& [name, module] : modules_) {
            std::string const home = "modules/" + name + "/";
            for (auto const& dependency : module.depends)
                if (module.made && !used_[name].contains(dependency))
                    findings_.push_back({home + "CMakeLists.txt", 0, "declares " + dependency + ", which nothing in it includes"});
            for (auto const& adapter : module.adapters)
                if (!tree.contains(home + "include/" + adapter))
                    findings_.push_back({home + "CMakeLists.txt", 0, "declares the adapter " + adapter + ", which does not exist"});
        }
    }

private:
    /// Whether a header is one of the module's own src/, above the folder of the file that asks.
    static bool stays_in_sources(std::vector<std::string> const& parts, std::string const& header) {
        std::size_t ups = 0;
        while (header.compare(3 * ups, 3, "../") == 0) ++ups;
        bool const climbs_again = header.find("..", 3 * ups) != std::string::npos;
        return parts[2] == "src" && ups > 0 && ups + 4 <= parts.size() && !climbs_again;
    }
    void report(Include const& include, std::string const& what) {
        findings_.push_back({path_, include.line, "<" + include.header + "> " + what});
    }
    void note_use(Include const& include) {
        auto const other = module_of(include.header);
        if (!other.empty()) used_[name_].insert(other);
    }
    void check_in_module(Include const& include) {
        Module const& self = modules_.at(name_);
        std::string const other = module_of(include.header);
        if (other.empty()) {
            if (self.floor < 2 && is_upper_floor_package(include.header)) report(include, "belongs above floor 1");
            if (include.header.starts_with("vulkan/") && name_ != "vulkan") report(include, "belongs into the module vulkan alone");
            return;
        }
        auto const found = modules_.find(other);
        if (found == modules_.end()) return report(include, "is of no module");
        if (found->second.floor > self.floor) report(include, "is of a higher floor");
        if (other != name_ && !self.depends.contains(other)) report(include, "is of " + other + ", which CMakeLists.txt does not declare");
        bool const in_source = path_.find("/src/") != std::string::npos && self.floor >= 2;
        if (found->second.adapters.contains(include.header) && !in_source) report(include, "is an adapter; no header includes one");
    }
    void check_in_tests(Include const& include) {
        Module const& self = modules_.at(name_);
        std::string const other = module_of(include.header);
        if (other.empty() || other == name_ || other == "check") return;
        if (!self.depends.contains(other) && !self.test_depends.contains(other))
            report(include, "is of " + other + ", which CMakeLists.txt does not declare (TEST_DEPENDS)");
    }

    Modules const& modules_;
    std::vector<Finding>& findings_;
    std::map<std::string, std::set<std::string>> used_;
    std::string name_;
    std::string path_;
};

/// Modules that reach themselves over `depends`.
inline void find_circles(Modules const& modules, std::vector<Finding>& findings) {
    for (auto const& entry : modules) {
        std::set<std::string> seen;
        std::vector<std::string> todo(entry.second.depends.begin(), entry.second.depends.end());
        while (!todo.empty()) {
            std::string const next = todo.back();
            todo.pop_back();
            if (!seen.insert(next).second || !modules.contains(next)) continue;
            auto const& more = modules.at(next).depends;
            todo.insert(todo.end(), more.begin(), more.end());
        }
        if (seen.contains(entry.first))
            findings.push_back({"modules/" + entry.first + "/CMakeLists.txt", 0, "is part of a circle of modules"});
    }
}

inline std::vector<Finding> check_includes(Modules const& modules, Tree const& tree) {
    std::vector<Finding> findings;
    IncludeCheck check(modules, findings);
    for (auto const& [path, text] : tree) check.file(path, text);
    check.leftovers(tree);
    find_circles(modules, findings);
    return findings;
}

} // namespace house
