// Building blocks of self-contained web pages for reports, on screens of any width and on paper: head, style, tables,
// facts, pictures. Text from files and people is escaped. UTF-8.
#pragma once

#include "app/reports/report_tables.h"

#include <cstddef>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::app {

struct ReportPicture {
    std::string caption; // "Anterior"
    std::string png;     // the bytes of the PNG file
};

using Facts = std::vector<std::pair<std::string, std::string>>; // name, value

// Escapes & < > " ' for HTML and XML, and replaces invalid UTF-8 and control characters by U+FFFD.
[[nodiscard]] std::string html_text(std::string_view text);

// JSON that is safe inside a script element, where "</script>" and "<!--" would end or change it. Invalid UTF-8 becomes
// U+FFFD.
[[nodiscard]] std::string script_json(const nlohmann::ordered_json& value);

// Replaces each {{name}} of the text by the part with this name, which must exist. Inserted text is not searched again.
using PageTexts = std::map<std::string, std::string_view, std::less<>>;
[[nodiscard]] std::string filled(std::string_view text, const PageTexts& parts);

[[nodiscard]] std::string now_text(); // "2005-04-01 16:30", local time

// The page up to and including the heading. `what`: kind of report, "Vessel tree report"; `made`: time.
[[nodiscard]] std::string page_begin(const std::string& title, const std::string& what, const std::string& made);
[[nodiscard]] std::string page_end();

// A cell for people, as plain text. `significant`: digits of numbers that are not whole.
[[nodiscard]] std::string text_of(const Cell& cell, int significant);

[[nodiscard]] std::string facts_html(const Facts& facts);

// The first picture is large, the others small. Empty without pictures.
[[nodiscard]] std::string pictures_html(const std::vector<ReportPicture>& pictures);
// The same with pictures of one size.
[[nodiscard]] std::string even_pictures_html(const std::vector<ReportPicture>& pictures);

struct TableLook {
    std::string note{};                                 // under the heading
    std::string flag_column{};                          // rows with "yes" in this column are highlighted
    std::size_t sums = 0;                               // this many last rows are set off as sums
    bool is_part = false;                               // has a smaller heading
    std::size_t most_rows = 100;                        // further rows are omitted
    std::string all_rows_in{"the same report as .csv"}; // where to find omitted rows
};
// Heading, note and rows; long tables are truncated.
[[nodiscard]] std::string table_html(const Table& all, const TableLook& look = {});

} // namespace ramus::app
