#pragma once
// A bar on standard error while a person waits; nothing where nobody looks.

#include <string_view>

namespace gnomon::command {

class ProgressBar {
  public:
    /// `shown`: standard error is a terminal.
    explicit ProgressBar(bool shown) : shown_(shown) {}
    ~ProgressBar() { clear(); }
    ProgressBar(ProgressBar const&) = delete;
    ProgressBar& operator=(ProgressBar const&) = delete;

    /// `done` of `total` steps are finished; `what` is next.
    void show(int done, int total, std::string_view what);
    void clear();

  private:
    bool shown_;
    bool drawn_ = false;
};

/// Whether standard output (1) or standard error (2) is a terminal.
[[nodiscard]] bool is_terminal(int descriptor);

}  // namespace gnomon::command
