#include "app/commands/info_table.h"

#include "core/io/standard_input.h"

#include <array>
#include <map>
#include <utility>

namespace ramus::app {

namespace {

using InfoCells = std::map<std::string, Cell>;

constexpr std::array kInfoColumns{"file",       "kind",        "branches",    "leaves",  "segments",   "roots",
                                  "loops",      "generations", "length",      "volume",  "radius_min", "radius_mean",
                                  "radius_max", "unit",        "orientation", "repairs", "suspicions", "error"};

Table row_with(const std::string& file, InfoCells cells) {
    cells.insert_or_assign("file", io::input_name(file));
    Table table;
    table.rows.emplace_back();
    for (const char* name : kInfoColumns) {
        table.columns.push_back({name, name});
        const auto known = cells.find(name);
        table.rows[0].push_back(known == cells.end() ? Cell("") : known->second);
    }
    return table;
}

} // namespace

Table info_row(const std::string& file) { return row_with(file, {{"kind", "volume"}}); }

Table info_row(const std::string& file, const tree::VesselTree& tree, const measure::TreeStatistics& statistics) {
    const auto number = [](auto count) { return static_cast<double>(count); };
    return row_with(file, {{"kind", "tree"},
                           {"branches", number(tree.branches.size())},
                           {"leaves", number(statistics.leaves)},
                           {"segments", number(tree.segment_count())},
                           {"roots", number(tree.roots.size())},
                           {"loops", number(tree.loop_count)},
                           {"generations", number(statistics.generations)},
                           {"length", statistics.length_mm},
                           {"volume", statistics.volume_mm3},
                           {"radius_min", statistics.radius_mm.min},
                           {"radius_mean", statistics.radius_mm.mean},
                           {"radius_max", statistics.radius_mm.max},
                           {"unit", std::string(tree.claims.unit_word())},
                           {"orientation", std::string(tree.claims.axes_word())},
                           {"repairs", number(sentences(tree, tree::Note::Kind::kRepaired).size())},
                           {"suspicions", number(sentences(tree, tree::Note::Kind::kSuspect).size())}});
}

Table info_row(const std::string& file, const Error& error) { return row_with(file, {{"error", error.message()}}); }

} // namespace ramus::app
