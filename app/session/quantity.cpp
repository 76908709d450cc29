#include "app/session/quantity.h"

#include <algorithm>

namespace ramus::app {

namespace {

using Facts = TreeFacts;

const BranchFacts& facts_at(const Facts& facts, int branch) { return facts.branches[static_cast<std::size_t>(branch)]; }
const tree::Branch& branch_at(const tree::VesselTree& tree, int branch) {
    return tree.branches[static_cast<std::size_t>(branch)];
}

// One member of BranchFacts, or a member of that, and one of tree::Branch.
template <auto... Members> double fact_along(const Facts& facts, int branch) {
    return (facts_at(facts, branch).*....*Members);
}
template <auto... Members> double fact(const tree::VesselTree& /*tree*/, const Facts& facts, int branch) {
    return fact_along<Members...>(facts, branch);
}
template <auto Member> double of_tree(const tree::VesselTree& tree, const Facts& /*facts*/, int branch) {
    return branch_at(tree, branch).*Member;
}

// NOLINTNEXTLINE(readability-function-size): a table
std::vector<QuantityRow> quantity_table() {
    return {
        {.quantity = Quantity::kDiameter,
         .key = "diameter",
         .label = "Diameter",
         .unit = "mm",
         .value = fact<&BranchFacts::diameter_mm, &measure::Range::mean>,
         .least = fact_along<&BranchFacts::diameter_mm, &measure::Range::min>,
         .largest = fact_along<&BranchFacts::diameter_mm, &measure::Range::max>,
         .filter_names = {"d", "diameter"},
         .filter_example = "d>3",
         .list = {3, "\xC3\x98 mm", true},
         .report = {1, "diameter", "Diameter, mm"},
         .info = {4, "diameter_mm", "diameter mm", 12},
         .colours = {3, "Colours every place by how wide the vessel is there.", true}},
        {.quantity = Quantity::kLength,
         .key = "length",
         .label = "Length",
         .unit = "mm",
         .value = fact<&BranchFacts::length_mm>,
         .filter_names = {"len", "length"},
         .filter_example = "len>=20",
         .list = {4, "Len mm", true, 1},
         .report = {2, "length", "Length, mm"},
         .info = {3, "length_mm", "length mm", 11}},
        {.quantity = Quantity::kGeneration,
         .key = "generation",
         .label = "Generation",
         .whole = true,
         .value = of_tree<&tree::Branch::generation>,
         .filter_names = {"gen", "generation"},
         .filter_example = "gen<5",
         .list = {1, "Gen"},
         .report = {4, "generation", "Generation"},
         .info = {1, "generation", "gen.", 6},
         .colours = {1, "Colours by the number of branchings from the root."}},
        {.quantity = Quantity::kStrahler,
         .key = "strahler",
         .label = "Strahler order",
         .whole = true,
         .value = of_tree<&tree::Branch::strahler>,
         .filter_names = {"strahler", "str"},
         .filter_example = "strahler=1",
         .list = {2, "Str", false, 2},
         .report = {5, "strahler", "Strahler order"},
         .info = {2, "strahler", "Strahler", 9},
         .colours = {2, "Colours by Strahler order: 1 at the leaves."}},
        {.quantity = Quantity::kDependents,
         .key = "dependents",
         .label = "Dependents",
         .whole = true,
         .value = fact<&BranchFacts::dependents, &measure::Amount::branches>,
         .filter_names = {"deps", "dependents"},
         .filter_example = "deps>10",
         .list = {5, "Deps", true},
         .report = {10, "dependent_branches", "Depend on it"}},
        {.quantity = Quantity::kVolume,
         .key = "volume",
         .label = "Volume",
         .unit = "mm\xC2\xB3",
         .value = fact<&BranchFacts::volume_mm3>,
         .filter_names = {"vol", "volume"},
         .filter_example = "vol",
         .report = {3, "volume", "Volume, mm\xC2\xB3"}},
        {.quantity = Quantity::kRootDistance,
         .key = "root-distance",
         .label = "Distance from root",
         .unit = "mm",
         .value = fact<&BranchFacts::root_distance_mm>,
         .filter_names = {"dist", "distance"},
         .filter_example = "dist",
         .colours = {4, "Colours every place by its way from the root along the vessels."}},
        {.quantity = Quantity::kId,
         .key = "id",
         .label = "Id",
         .whole = true,
         .value = [](const tree::VesselTree&, const Facts&, int branch) { return static_cast<double>(branch); },
         .filter_names = {"id"},
         .filter_example = "id"},
        {.quantity = Quantity::kDependentLength,
         .key = "dependent-length",
         .label = "Length of dependents",
         .unit = "mm",
         .value = fact<&BranchFacts::dependents, &measure::Amount::length_mm>,
         .report = {11, "dependent_length", "their length, mm"}},
        {.quantity = Quantity::kDependentVolume,
         .key = "dependent-volume",
         .label = "Volume of dependents",
         .unit = "mm\xC2\xB3",
         .value = fact<&BranchFacts::dependents, &measure::Amount::volume_mm3>,
         .report = {12, "dependent_volume", "volume, mm\xC2\xB3"}},
        {.quantity = Quantity::kDependentLeaves,
         .key = "dependent-leaves",
         .label = "Leaves among dependents",
         .whole = true,
         .value = fact<&BranchFacts::dependents, &measure::Amount::leaves>,
         .report = {13, "dependent_leaves", "leaves"}},
    };
}

} // namespace

std::span<const QuantityRow> quantities() {
    static const std::vector<QuantityRow> rows = quantity_table();
    return rows;
}

const QuantityRow& row_of(Quantity quantity) { return quantities()[static_cast<std::size_t>(quantity)]; }

double value_of(Quantity quantity, const tree::VesselTree& tree, const TreeFacts& facts, int branch) {
    return row_of(quantity).value(tree, facts, branch);
}

std::optional<Quantity> filtered_quantity(std::string_view name) {
    for (const QuantityRow& row : quantities())
        if (std::ranges::find(row.filter_names, name) != row.filter_names.end()) return row.quantity;
    return std::nullopt;
}

} // namespace ramus::app
