// The quantities of a branch, one row each: colours, the filter and the columns of the list of branches, reports and
// `ramus info` all read this table, so that a quantity is an enumerator and a row.
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

// Where a quantity stands among others; 0: it is not there.
using Order = int;

struct QuantityRow {
    Quantity quantity;
    std::string_view key;   // "root-distance": what colour-by takes, and sessions say
    std::string_view label; // "Distance from root"
    std::string_view unit{};
    bool whole = false; // a whole number
    // Of the branch as a whole; of what varies along it: its mean, and its least and largest.
    double (*value)(const tree::VesselTree&, const TreeFacts&, int branch) = nullptr;
    double (*least)(const TreeFacts&, int branch) = nullptr;
    double (*largest)(const TreeFacts&, int branch) = nullptr;

    // What the filter of the list calls it, and an example; none: it is no condition.
    std::vector<std::string_view> filter_names{};
    std::string_view filter_example{};

    struct ListColumn {
        Order order = 0;
        const char* heading = "";
        bool largest_first = false;
        int spare = 0; // where there is no room for all, columns are left out: the largest first, those of 0 never
    } list{};
    struct ReportColumn {
        Order order = 0;
        std::string_view name, heading; // "length", "Length, mm"
    } report{};
    struct InfoColumn { // of `ramus info --branches`
        Order order = 0;
        std::string_view json, heading; // "length_mm", "length mm"
        int width = 10;
    } info{};
    struct Colours {
        Order order = 0;
        std::string_view help; // of colour-by
        bool logarithmic = false;
    } colours{};
};

[[nodiscard]] std::span<const QuantityRow> quantities(); // in the order of `Quantity`
[[nodiscard]] const QuantityRow& row_of(Quantity quantity);
[[nodiscard]] double value_of(Quantity quantity, const tree::VesselTree& tree, const TreeFacts& facts, int branch);

// The rows that have this kind of column, in its order.
template <class Kind> std::vector<const QuantityRow*> rows_with(Kind QuantityRow::*kind) {
    std::vector<const QuantityRow*> rows;
    for (const QuantityRow& row : quantities())
        if ((row.*kind).order > 0) rows.push_back(&row);
    std::ranges::stable_sort(rows, {}, [kind](const QuantityRow* row) { return (row->*kind).order; });
    return rows;
}

// The quantity that the filter calls so.
[[nodiscard]] std::optional<Quantity> filtered_quantity(std::string_view name);

// Reports put the state of a branch after the quantities up to this one, and what depends on it behind.
inline constexpr Order kBeforeState = 9;

} // namespace ramus::app
