#pragma once
// The table at the end of a command, and the words that pages share with it.

#include "report.hpp"

#include <string>
#include <vector>

namespace gnomon::command {

/// 1234567 as "1,234,567".
[[nodiscard]] std::string grouped(std::uint64_t value);
/// A fraction in percent with three figures: "0", "0.00123", "4.56"; never "0" for what is above 0.
[[nodiscard]] std::string percent(double fraction);
/// Three figures without an exponent; "inf" where it is infinite.
[[nodiscard]] std::string figures(double value);

struct TableLook {
    std::size_t left = 1;    ///< This many columns stand to the left, the others to the right.
    bool bold_head = false;  ///< For terminals.
};

/// Columns padded to their widest cell.
[[nodiscard]] std::string aligned(std::vector<std::vector<std::string>> const& rows, TableLook look = {});

/// One row a run, under a line that says what was looked at.
///
/// `styled`: for a terminal; otherwise no escape sequence is written.
[[nodiscard]] std::string table_text(Report const& report, bool styled);

}  // namespace gnomon::command
