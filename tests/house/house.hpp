#pragma once
// What the lints share: a folder read into memory, findings, and C++ text without its comments and literals.

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace house {

/// Path (with '/', relative to the root) to text.
using Tree = std::map<std::string, std::string>;

struct Finding {
    std::string path;
    std::size_t line = 0; ///< 0: the whole file
    std::string text;
};

inline std::string read_file(std::filesystem::path const& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return std::move(out).str();
}

/// Every file with one of the suffixes below `root / folder`; build folders and hidden ones are not entered.
inline void read_into(Tree& tree, std::filesystem::path const& root, std::string const& folder,
                      std::vector<std::string> const& suffixes) {
    namespace fs = std::filesystem;
    if (!fs::exists(root / folder)) return;
    for (fs::recursive_directory_iterator it(root / folder), end; it != end; ++it) {
        std::string const name = it->path().filename().string();
        if (it->is_directory() && (name.starts_with(".") || name == "build")) it.disable_recursion_pending();
        if (!it->is_regular_file()) continue;
        bool const wanted = std::any_of(suffixes.begin(), suffixes.end(), [&](auto const& s) { return name.ends_with(s); });
        if (wanted) tree[fs::relative(it->path(), root).generic_string()] = read_file(it->path());
    }
}

inline std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts(1);
    for (char c : text) {
        if (c == separator) parts.emplace_back();
        else parts.back().push_back(c);
    }
    return parts;
}

inline std::vector<std::string> words(std::string const& text) {
    std::istringstream in(text);
    std::vector<std::string> out;
    for (std::string word; in >> word;) out.push_back(word);
    return out;
}

inline std::string trim(std::string_view text) {
    auto const first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1));
}

[[nodiscard]] inline bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// End of the literal that starts at `at` with a quote: one past its closing quote.
inline std::size_t literal_end(std::string_view text, std::size_t at) {
    char const quote = text[at];
    bool const raw = quote == '"' && at > 0 && text[at - 1] == 'R';
    if (raw) {
        auto const open = text.find('(', at);
        if (open == std::string_view::npos) return text.size();
        std::string const close = ")" + std::string(text.substr(at + 1, open - at - 1)) + "\"";
        auto const end = text.find(close, open);
        return end == std::string_view::npos ? text.size() : end + close.size();
    }
    for (std::size_t i = at + 1; i < text.size(); ++i) {
        if (text[i] == '\\') ++i;
        else if (text[i] == quote || text[i] == '\n') return i + 1;
    }
    return text.size();
}

/// The same text with comments, literals and preprocessor lines blanked; every line keeps its number.
inline std::string code_only(std::string_view text) {
    std::string out(text);
    auto const blank = [&](std::size_t from, std::size_t to) {
        for (; from < to && from < out.size(); ++from)
            if (out[from] != '\n') out[from] = ' ';
        return to;
    };
    bool line_start = true;
    for (std::size_t i = 0; i < text.size();) {
        char const c = text[i];
        bool const digit_separator = c == '\'' && i > 0 && is_word(text[i - 1]);
        if (text.substr(i, 2) == "//") i = blank(i, std::min(text.find('\n', i), text.size()));
        else if (text.substr(i, 2) == "/*") i = blank(i, std::min(text.find("*/", i), text.size() - 2) + 2);
        else if (c == '#' && line_start) {
            auto end = text.find('\n', i);
            while (end != std::string_view::npos && text[end - 1] == '\\') end = text.find('\n', end + 1);
            i = blank(i, std::min(end, text.size()));
        } else if ((c == '"' || c == '\'') && !digit_separator) i = blank(i, literal_end(text, i));
        else {
            line_start = c == '\n' || (line_start && (c == ' ' || c == '\t'));
            ++i;
        }
    }
    return out;
}

inline std::size_t line_of(std::string_view text, std::size_t at) {
    return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

} // namespace house
