// CsvRows: iterates over the rows of a CSV text. Quoted cells may contain separators, line breaks and doubled quotes.
#pragma once

#include "core/base/error.h"

#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

class CsvRows {
public:
    // The first line decides the separator: semicolon, comma or tab. `text` must outlive this.
    CsvRows(std::string_view text, std::string name);

    // Gets the trimmed cells of the next row that is not blank, valid until the next call. False: end of the table.
    // Removes the apostrophe that protects a cell from being taken for a formula by a spreadsheet. Fails on a quote
    // that does not end.
    [[nodiscard]] Result<bool> next(std::vector<std::string_view>& cells);

    [[nodiscard]] std::size_t line() const { return line_; } // of the last row
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
