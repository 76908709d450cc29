// Tables of reports: selection, cuts, margins of lesions, measurements, systems. They are values with columns, written
// as CSV or HTML. Numbers stay numbers: CSV has nine digits, pages round.
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
    int digits = 3;      // significant digits for people, of non-integers
    bool in_csv_alone = false;
};

struct Cell {
    std::string text;
    std::optional<double> number; // if set, `text` is empty
    Cell(std::string words) : text(std::move(words)) {}
    Cell(const char* words) : text(words) {}
    Cell(double value) : number(value) {}
    Cell(int value) : number(value) {}
};

struct Table {
    std::string title;
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows; // each as long as `columns`
};

// The document must have a tree, and the assets must be complete.
[[nodiscard]] Table selection_table(const Document& document, const Assets& assets); // one row per selected branch
[[nodiscard]] Table branches_table(const Document& document, const Assets& assets,
                                   std::span<const int> branches); // one row per branch, in the given order
[[nodiscard]] Table cuts_table(const Document& document,
                               const Assets& assets); // one row per cut, and a last row for all cuts
[[nodiscard]] Table bands_table(const Document& document,
                                const Assets& assets); // one row per branch within a margin
// One row per lesion and system: the shortest distance and the contact.
[[nodiscard]] Table lesions_table(const Document& document, const Assets& assets);
[[nodiscard]] Table systems_table(const Document& document, const Assets& assets);      // one row per system
[[nodiscard]] Table measurements_table(const Document& document, const Assets& assets); // one row per measurement
// One row per contact, closest first; empty if contacts were not searched.
[[nodiscard]] Table contacts_table(const Document& document, const Assets& assets);

// One row per finding of the validation, as in its panel; empty without validation.
[[nodiscard]] Table validation_table(const Document& document, const Assets& assets);

// The column `unit`: the unit of a row's lengths, "mm" or "unknown"; areas and volumes are in its square and cube.
// Names of other columns never depend on the unit. add_unit() sets one unit for all rows.
[[nodiscard]] Column unit_column();
void add_unit(Table& table, const Lengths& lengths);

// Formats a table for people, without CSV-only columns: the unit is in the headings, and volumes are in ml if one is 1
// ml or more. Rows with different units keep the unit column.
[[nodiscard]] Table in_words(Table table);

// CSV by RFC 4180: commas, CRLF, a heading line, quotes where necessary. UTF-8. Names that spreadsheets would interpret
// as formulas get a leading apostrophe, which marks text. Names with other separators of spreadsheets are quoted.
[[nodiscard]] std::string csv_of(const Table& table);
[[nodiscard]] std::string csv_lines(const Table& table); // the same for standard output, with LF as line end
[[nodiscard]] std::string csv_field(std::string_view text);

} // namespace ramus::app
