#include "app/session/colour_by.h"

#include <algorithm>

namespace ramus::app {

namespace {

std::vector<ColouringRow> colouring_table() {
    std::vector<ColouringRow> rows = {
        {ColourBy::kNothing, "nothing", "One colour", "One colour for the whole tree."},
        {ColourBy::kState, "state", "State", "Explains what is highlighted, defocused, selected and lost."},
    };
    for (const QuantityRow* row : rows_with(&QuantityRow::colours))
        rows.push_back({row->quantity, row->key, row->label, row->colours.help});
    rows.push_back({ColourBy::kLesion, "lesion", "Distance to lesion", "Colours the margins around the lesions."});
    rows.push_back({ColourBy::kLabel, "label", "Names", "Colours named branches and what depends on them."});
    rows.push_back({ColourBy::kBranch, "branch", "Branch", "Tells neighbouring branches apart."});
    return rows;
}

} // namespace

const std::vector<ColouringRow>& colourings() {
    static const std::vector<ColouringRow> rows = colouring_table();
    return rows;
}

std::string_view name_of(ColourBy by) {
    const auto row = std::ranges::find(colourings(), by, &ColouringRow::by);
    return row == colourings().end() ? std::string_view() : row->key;
}

std::optional<ColourBy> colouring_named(std::string_view key) {
    const auto row = std::ranges::find(colourings(), key, &ColouringRow::key);
    return row == colourings().end() ? std::nullopt : std::optional(row->by);
}

} // namespace ramus::app
