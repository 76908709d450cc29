// What reports as web pages are made of: head and style of a page that needs nothing beside it, on a screen of any
// width and on paper; tables, facts, pictures. Whatever comes from files or people is escaped. UTF-8.
#pragma once

#include "app/reports/report_tables.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::app {

struct ReportPicture {
    std::string caption; // "Anterior"
    std::string png;     // the file's bytes
};

using Facts = std::vector<std::pair<std::string, std::string>>; // name, value

// For HTML and XML alike: & < > " ' escaped, and U+FFFD for bytes that are no letters of UTF-8 and for control
// characters.
[[nodiscard]] std::string html_text(std::string_view text);

[[nodiscard]] std::string now_text(); // "2005-04-01 16:30", the machine's time

// Up to and with the heading. `what` the report is: "Vessel tree report"; `made`: when.
[[nodiscard]] std::string page_begin(const std::string& title, const std::string& what, const std::string& made);
[[nodiscard]] std::string page_end();

[[nodiscard]] std::string facts_html(const Facts& facts);

// The first picture is the large one. Empty without pictures.
[[nodiscard]] std::string pictures_html(const std::vector<ReportPicture>& pictures);
// The same, all of one size.
[[nodiscard]] std::string even_pictures_html(const std::vector<ReportPicture>& pictures);

struct TableLook {
    std::string note{};                                 // under the heading
    std::string flag_column{};                          // rows whose text there is "yes" stand out
    std::size_t sums = 0;                               // so many of the last rows stand apart
    bool is_part = false;                               // with a smaller heading
    std::size_t most_rows = 100;                        // more make no page that anybody reads
    std::string all_rows_in{"the same report as .csv"}; // where those are that the page has no room for
};
// Heading, note and rows. Of long tables the first rows.
[[nodiscard]] std::string table_html(const Table& all, const TableLook& look = {});

} // namespace ramus::app
