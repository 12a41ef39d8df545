#pragma once
// Header, function and parameter limits. Functions are found by their braces: good enough to keep code small, no parser.

#include "house.hpp"

namespace house {

struct Limits {
    std::size_t header_lines = 300;
    std::size_t function_lines = 60;
    std::size_t parameters = 5;
};

/// `PATH[:FUNCTION] RULE REASON...` a line; RULE is header-lines, function-lines or parameters.
struct Exception {
    std::string where;
    std::string rule;
    bool used = false;
};

inline std::vector<Exception> parse_exceptions(std::string const& text, std::vector<Finding>& findings) {
    std::vector<Exception> exceptions;
    std::size_t number = 0;
    for (auto const& line : split(text, '\n')) {
        ++number;
        auto const parts = words(line);
        if (parts.empty() || parts[0].starts_with("#")) continue;
        if (parts.size() < 5) findings.push_back({"cmake/lint_exceptions.txt", number, "needs a place, a rule and a reason"});
        else exceptions.push_back({parts[0], parts[1]});
    }
    return exceptions;
}

struct Function {
    std::string name;
    std::size_t parameters = 0;
    std::size_t first_line = 0;
    std::size_t last_line = 0;
};

/// Position of the parenthesis that opens the parameter list in the text before a brace, or npos if it starts no function.
inline std::size_t parameter_list(std::string const& head) {
    static std::vector<std::string> const other = {"namespace", "enum", "if", "for", "while", "switch", "do", "else", "try", "catch", "return"};
    auto const first = words(head);
    if (first.empty() || std::find(other.begin(), other.end(), split(first[0], '(')[0]) != other.end()) return std::string::npos;
    int depth = 0;
    int angles = 0;
    std::size_t candidate = std::string::npos;
    for (std::size_t i = 0; i < head.size(); ++i) {
        char const c = head[i];
        if (c == '<' && depth == 0) ++angles;
        if (c == '>' && depth == 0 && angles > 0 && head[i - 1] != '-') --angles;
        if (c == '=' && depth == 0 && angles == 0 && !(head.find("operator") < i)) return std::string::npos; // an initializer
        if (c == '(' && depth++ == 0 && angles == 0 && candidate == std::string::npos) {
            auto const before = trim(std::string_view(head).substr(0, i));
            bool const operator_call = before.ends_with("operator");
            bool const specifier = before.ends_with("noexcept") || before.ends_with("requires") || before.ends_with("decltype") ||
                                   before.ends_with("alignas") || before.ends_with("explicit") || before.ends_with("__attribute__");
            if (!before.empty() && (is_word(before.back()) || before.find("operator") != std::string::npos) && !specifier && !operator_call)
                candidate = i;
        }
        if (c == ')') --depth;
    }
    return candidate;
}

inline std::size_t count_parameters(std::string const& head, std::size_t open) {
    int depth = 0;
    int angles = 0;
    std::size_t commas = 0;
    bool any = false;
    for (std::size_t i = open; i < head.size(); ++i) {
        char const c = head[i];
        if (c == '(' || c == '[' || c == '{') ++depth;
        else if ((c == ')' || c == ']' || c == '}') && --depth == 0) break;
        else if (c == '<') ++angles;
        else if (c == '>' && angles > 0) --angles;
        else if (c == ',' && depth == 1 && angles == 0) ++commas;
        else if (std::isspace(static_cast<unsigned char>(c)) == 0) any = true;
    }
    return any ? commas + 1 : 0;
}

inline std::string name_before(std::string const& head, std::size_t open) {
    std::size_t end = open;
    while (end > 0 && std::isspace(static_cast<unsigned char>(head[end - 1])) != 0) --end;
    std::size_t begin = end;
    while (begin > 0 && (is_word(head[begin - 1]) || head[begin - 1] == '~')) --begin;
    return begin == end ? "operator" : head.substr(begin, end - begin);
}

/// True when the brace at the end of `head` initializes a member in a constructor's list.
inline bool is_member_initializer(std::string const& head, std::size_t open) {
    int depth = 0;
    for (std::size_t i = open; i < head.size(); ++i) {
        if (head[i] == '(') ++depth;
        if (head[i] == ')') --depth;
        bool const lone = head[i] == ':' && head.substr(i, 2) != "::" && (i == 0 || head[i - 1] != ':');
        if (depth == 0 && lone) return !trim(head).empty() && is_word(trim(head).back());
    }
    return false;
}

inline std::size_t matching_brace(std::string const& code, std::size_t open) {
    int depth = 0;
    for (std::size_t i = open; i < code.size(); ++i) {
        if (code[i] == '{') ++depth;
        if (code[i] == '}' && --depth == 0) return i;
    }
    return code.size();
}

inline std::size_t start_of_head(std::string const& code, std::size_t from, std::size_t brace) {
    while (from < brace && std::isspace(static_cast<unsigned char>(code[from])) != 0) ++from;
    return from;
}

/// Functions with a body at namespace and class scope; lambdas and local classes count as part of theirs.
inline std::vector<Function> functions_of(std::string const& text) {
    std::string const code = code_only(text);
    std::vector<Function> functions;
    std::size_t head_from = 0;
    for (std::size_t i = 0; i < code.size(); ++i) {
        if (code[i] == ';' || code[i] == '}') head_from = i + 1;
        if (code[i] != '{') continue;
        std::string const head = code.substr(head_from, i - head_from);
        std::size_t const open = parameter_list(head);
        if (open != std::string::npos && is_member_initializer(head, open)) {
            i = matching_brace(code, i); // the head goes on behind the initializer
            continue;
        }
        if (open != std::string::npos) {
            std::size_t const end = matching_brace(code, i);
            functions.push_back({name_before(head, open), count_parameters(head, open),
                                 line_of(code, start_of_head(code, head_from, i)), line_of(code, std::min(end, code.size() - 1))});
            i = end;
        }
        head_from = i + 1;
    }
    return functions;
}

class SizeCheck {
public:
    SizeCheck(Limits limits, std::vector<Exception>& exceptions, std::vector<Finding>& findings)
        : limits_(limits), exceptions_(exceptions), findings_(findings) {}

