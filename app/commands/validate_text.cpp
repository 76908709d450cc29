#include "app/commands/validate_text.h"

#include "app/commands/deviation_report.h"
#include "app/commands/listing.h"
#include "app/reports/validation/validation_tables.h"
#include "app/session/numbers.h"
#include "core/io/standard_input.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace ramus::app {

namespace {

using nlohmann::ordered_json;

// Of constrictions and widths.
template <class List> ordered_json radii_json(const List& places) {
    ordered_json list = ordered_json::array();
    for (const auto& one : places)
        list.push_back({{"branch", one.branch},
                        {"at", place_json(one.at)},
                        {"expected_radius_mm", one.expected_radius_mm},
                        {"radius_mm", one.radius_mm}});
    return list;
}

ordered_json questions_json(const validate::Validation& found) {
    ordered_json lost = ordered_json::array(), parts = ordered_json::array(), merged = ordered_json::array();
    for (const validate::Lost& one : found.lost)
        lost.push_back({{"branch", one.branch}, {"at", place_json(one.at)}, {"length_mm", one.length_mm}});
    for (const validate::FalsePart& one : found.false_parts)
        parts.push_back({{"at", place_json(one.at)}, {"length_mm", one.length_mm}});
    for (const validate::Merged& one : found.merged)
        merged.push_back({{"branches", one.branches}, {"at", place_json(one.at)}, {"gap_mm", one.gap_mm}});
    ordered_json widths = radii_json(found.widths), positions = ordered_json::array();
    for (std::size_t i = 0; i < found.widths.size(); ++i) widths[i]["length_mm"] = found.widths[i].length_mm;
    for (const validate::Offset& one : found.positions)
        positions.push_back({{"branch", one.branch},
                             {"at", place_json(one.at)},
                             {"offset_mm", one.offset_mm},
                             {"length_mm", one.length_mm}});
    return {{"lost", std::move(lost)},     {"false", std::move(parts)},
            {"merged", std::move(merged)}, {"constrictions", radii_json(found.constrictions)},
            {"width", std::move(widths)},  {"position", std::move(positions)}};
}

ordered_json fidelity_json(const validate::Fidelity& fidelity) {
    ordered_json json = {{"points", fidelity.points},
                         {"points_outside", fidelity.outside},
                         {"points_outside_percent", outside_percent(fidelity)},
                         {"axis_offset_mm", {{"median", nullptr}, {"p95", nullptr}, {"max", nullptr}}}};
    if (fidelity.places > 0)
        json["axis_offset_mm"] = {
            {"median", fidelity.offset_median_mm}, {"p95", fidelity.offset_p95_mm}, {"max", fidelity.offset_max_mm}};
    return json;
}

ordered_json number_or_null(const std::optional<double>& number) {
    return number ? ordered_json(*number) : ordered_json();
}

ordered_json radius_error_json(const validate::RadiusError& error) {
    if (error.places == 0) return {{"median", nullptr}, {"p95", nullptr}, {"places", 0}};
    ordered_json json = {{"median", error.median},
                         {"p95", error.p95},
                         {"places", error.places},
                         {"flat", {{"median", error.flat_median}, {"p95", error.flat_p95}}}};
    if (error.points > 0)
        json["at_points"] = {{"median", error.points_median}, {"p95", error.points_p95}, {"points", error.points}};
    return json;
}

// The same members as in `ramus mesh --json`.
ordered_json shape_json(const std::optional<validate::Shape>& shape) {
    if (!shape) return nullptr;
    return {{"components", shape->surface.pieces},
            {"loops", shape->surface.loops},
            {"tree", {{"components", shape->tree.pieces}, {"loops", shape->tree.loops}}}};
}

ordered_json data_set_json(const ValidatedDataSet& set, bool one_of_several) {
    ordered_json json;
    json["tree"] = io::input_name(set.tree);
    json["units"] = set.claims.unit_word();
    if (one_of_several) json["mask"] = set.mask.empty() ? ordered_json() : ordered_json(io::input_name(set.mask));
    json["surface"] = set.surface.empty() ? "made of the tree" : io::input_name(set.surface);
    ordered_json& cones = json["distances"]["to_cones"];
    cones = deviation_json(set.to_cones.statistics);
    if (!one_of_several)
        cones["above_percent"] = nullptr; // kept for scripts
    else if (set.half_voxel_mm)
        cones["threshold_mm"] = *set.half_voxel_mm;
    if (set.to_cones.but_for_ends) {
        const measure::DeviationStatistics& others = *set.to_cones.but_for_ends;
        cones["but_for_free_ends"] = {{"count", others.count}, {"mean", others.mean}, {"sigma", others.sigma},
                                      {"rms", others.rms},     {"max", others.max},   {"median", others.box.median}};
    }
    for (const auto& [name, distances] : {std::pair{"to_mask", &set.to_mask}, std::pair{"from_mask", &set.from_mask}}) {
        json["distances"][name] = nullptr;
        if (!*distances) continue;
        json["distances"][name] = deviation_json((*distances)->statistics);
        json["distances"][name]["threshold_mm"] = *set.half_voxel_mm;
    }
    json["volumes"] = nullptr;
    if (set.volumes)
        json["volumes"] = {{"surface_mm3", number_or_null(set.volumes->surface_mm3)},
                           {"mask_mm3", set.volumes->mask_mm3},
                           {"dice", set.volumes->dice}};
    json["fidelity"] = fidelity_json(set.validation.fidelity);
    json["radius_error"] = radius_error_json(set.validation.radius_error);
    json["questions"] = questions_json(set.validation);
    json["shape"] = shape_json(set.validation.shape);
    return json;
}

ordered_json figures_json(const DistanceFigures& figures) {
    return {{"mean", figures.mean},
            {"sigma", figures.sigma},
            {"rms", figures.rms},
            {"min", figures.min},
            {"max", figures.max},
            {"median", figures.median},
            {"percentile_95", figures.percentile_95},
            {"above_percent", number_or_null(figures.above_percent)}};
}

// Means or standard deviations, with the member names of one data set.
ordered_json summary_json(const ValidationSummary& all) {
    const auto distances = [](const std::optional<DistanceFigures>& figures) {
        return figures ? figures_json(*figures) : ordered_json();
    };
    return {{"data_sets", all.data_sets},
            {"distances",
             {{"to_cones", figures_json(all.to_cones)},
              {"to_mask", distances(all.to_mask)},
              {"from_mask", distances(all.from_mask)}}},
            {"volumes",
             {{"surface_mm3", number_or_null(all.surface_mm3)},
              {"mask_mm3", number_or_null(all.mask_mm3)},
              {"dice", number_or_null(all.dice)}}},
            {"fidelity",
             {{"points_outside_percent", all.points_outside_percent},
              {"axis_offset_mm",
               {{"median", number_or_null(all.offset_median)},
                {"p95", number_or_null(all.offset_p95)},
                {"max", number_or_null(all.offset_max)}}}}},
            {"radius_error", {{"median", number_or_null(all.radius_median)}, {"p95", number_or_null(all.radius_p95)}}},
            {"questions",
             {{"lost", all.lost},
              {"false", all.false_parts},
              {"merged", all.merged},
              {"constrictions", all.constrictions},
              {"width", all.widths},
              {"position", all.positions}}}};
}

std::string at_text(const glm::dvec3& at, const Lengths& lengths) {
    return rounded(at.x + 0.0) + ", " + rounded(at.y + 0.0) + ", " + rounded(at.z + 0.0) + " " + lengths.unit();
}

// Prints a heading with the number of findings, and one line for each of the first kMostListed.
template <class List, class Line> void print_list(const std::string& heading, const List& list, const Line& line) {
    std::cout << heading << ": " << (list.empty() ? "none" : grouped(list.size())) << '\n';
    const std::size_t listed = std::min(list.size(), kMostListed);
    for (std::size_t i = 0; i < listed; ++i) std::cout << "    " << line(list[i]) << '\n';
    if (listed < list.size()) std::cout << "    and " << grouped(list.size() - listed) << " more, which --json lists\n";
}

void print_questions(const validate::Validation& validation, const Lengths& lengths) {
    print_list("lost branches", validation.lost, [&](const validate::Lost& one) {
        return "branch " + std::to_string(one.branch) + " at " + at_text(one.at, lengths) + ", " +
               lengths.text(one.length_mm) + " long";
    });
    print_list("false branches", validation.false_parts, [&](const validate::FalsePart& one) {
        return "at " + at_text(one.at, lengths) + ", " + lengths.text(one.length_mm) + " long";
    });
    print_list("merged branches", validation.merged, [&](const validate::Merged& one) {
        return "branch " + std::to_string(one.branches[0]) + " with " + std::to_string(one.branches[1]) + " at " +
               at_text(one.at, lengths) + (one.gap_mm < 0.0 ? ", overlap " : ", gap ") +
               lengths.text(std::abs(one.gap_mm));
    });
    const auto radius_text = [&](const auto& one) {
        return "branch " + std::to_string(one.branch) + " at " + at_text(one.at, lengths) + ", radius " +
               lengths.text(one.radius_mm) + " instead of " + lengths.text(one.expected_radius_mm);
    };
    print_list("changed constrictions", validation.constrictions, radius_text);
    print_list("changed widths", validation.widths, [&](const validate::Width& one) {
        return radius_text(one) + ", " + lengths.text(one.length_mm) + " long";
    });
    print_list("moved branches", validation.positions, [&](const validate::Offset& one) {
        return "branch " + std::to_string(one.branch) + " at " + at_text(one.at, lengths) + ", " +
               lengths.text(one.offset_mm) + " off, " + lengths.text(one.length_mm) + " long";
    });
}

void print_one(const ValidatedDataSet& set) {
    const validate::Validation& validation = set.validation;
    const Lengths lengths(set.claims);
    print_questions(validation, lengths);
    if (validation.shape) std::cout << "hangs together: " << text_of(*validation.shape) << '\n';
    const validate::Fidelity& fidelity = validation.fidelity;
    std::cout << "points outside of the surface: " << grouped(fidelity.outside) << " of " << grouped(fidelity.points)
              << '\n';
    if (fidelity.places > 0)
        std::cout << "axis off the centerline away from joints: median " << lengths.text(fidelity.offset_median_mm)
                  << ", 95th percentile " << lengths.text(fidelity.offset_p95_mm) << ", largest "
                  << lengths.text(fidelity.offset_max_mm) << '\n';
    const validate::RadiusError& error = validation.radius_error;
    if (error.places > 0)
        std::cout << "radius away from joints: median error " << digits(100.0 * error.median) << " %, 95th percentile "
                  << digits(100.0 * error.p95) << " %; of flat triangles " << digits(100.0 * error.flat_median)
                  << " % and " << digits(100.0 * error.flat_p95) << " %\n";
    std::cout << lengths.worded(
        deviation_text("surface to truncated cones", set.to_cones.statistics, set.half_voxel_mm));
    if (const auto& others = set.to_cones.but_for_ends)
        std::cout << lengths.worded("    without what lies beyond free ends, mm: mean " + rounded(others->mean) +
                                    ", largest " + rounded(others->max) + "\n");
    if (set.to_mask)
        std::cout << lengths.worded(
            deviation_text("surface to isosurface", set.to_mask->statistics, set.half_voxel_mm));
    if (set.from_mask)
        std::cout << lengths.worded(
            deviation_text("isosurface to surface", set.from_mask->statistics, set.half_voxel_mm));
    if (set.volumes)
        std::cout << "volumes: surface "
                  << (set.volumes->surface_mm3 ? lengths.volume(*set.volumes->surface_mm3) : "not closed") << ", mask "
                  << lengths.volume(set.volumes->mask_mm3) << "; Dice " << digits(set.volumes->dice, 4) << '\n';
}

std::string cell_words(const Cell& cell) {
    if (!cell.number) return cell.text;
    const double number = *cell.number;
    if (!std::isfinite(number)) return "-";
    if (number >= 0.0 && number == std::floor(number)) return grouped(static_cast<std::uint64_t>(number));
    return digits(number, 4);
}

// Prints a table with headings; numbers are aligned to the right.
void print_table(const Table& all) {
    const Table table = in_words(for_people(all));
    std::cout << '\n' << table.title << '\n';
    std::vector<std::size_t> widths;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        widths.push_back(table.columns[c].heading.size());
        for (const std::vector<Cell>& row : table.rows) widths[c] = std::max(widths[c], cell_words(row[c]).size());
    }
    const auto print_line = [&](const auto& word_of) {
        std::string line;
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            const std::string word = word_of(c), space(widths[c] - word.size() + 2, ' ');
            line += table.rows.front()[c].number ? space + word : "  " + word + space.substr(2);
        }
        std::cout << line << '\n';
    };
    print_line([&](std::size_t c) { return table.columns[c].heading; });
    for (const std::vector<Cell>& row : table.rows) print_line([&](std::size_t c) { return cell_words(row[c]); });
}

} // namespace

