#include "app/reports/validation/data_set.h"

#include "core/io/standard_input.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace ramus::app {

namespace {

double summary(const std::vector<double>& numbers, Of what) {
    const auto count = static_cast<double>(numbers.size());
    double mean = 0.0, squares = 0.0;
    for (const double number : numbers) mean += number / count;
    if (what == Of::kMean) return mean;
    for (const double number : numbers) squares += (number - mean) * (number - mean);
    return numbers.size() > 1 ? std::sqrt(squares / (count - 1.0)) : 0.0;
}

// Statistic of the optional numbers that `value` returns; none: no data set has one.
template <class List, class Value> std::optional<double> summary_where(const List& list, Of what, const Value& value) {
    std::vector<double> numbers;
    for (const auto& one : list)
        if (const std::optional<double> number = value(one)) numbers.push_back(*number);
    return numbers.empty() ? std::nullopt : std::optional(summary(numbers, what));
}

} // namespace

std::string name_of(const ValidatedDataSet& set) {
    const std::string name = std::filesystem::path(io::input_name(set.tree)).filename().string();
    return name.empty() ? set.tree : name;
}

Lengths lengths_of(std::span<const ValidatedDataSet> sets) {
    for (const ValidatedDataSet& set : sets)
        if (!set.claims.has_unit()) return Lengths(set.claims);
    return {};
}

std::vector<UnitGroup> by_unit(std::span<const ValidatedDataSet> sets) {
    std::vector<UnitGroup> groups;
    for (const bool known : {true, false}) {
        std::vector<const ValidatedDataSet*> members;
        for (const ValidatedDataSet& set : sets)
            if (set.claims.has_unit() == known) members.push_back(&set);
        if (!members.empty()) groups.push_back({std::string(members.front()->claims.unit_word()), members});
    }
    return groups;
}

DistanceFigures figures_of(const measure::DeviationStatistics& statistics) {
    DistanceFigures figures{statistics.mean, statistics.sigma,      statistics.rms,           statistics.min,
                            statistics.max,  statistics.box.median, statistics.percentile_95, {}};
    if (statistics.above) figures.above_percent = 100.0 * *statistics.above;
    return figures;
}

DistanceFigures summary_of(std::span<const DistanceFigures> all, Of what) {
    DistanceFigures figures;
    for (auto figure : {&DistanceFigures::mean, &DistanceFigures::sigma, &DistanceFigures::rms, &DistanceFigures::min,
                        &DistanceFigures::max, &DistanceFigures::median, &DistanceFigures::percentile_95})
        figures.*figure =
            *summary_where(all, what, [&](const DistanceFigures& one) { return std::optional(one.*figure); });
    if (std::ranges::all_of(all, [](const DistanceFigures& one) { return one.above_percent.has_value(); }))
        figures.above_percent = summary_where(all, what, [](const DistanceFigures& one) { return one.above_percent; });
    return figures;
}

double outside_percent(const validate::Fidelity& fidelity) {
    return 100.0 * static_cast<double>(fidelity.outside) /
           static_cast<double>(std::max<std::size_t>(fidelity.points, 1));
}

ValidationSummary summary_of(std::span<const ValidatedDataSet* const> sets, Of what) {
    ValidationSummary all;
    all.data_sets = sets.size();
    std::vector<DistanceFigures> cones, masks, from_masks;
    for (const ValidatedDataSet* set : sets) {
        cones.push_back(figures_of(set->to_cones.statistics));
        if (set->to_mask) masks.push_back(figures_of(set->to_mask->statistics));
        if (set->from_mask) from_masks.push_back(figures_of(set->from_mask->statistics));
    }
    all.to_cones = summary_of(cones, what);
    if (masks.size() == sets.size()) all.to_mask = summary_of(masks, what);
    if (from_masks.size() == sets.size()) all.from_mask = summary_of(from_masks, what);
    const auto volumes = [&](const auto& value) {
        return summary_where(sets, what, [&](const ValidatedDataSet* set) -> std::optional<double> {
            return set->volumes ? value(*set->volumes) : std::nullopt;
        });
    };
    all.surface_mm3 = volumes([](const Volumes& one) { return one.surface_mm3; });
    all.mask_mm3 = volumes([](const Volumes& one) { return std::optional(one.mask_mm3); });
    all.dice = volumes([](const Volumes& one) { return std::optional(one.dice); });
    const auto alone = [&](const auto& value) { // over data sets with places away from joints and other vessels
        return summary_where(sets, what, [&](const ValidatedDataSet* set) {
            return set->validation.radius_error.places > 0 ? std::optional<double>(value(set->validation))
                                                           : std::nullopt;
        });
    };
    all.radius_median = alone([](const auto& found) { return found.radius_error.median; });
    all.radius_p95 = alone([](const auto& found) { return found.radius_error.p95; });
    all.offset_median = alone([](const auto& found) { return found.fidelity.offset_median_mm; });
    all.offset_p95 = alone([](const auto& found) { return found.fidelity.offset_p95_mm; });
    all.offset_max = alone([](const auto& found) { return found.fidelity.offset_max_mm; });
    all.points_outside_percent = *summary_where(sets, what, [](const ValidatedDataSet* set) {
        return std::optional(outside_percent(set->validation.fidelity));
    });
    const auto count = [&](const auto& list_of) {
        return *summary_where(sets, what, [&](const ValidatedDataSet* set) {
            return std::optional(static_cast<double>(list_of(set->validation).size()));
        });
    };
    all.lost = count([](const auto& found) -> const auto& { return found.lost; });
    all.false_parts = count([](const auto& found) -> const auto& { return found.false_parts; });
    all.merged = count([](const auto& found) -> const auto& { return found.merged; });
    all.constrictions = count([](const auto& found) -> const auto& { return found.constrictions; });
    all.widths = count([](const auto& found) -> const auto& { return found.widths; });
    all.positions = count([](const auto& found) -> const auto& { return found.positions; });
    return all;
}

} // namespace ramus::app