    void file(std::string const& path, std::string const& text) {
        std::size_t const lines = line_of(text, text.size()) - (text.ends_with("\n") ? 1 : 0);
        if (!path.ends_with(".cpp") && lines > limits_.header_lines)
            report({path, 0, "has " + std::to_string(lines) + " lines"}, path, "header-lines");
        for (auto const& function : functions_of(text)) {
            if (is_test(function.name)) continue;
            std::size_t const length = function.last_line - function.first_line + 1;
            std::string const where = path + ":" + function.name;
            if (length > limits_.function_lines)
                report({path, function.first_line, function.name + " has " + std::to_string(length) + " lines"}, where, "function-lines");
            // Oracles in tests spell coordinates out.
            if (function.parameters > limits_.parameters && path.find("/tests/") == std::string::npos)
                report({path, function.first_line, function.name + " has " + std::to_string(function.parameters) + " parameters"}, where,
                       "parameters");
        }
    }

private:
    static bool is_test(std::string const& name) {
        return name == "TEST_CASE" || name == "TEMPLATE_TEST_CASE" || name == "SCENARIO" || name == "PROPERTY";
    }
    void report(Finding finding, std::string const& where, std::string const& rule) {
        for (auto& exception : exceptions_)
            if (exception.where == where && exception.rule == rule) {
                exception.used = true;
                return;
            }
        findings_.push_back(std::move(finding));
    }

    Limits limits_;
    std::vector<Exception>& exceptions_;
    std::vector<Finding>& findings_;
};

inline std::vector<Finding> check_sizes(Tree const& tree, std::string const& exceptions_text, Limits limits = {}) {
    std::vector<Finding> findings;
    auto exceptions = parse_exceptions(exceptions_text, findings);
    SizeCheck check(limits, exceptions, findings);
    for (auto const& [path, text] : tree)
        if (path.ends_with(".hpp") || path.ends_with(".cpp") || path.ends_with(".glsl")) check.file(path, text);
    for (auto const& exception : exceptions)
        if (!exception.used)
            findings.push_back({"cmake/lint_exceptions.txt", 0, exception.where + " " + exception.rule + " is no longer needed"});
    return findings;
}

} // namespace house
