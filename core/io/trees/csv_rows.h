// The rows of a table in a text, cell by cell. Cells may stand in quotes, with any line breaks and doubled quotes
// within.
#pragma once

#include "core/base/error.h"

#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

class CsvRows {
public:
    // The separator is what parts the cells of the first line: a semicolon, a comma or a tab.
    CsvRows(std::string_view text, std::string name);

    // The cells of the next row that is not blank, without blanks around them; false: there is none. They stay as
    // they are until the next call. An apostrophe that keeps a spreadsheet from taking the cell for a formula is none
    // of its text. Fails where a quote does not end.
    [[nodiscard]] Result<bool> next(std::vector<std::string_view>& cells);

    [[nodiscard]] std::size_t line() const { return line_; } // of the row last taken
    [[nodiscard]] std::string place() const { return name_ + ":" + std::to_string(line_); }

private:
    [[nodiscard]] Result<std::string_view> cell();

    std::string_view text_;
    std::string name_;
    char separator_ = ';';
    std::size_t at_ = 0, line_ = 0, next_line_ = 1;
    std::deque<std::string> unquoted_;
};

} // namespace ramus::io
