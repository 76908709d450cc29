#include "app/reports/validation/data_set.h"

#include <filesystem>

namespace ramus::app {

namespace {

// Of what `value` gives, an optional number, of those that have it; none: none has.
template <class List, class Value> std::optional<double> mean_where(const List& list, const Value& value) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const auto& one : list) {
        const std::optional<double> number = value(one);
        if (!number) continue;
        sum += *number;
        ++count;
    }
    return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

} // namespace

std::string name_of(const ValidatedDataSet& set) {
    const std::string name = std::filesystem::path(set.tree).filename().string();
    return name.empty() ? set.tree : name;
}

Lengths lengths_of(std::span<const ValidatedDataSet> sets) {
    for (const ValidatedDataSet& set : sets)
        if (!set.claims.has_unit()) return Lengths(set.claims);
    return {};
}

DistanceFigures figures_of(const measure::DeviationStatistics& statistics) {
    DistanceFigures figures{statistics.mean, statistics.sigma,      statistics.rms,           statistics.min,
                            statistics.max,  statistics.box.median, statistics.percentile_95, {}};
    if (statistics.above) figures.above_percent = 100.0 * *statistics.above;
    return figures;
}

DistanceFigures mean_of(std::span<const DistanceFigures> all) {
    DistanceFigures mean;
    for (auto figure : {&DistanceFigures::mean, &DistanceFigures::sigma, &DistanceFigures::rms, &DistanceFigures::min,
                        &DistanceFigures::max, &DistanceFigures::median, &DistanceFigures::percentile_95}) {
        for (const DistanceFigures& one : all) mean.*figure += one.*figure;
        mean.*figure /= static_cast<double>(all.size());
    }
    bool complete = true;
    for (const DistanceFigures& one : all) complete = complete && one.above_percent.has_value();
    if (complete) mean.above_percent = mean_where(all, [](const DistanceFigures& one) { return one.above_percent; });
    return mean;
}

ValidationAverages averages_of(std::span<const ValidatedDataSet> sets) {
    ValidationAverages averages;
    averages.data_sets = sets.size();
    std::vector<DistanceFigures> cones, masks;
    for (const ValidatedDataSet& set : sets) {
        cones.push_back(figures_of(set.to_cones.statistics));
        if (set.to_mask) masks.push_back(figures_of(set.to_mask->statistics));
    }
    averages.to_cones = mean_of(cones);
    if (masks.size() == sets.size()) averages.to_mask = mean_of(masks);
    const auto radius = [&](double validate::RadiusError::*figure) {
        return mean_where(sets, [&](const ValidatedDataSet& set) {
            const validate::RadiusError& error = set.validation.radius_error;
            return error.places > 0 ? std::optional(error.*figure) : std::nullopt;
        });
    };
    averages.radius_median = radius(&validate::RadiusError::median);
    averages.radius_p95 = radius(&validate::RadiusError::p95);
    const auto count = [&](const auto& list_of) {
        return *mean_where(sets, [&](const ValidatedDataSet& set) {
            return std::optional(static_cast<double>(list_of(set.validation).size()));
        });
    };
    averages.lost = count([](const auto& found) -> const auto& { return found.lost; });
    averages.false_parts = count([](const auto& found) -> const auto& { return found.false_parts; });
    averages.merged = count([](const auto& found) -> const auto& { return found.merged; });
    averages.constrictions = count([](const auto& found) -> const auto& { return found.constrictions; });
    averages.smoothed_away = count([](const auto& found) -> const auto& { return found.smoothed_away; });
    return averages;
}

} // namespace ramus::app
