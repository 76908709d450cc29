// What one figure or table of the paper becomes: pictures, plots, tables, and numbers that are held against closed
// forms and against the paper. A plain value; app/paper/paper_page.h makes a page of it.
#pragma once

#include "app/reports/html.h"
#include "app/reports/plots/svg.h"
#include "app/reports/report_tables.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app::paper {

struct Picture {
    std::string file; // its name in the folder, "figure_01.png"
    std::string caption;
    std::string png; // the file's bytes
};

struct Plot {
    std::string file; // "figure_08_histogram.svg"
    Svg svg;
};

struct SavedTable {
    std::string file; // "table_1_to_cones.csv"
    Table table;
    std::string note{};   // for people
    std::size_t sums = 0; // so many of the last rows are of all others together
};

// A number that was measured on a surface, a field or a tree.
struct Measured {
    std::string what;
    double value = 0.0;
    std::string unit{};              // "mm", "%", "radii"; empty: a count
    std::optional<double> formula{}; // the closed form's; none: there is none
    std::string paper{};             // as the paper says it; empty: it says nothing
};

struct Figure {
    std::vector<std::string> options{}; // what made it, as command lines or in words
    std::vector<Picture> pictures{};
    std::vector<Plot> plots{};
    std::vector<SavedTable> tables{};
    std::vector<Measured> measured{};
};

} // namespace ramus::app::paper
