#pragma once
// The equation tables of the modules' READMEs: every row names a function that exists and a test that exists.

#include "house.hpp"

namespace house {

inline std::vector<std::string> cells_of(std::string const& line) {
    std::string const row = trim(line);
    if (!row.starts_with("|")) return {};
    auto cells = split(std::string_view(row).substr(1), '|');
    if (row.ends_with("|")) cells.pop_back();
    for (auto& cell : cells) cell = trim(cell);
    return cells;
}

inline std::size_t column_of(std::vector<std::string> const& header, std::string_view name) {
    for (std::size_t i = 0; i < header.size(); ++i)
        if (header[i] == name) return i;
    return header.size();
}

/// What a cell names: its `code` spans and "quoted" titles, or else the whole cell.
inline std::vector<std::string> names_in(std::string const& cell) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < cell.size(); ++i) {
        if (cell[i] != '`' && cell[i] != '"') continue;
        auto const end = cell.find(cell[i], i + 1);
        if (end == std::string::npos) break;
        names.push_back(cell.substr(i + 1, end - i - 1));
        i = end;
    }
    if (names.empty()) names.push_back(cell);
    return names;
}

/// `gnomon::math::make_view(a, b)` to `make_view`; `View::size_px` to `size_px`.
inline std::string function_name(std::string text) {
    text = text.substr(0, text.find('('));
    text = text.substr(0, text.find('<'));
    auto const colon = text.rfind(':');
    if (colon != std::string::npos) text = text.substr(colon + 1);
    auto const dot = text.rfind('.');
    return trim(dot == std::string::npos ? text : text.substr(dot + 1));
}

inline bool has_word(std::string const& text, std::string const& word) {
    if (word.empty()) return false;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        bool const left = at == 0 || !is_word(text[at - 1]);
        bool const right = at + word.size() >= text.size() || !is_word(text[at + word.size()]);
        if (left && right) return true;
    }
    return false;
}

class TableCheck {
public:
    TableCheck(Tree const& tree, std::vector<Finding>& findings) : tree_(tree), findings_(findings) {}

    void readme(std::string const& path, std::string const& text) {
        home_ = path.substr(0, path.rfind('/') + 1);
        std::vector<std::string> header;
        std::size_t line = 0;
        for (auto const& raw : split(text, '\n')) {
            ++line;
            auto const cells = cells_of(raw);
            if (cells.empty()) header.clear();
            else if (header.empty()) header = cells;
            else if (cells[0].find("---") == std::string::npos) row(path, line, header, cells);
        }
    }

private:
    void row(std::string const& path, std::size_t line, std::vector<std::string> const& header, std::vector<std::string> const& cells) {
        auto const function = column_of(header, "function");
        auto const test = column_of(header, "test");
        if (function == header.size() || test == header.size()) return; // another table
        if (cells.size() != header.size()) {
            findings_.push_back({path, line, "the row has another number of cells than its header"});
            return;
        }
        for (auto const& name : names_in(cells[function]))
            if (!any_file({"include/", "src/"}, [&](auto const&, auto const& text) { return has_word(text, function_name(name)); }))
                findings_.push_back({path, line, "no function '" + function_name(name) + "'"});
        for (auto const& name : names_in(cells[test]))
            if (name.empty() || !any_file({"tests/"}, [&](auto const& file, auto const& text) {
                    return file.ends_with("/" + name) || file.ends_with("/" + name + ".test.cpp") || text.find(name) != std::string::npos;
                }))
                findings_.push_back({path, line, "no test '" + name + "'"});
    }
    template <class F>
    bool any_file(std::vector<std::string> const& folders, F const& is_it) const {
        for (auto const& folder : folders)
            for (auto const& [path, text] : tree_)
                if (path.starts_with(home_ + folder) && is_it(path, text)) return true;
        return false;
    }

    Tree const& tree_;
    std::vector<Finding>& findings_;
    std::string home_;
};

inline std::vector<Finding> check_tables(Tree const& tree) {
    std::vector<Finding> findings;
    TableCheck check(tree, findings);
    for (auto const& [path, text] : tree)
        if (path.ends_with("README.md")) check.readme(path, text);
    return findings;
}

} // namespace house