ordered_json validation_json(std::span<const ValidatedDataSet> sets) {
    if (sets.size() == 1) return data_set_json(sets.front(), false);
    ordered_json json;
    json["data_sets"] = ordered_json::array();
    for (const ValidatedDataSet& set : sets) json["data_sets"].push_back(data_set_json(set, true));
    const std::vector<UnitGroup> groups = by_unit(sets);
    const auto add_summaries = [](ordered_json& into, const UnitGroup& group) {
        into["averages"] = summary_json(summary_of(group.sets, Of::kMean));
        into["standard_deviations"] = summary_json(summary_of(group.sets, Of::kDeviation));
    };
    if (groups.size() == 1) {
        json["units"] = groups.front().unit;
        add_summaries(json, groups.front());
        return json;
    }
    // Lengths in different units have no average.
    json["units"] = json["averages"] = json["standard_deviations"] = nullptr;
    for (const UnitGroup& group : groups) add_summaries(json["by_unit"][group.unit], group);
    return json;
}

void print_validation(std::span<const ValidatedDataSet> sets) {
    if (sets.size() == 1) return print_one(sets.front());
    for (const ValidatedDataSet& set : sets) {
        const validate::Validation& found = set.validation;
        if (found.nothing_found()) continue; // the table shows it
        std::cout << io::input_name(set.tree) << '\n';
        print_questions(found, Lengths(set.claims));
    }
    print_table(questions_table(sets));
    print_table(fidelity_table(sets));
    for (const Table& table : {shape_table(sets), volumes_table(sets)})
        if (!table.rows.empty()) print_table(table);
    for (const Held how : {Held::kToCones, Held::kToMask, Held::kFromMask})
        if (const Table table = distance_table(sets, how); !table.rows.empty()) print_table(table);
}

} // namespace ramus::app
