// The table of quantities of a branch. Colours, the filter and columns of the list of branches, reports and `ramus
// info` all read it, so a new quantity needs only an enumerator and a row.
#pragma once

#include "app/session/branch_facts.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace ramus::app {

enum class Quantity : std::uint8_t {
    kDiameter,
    kLength,
    kGeneration,
    kStrahler,
    kDependents,
    kVolume,
    kRootDistance,
    kId,
    kDependentLength,
    kDependentVolume,
    kDependentLeaves
};

// Position of a quantity among others; 0: not shown there.
using Order = int;

struct QuantityRow {
    Quantity quantity;
    std::string_view key;   // "root-distance": in sessions and for colour-by
    std::string_view label; // "Distance from root"
    std::string_view unit{};
    bool whole = false; // an integer
    // The value of the branch (the mean if it varies along the branch); its least and largest value.
    double (*value)(const tree::VesselTree&, const TreeFacts&, int branch) = nullptr;
    double (*least)(const TreeFacts&, int branch) = nullptr;
    double (*largest)(const TreeFacts&, int branch) = nullptr;

    // Names in the filter of the list, and an example; empty: not usable as a condition.
    std::vector<std::string_view> filter_names{};
    std::string_view filter_example{};

    struct ListColumn {
        Order order = 0;
        const char* heading = "";
        bool largest_first = false;
        int spare = 0; // columns with the largest value are dropped first if space is short; 0: never
    } list{};
    struct ReportColumn {
        Order order = 0;
        std::string_view name, heading; // "length", "Length, mm"
    } report{};
    struct InfoColumn { // in `ramus info --branches`
        Order order = 0;
        std::string_view json, heading; // "length_mm", "length mm"
        int width = 10;
    } info{};
    struct Colours {
        Order order = 0;
        std::string_view help; // for colour-by
        bool logarithmic = false;
    } colours{};
};

[[nodiscard]] std::span<const QuantityRow> quantities(); // in the order of `Quantity`
[[nodiscard]] const QuantityRow& row_of(Quantity quantity);
[[nodiscard]] double value_of(Quantity quantity, const tree::VesselTree& tree, const TreeFacts& facts, int branch);

// The rows that have this kind of column, in its order; rows_with(&QuantityRow::list).
template <class Kind> std::vector<const QuantityRow*> rows_with(Kind QuantityRow::*kind) {
    std::vector<const QuantityRow*> rows;
    for (const QuantityRow& row : quantities())
        if ((row.*kind).order > 0) rows.push_back(&row);
    std::ranges::stable_sort(rows, {}, [kind](const QuantityRow* row) { return (row->*kind).order; });
    return rows;
}

// The quantity with this name in the filter.
[[nodiscard]] std::optional<Quantity> filtered_quantity(std::string_view name);

// Reports insert a branch's state after quantities up to this order, and its dependents after that.
inline constexpr Order kBeforeState = 9;

} // namespace ramus::app
