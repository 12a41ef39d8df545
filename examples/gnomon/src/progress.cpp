#include "progress.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace gnomon::command {

void ProgressBar::show(int done, int total, std::string_view what) {
    if (!shown_) return;
    constexpr int cells = 24;
    int const full = std::clamp(done * cells / std::max(total, 1), 0, cells);
    std::string const bar(static_cast<std::size_t>(full), '=');
    // \x1b[K clears what a longer line left; this is only ever a terminal.
    std::string const line = fmt::format("\r[{:<{}}] {}/{} {}\x1b[K", bar, cells, done, total, what.substr(0, 48));
    std::fputs(line.c_str(), stderr);
    std::fflush(stderr);
    drawn_ = true;
}

void ProgressBar::clear() {
    if (!drawn_) return;
    std::fputs("\r\x1b[K", stderr);
    std::fflush(stderr);
    drawn_ = false;
}

bool is_terminal(int descriptor) { return isatty(descriptor) != 0; }

}  // namespace gnomon::command
