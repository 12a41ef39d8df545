#pragma once
// Where things stand: the top level, the parts of a module, how headers and examples begin.

#include "house.hpp"

#include <cctype>
#include <set>

namespace house {

inline std::set<std::string> const top_level = {"CMakeLists.txt", "CMakePresets.json", "CHANGELOG.md", "LICENSE", "README.md",
                                                "cmake",          "examples",          "modules",      "tests"};
inline std::set<std::string> const module_parts = {"CMakeLists.txt", "README.md", "include", "src", "tests", "bench", "fuzz",  "pictures", "shaders"};

/// What `names` (the top level's entries, without ignored ones) has beyond the house, but for dot files.
inline void check_top_level(std::set<std::string> const& names, std::vector<Finding>& findings) {
    for (auto const& name : names)
        if (!name.starts_with(".") && !top_level.contains(name)) findings.push_back({name, 0, "does not belong on the top level"});
    for (auto const& name : top_level)
        if (!names.contains(name)) findings.push_back({name, 0, "is missing on the top level"});
}

inline void check_module_parts(Tree const& tree, std::vector<Finding>& findings) {
    std::map<std::string, std::set<std::string>> parts;
    for (auto const& entry : tree) {
        auto const steps = split(entry.first, '/');
        if (steps.size() >= 3 && steps[0] == "modules") parts[steps[1]].insert(steps[2]);
    }
    for (auto const& [module, has] : parts) {
        for (auto const& part : has)
            if (!module_parts.contains(part)) findings.push_back({"modules/" + module + "/" + part, 0, "is no part of a module"});
        for (auto const* part : {"CMakeLists.txt", "README.md", "include", "tests"})
            if (!has.contains(part)) findings.push_back({"modules/" + module, 0, std::string("has no ") + part});
    }
}

inline void check_header_start(std::string const& path, std::string const& text, std::vector<Finding>& findings) {
    if (!text.starts_with("#pragma once\n")) findings.push_back({path, 1, "does not start with #pragma once"});
    else if (split(text, '\n').size() > 2 && !split(text, '\n')[1].starts_with("//") && path.find("/include/") != std::string::npos)
        findings.push_back({path, 2, "does not say what it is, in a comment behind #pragma once"});
}

/// A formula file is read by two compilers: a guard that both know, a comment first, nothing left open.
inline void check_formula_start(std::string const& path, std::string const& text, std::vector<Finding>& findings) {
    if (!text.starts_with("// ")) findings.push_back({path, 1, "does not say what it is, in a comment on its first line"});
    std::string guard = path.substr(path.find("/include/") + 9);
    for (char& c : guard) c = is_word(c) ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : '_';
    if (text.find("\n#ifndef " + guard + "\n#define " + guard + "\n") == std::string::npos)
        findings.push_back({path, 0, "has not the include guard " + guard});
    if (text.find("#pragma once") != std::string::npos) findings.push_back({path, 0, "has a #pragma once, which GLSL has not"});
}

/// Types of formula files share one namespace in C++ and one in a shader: no two files may declare the same.
inline void check_formula_types(Tree const& tree, std::vector<Finding>& findings) {
    std::map<std::string, std::string> declared_in;
    for (auto const& [path, text] : tree) {
        if (!path.ends_with(".glsl") || path.find("/include/") == std::string::npos) continue;
        for (std::string const& line : split(text, '\n')) {
            std::size_t const begin = line.starts_with("GN_STRUCT(") ? 10 : line.starts_with("struct Gn") ? 7 : 0;
            std::size_t end = begin;
            while (end < line.size() && is_word(line[end])) ++end;
            if (begin == 0 || end == begin) continue;
            auto const [at, fresh] = declared_in.emplace(line.substr(begin, end - begin), path);
            if (!fresh) findings.push_back({path, 0, "declares " + at->first + ", as " + at->second + " does: give it a name of its own"});
        }
    }
}

inline bool is_umbrella(std::string const& header) {
    return header.starts_with("gnomon/") && std::count(header.begin(), header.end(), '/') == 1;
}

inline void check_example(std::string const& path, std::string const& text, std::vector<Finding>& findings) {
    if (!text.starts_with("// Shows: ")) findings.push_back({path, 1, "does not start with // Shows: ..."});
    if (split(text, '\n').size() > 121) findings.push_back({path, 0, "has more than 120 lines"});
    std::size_t number = 0;
    for (auto const& line : split(text, '\n')) {
        ++number;
        auto const at = line.find("#include <gnomon/");
        auto const end = line.find('>');
        bool const adapter = line.find("executor_tbb.hpp") != std::string::npos;
        if (at == 0 && end != std::string::npos && !is_umbrella(line.substr(10, end - 10)) && !adapter)
            findings.push_back({path, number, "includes a header that is no umbrella"});
    }
}

inline std::vector<Finding> check_layout(Tree const& tree, std::set<std::string> const& top) {
    std::vector<Finding> findings;
    check_top_level(top, findings);
    check_module_parts(tree, findings);
    check_formula_types(tree, findings);
    for (auto const& [path, text] : tree) {
        auto const steps = split(path, '/');
        if (path.ends_with(".hpp") && steps[0] == "modules") check_header_start(path, text, findings);
        if (path.ends_with(".glsl") && path.find("/include/") != std::string::npos) check_formula_start(path, text, findings);
        if (path.ends_with(".cpp") && steps[0] == "examples" && steps.size() == 2) check_example(path, text, findings);
    }
    return findings;
}

} // namespace house
