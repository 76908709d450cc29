// The tables of reports: what is selected, what cuts cost, what lies within the margins of lesions, what was measured,
// the systems. Values with columns, from which CSV and the page are written. Numbers are kept as numbers: CSV gives
// nine digits, pages round them.
#pragma once

#include "app/session/document.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

struct Assets; // app/assets/assets.h

struct Column {
    std::string name;    // in CSV, without a unit: "length"
    std::string heading; // for people, with the unit: "Length, mm"
    int digits = 3;      // that people read, of numbers that are not whole
    bool in_csv_alone = false;
};

struct Cell {
    std::string text;
    std::optional<double> number; // then `text` is empty
    Cell(std::string words) : text(std::move(words)) {}
    Cell(const char* words) : text(words) {}
    Cell(double value) : number(value) {}
    Cell(int value) : number(value) {}
};

struct Table {
    std::string title;
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows; // as long as `columns` each
};

// The document has a tree, and the assets are up to it.
[[nodiscard]] Table selection_table(const Document& document, const Assets& assets); // a row for each selected branch
[[nodiscard]] Table branches_table(const Document& document, const Assets& assets,
                                   std::span<const int> branches); // the same of any branches, in their order
[[nodiscard]] Table cuts_table(const Document& document,
                               const Assets& assets); // a row for each cut; all together in the last
[[nodiscard]] Table bands_table(const Document& document,
                                const Assets& assets); // a row for each branch within a margin
// A row for each lesion and each system: the shortest distance and the contact.
[[nodiscard]] Table lesions_table(const Document& document, const Assets& assets);
[[nodiscard]] Table systems_table(const Document& document, const Assets& assets);      // a row for each system
[[nodiscard]] Table measurements_table(const Document& document, const Assets& assets); // a row for each measurement
// A row for each contact, the closest first; none where they were not looked for.
[[nodiscard]] Table contacts_table(const Document& document, const Assets& assets);

// A row for each finding of the validation, as its panel lists them; none where nobody looked.
[[nodiscard]] Table validation_table(const Document& document, const Assets& assets);

// The column `unit`: what the lengths of a row are in, "mm" or "unknown"; areas and volumes are in squares and cubes of
// it. The names of the other columns never depend on it. add_unit() gives it to all rows alike.
[[nodiscard]] Column unit_column();
void add_unit(Table& table, const Lengths& lengths);

// As people read it, without the columns of CSV alone: the unit stands in the headings, and volumes of which one is a
// millilitre or more are in ml. Rows of different units keep their column, and headings name none.
[[nodiscard]] Table in_words(Table table);

// RFC 4180: comma, CRLF, a heading line; quotes around and doubled quotes inside where a field needs them. UTF-8.
// A name that spreadsheets would take for a formula has an apostrophe in front, which tells them that it is text; names
// with what other spreadsheets part cells by are in quotes.
[[nodiscard]] std::string csv_of(const Table& table);
[[nodiscard]] std::string csv_lines(const Table& table); // the same for standard output, whose lines end with LF alone
[[nodiscard]] std::string csv_field(std::string_view text);

} // namespace ramus::app
