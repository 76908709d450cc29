#include "app/reports/validation/validation_tables.h"

#include "app/reports/validation/branch_radii.h"
#include "core/base/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace ramus::app {

namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN(); // a cell without a number

double or_nothing(const std::optional<double>& number) { return number.value_or(kNothing); }
Cell id_of(int branch) { return std::to_string(branch); } // a name, not a number with digits in groups
int count_of(std::size_t number) { return static_cast<int>(number); }

void add_place(std::vector<Cell>& row, const glm::dvec3& at) {
    row.insert(row.end(), {at.x + 0.0, at.y + 0.0, at.z + 0.0}); // no negative zeros
}

void add_place_columns(Table& table) {
    table.columns.insert(table.columns.end(), {{"x", "x, mm", 4}, {"y", "y, mm", 4}, {"z", "z, mm", 4}});
}

void add_figures(std::vector<Cell>& row, const DistanceFigures& figures) {
    row.insert(row.end(), {figures.mean, figures.sigma, figures.rms, figures.min, figures.max, figures.median,
                           figures.percentile_95, or_nothing(figures.above_percent)});
}

// Fills missing cells of a row with empty ones.
void fill(const Table& table, std::vector<Cell>& row) {
    while (row.size() < table.columns.size()) row.emplace_back("");
}

// Places with a wrong radius, each with its code.
template <class List> Table radii_table(const std::string& title, const List& list, char letter) {
    Table table{title, {{"place", "Place"}, {"branch", "Branch"}}, {}};
    add_place_columns(table);
    table.columns.insert(table.columns.end(),
                         {{"expected_radius", "Radius should be, mm"}, {"radius", "Radius is, mm"}});
    for (std::size_t i = 0; i < list.size(); ++i) {
        std::vector<Cell> row{place_code(letter, i), id_of(list[i].branch)};
        add_place(row, list[i].at);
        row.insert(row.end(), {list[i].expected_radius_mm, list[i].radius_mm});
        table.rows.push_back(std::move(row));
    }
    return table;
}

constexpr std::array kSummaries{std::pair{Of::kMean, "average"}, std::pair{Of::kDeviation, "standard deviation"}};

// Appends summary rows for several data sets: average and standard deviation per unit. `cells` returns the figures of a
// group, to follow number and name; none: the group has no such figures.
template <class Cells> void add_summaries(Table& table, std::span<const ValidatedDataSet> sets, const Cells& cells) {
    if (sets.size() < 2) return;
    const std::vector<UnitGroup> groups = by_unit(sets);
    for (const UnitGroup& group : groups)
        for (const auto& [what, name] : kSummaries) {
            const std::optional<std::vector<Cell>> figures = cells(group.sets, what);
            if (!figures) continue;
            std::vector<Cell> row{"", groups.size() > 1 ? std::string(name) + ", " + group.unit : name};
            row.insert(row.end(), figures->begin(), figures->end());
            row.emplace_back(group.unit);
            table.rows.push_back(std::move(row));
        }
}

std::string unit_of(const ValidatedDataSet& set) { return std::string(set.claims.unit_word()); }

} // namespace

std::string title_of(Held how) {
    switch (how) {
    case Held::kToCones:
        return "Surface to truncated cones";
    case Held::kToMask:
        return "Surface to isosurface of the mask";
    case Held::kFromMask:
        return "Isosurface of the mask to surface";
    }
    return {};
}

const SurfaceDistances* distances_of(const ValidatedDataSet& set, Held how) {
    if (how == Held::kToCones) return &set.to_cones;
    const auto& distances = how == Held::kToMask ? set.to_mask : set.from_mask;
    return distances ? &*distances : nullptr;
}

std::string place_code(char letter, std::size_t index) { return std::string(1, letter) + std::to_string(index + 1); }

Table distance_table(std::span<const ValidatedDataSet> sets, Held how) {
    Table table{title_of(how),
                {{"data_set", "No."},
                 {"tree", "Tree"},
                 {"vertices", "Vertices"},
                 {"mean", "Mean, mm"},
                 {"sigma", "Sigma, mm"},
                 {"rms", "RMS, mm"},
                 {"min", "Min, mm"},
                 {"max", "Max, mm"},
                 {"median", "Median, mm"},
                 {"percentile_95", "95th percentile, mm"},
                 {"above_percent", "Above half a voxel's diagonal, %"},
                 {"half_voxel", "Half a voxel's diagonal, mm"}},
                {}};
    table.columns.push_back(unit_column());
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const SurfaceDistances* distances = distances_of(sets[i], how);
        if (distances == nullptr) continue;
        std::vector<Cell> row{count_of(i + 1), name_of(sets[i]), static_cast<double>(distances->statistics.count)};
        add_figures(row, figures_of(distances->statistics));
        row.emplace_back(or_nothing(sets[i].half_voxel_mm));
        row.emplace_back(unit_of(sets[i]));
        table.rows.push_back(std::move(row));
    }
    add_summaries(table, sets, [&](const auto& group, Of what) -> std::optional<std::vector<Cell>> {
        std::vector<DistanceFigures> all;
        for (const ValidatedDataSet* set : group)
            if (const SurfaceDistances* distances = distances_of(*set, how))
                all.push_back(figures_of(distances->statistics));
        if (all.empty()) return std::nullopt;
        std::vector<Cell> cells{""};
        add_figures(cells, summary_of(all, what));
        cells.emplace_back("");
        return cells;
    });
    return table;
}

Table questions_table(std::span<const ValidatedDataSet> sets) {
    Table table{"The questions",
                {{"data_set", "No."},
                 {"tree", "Tree"},
                 {"lost", "Lost"},
                 {"false", "False"},
                 {"merged", "Merged"},
                 {"constrictions", "Changed constrictions"},
                 {"widths", "Changed widths"},
                 {"positions", "Moved"}},
                {}};
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const validate::Validation& found = sets[i].validation;
        table.rows.push_back({count_of(i + 1), name_of(sets[i]), count_of(found.lost.size()),
                              count_of(found.false_parts.size()), count_of(found.merged.size()),
                              count_of(found.constrictions.size()), count_of(found.widths.size()),
                              count_of(found.positions.size())});
    }
    std::vector<const ValidatedDataSet*> counted; // independent of units
    for (const ValidatedDataSet& set : sets) counted.push_back(&set);
    if (sets.size() > 1)
        for (const auto& [what, name] : kSummaries) {
            const ValidationSummary all = summary_of(counted, what);
            table.rows.push_back(
                {"", name, all.lost, all.false_parts, all.merged, all.constrictions, all.widths, all.positions});
        }
    return table;
}

Table fidelity_table(std::span<const ValidatedDataSet> sets) {
    Table table{"How well the surface follows the tree",
                {{"data_set", "No."},
                 {"tree", "Tree"},
                 {"points_outside_percent", "Points outside, %"},
                 {"axis_offset_median", "Axis off, median, mm"},
                 {"axis_offset_95", "95th percentile, mm"},
                 {"axis_offset_max", "Largest, mm"},
                 {"radius_error_median_percent", "Radius error, median %"},
                 {"radius_error_95_percent", "95th percentile %"}},
                {}};
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const validate::Fidelity& fidelity = sets[i].validation.fidelity;
        const validate::RadiusError& error = sets[i].validation.radius_error;
        std::vector<Cell> row{count_of(i + 1), name_of(sets[i]), outside_percent(fidelity)};
        if (error.places > 0)
            row.insert(row.end(), {fidelity.offset_median_mm, fidelity.offset_p95_mm, fidelity.offset_max_mm,
                                   100.0 * error.median, 100.0 * error.p95});
        while (row.size() < table.columns.size()) row.emplace_back(kNothing);
        table.rows.push_back(std::move(row));
        table.rows.back().emplace_back(unit_of(sets[i]));
    }
    table.columns.push_back(unit_column());
    const auto percent = [](std::optional<double> share) { return share ? 100.0 * *share : kNothing; };
    add_summaries(table, sets, [&](const auto& group, Of what) -> std::optional<std::vector<Cell>> {
        const ValidationSummary all = summary_of(group, what);
        return {{all.points_outside_percent, or_nothing(all.offset_median), or_nothing(all.offset_p95),
                 or_nothing(all.offset_max), percent(all.radius_median), percent(all.radius_p95)}};
    });
    return table;
}

Table volumes_table(std::span<const ValidatedDataSet> sets) {
    Table table{"Volumes",
                {{"data_set", "No."},
                 {"tree", "Tree"},
                 {"surface_volume", "Surface, mm\u00b3"},
                 {"mask_volume", "Mask, mm\u00b3"},
                 {"dice", "Dice"},
                 unit_column()},
                {}};
    for (std::size_t i = 0; i < sets.size(); ++i)
        if (const auto& volumes = sets[i].volumes)
            table.rows.push_back({count_of(i + 1), name_of(sets[i]), or_nothing(volumes->surface_mm3),
                                  volumes->mask_mm3, volumes->dice, unit_of(sets[i])});
    add_summaries(table, sets, [&](const auto& group, Of what) -> std::optional<std::vector<Cell>> {
        const ValidationSummary all = summary_of(group, what);
        if (!all.mask_mm3) return std::nullopt;
        return {{or_nothing(all.surface_mm3), or_nothing(all.mask_mm3), or_nothing(all.dice)}};
    });
    return table;
}

Table shape_table(std::span<const ValidatedDataSet> sets) {
    Table table{"How the surface hangs together",
                {{"data_set", "No."},
                 {"tree", "Tree"},
                 {"pieces", "Pieces"},
                 {"pieces_of_tree", "Of the tree"},
                 {"loops", "Loops"},
                 {"loops_of_tree", "Of the tree"}},
                {}};
    const auto number = [](std::int64_t count) { return static_cast<double>(count); };
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const auto& shape = sets[i].validation.shape;
        if (!shape) continue;
        table.rows.push_back({count_of(i + 1), name_of(sets[i]), number(shape->surface.pieces),
                              number(shape->tree.pieces), number(shape->surface.loops), number(shape->tree.loops)});
    }
    return table;
}

std::string text_of(const validate::Shape& shape) {
    const auto counts = [](const mesh::Connectivity& one) {
        return counted(static_cast<std::uint64_t>(one.pieces), "piece", "pieces") + ", " +
               counted(static_cast<std::uint64_t>(one.loops), "loop", "loops");
    };
    return counts(shape.surface) + (shape.as_tree() ? ", as the tree" : "; the tree has " + counts(shape.tree));
}

Table lost_table(const validate::Validation& found) {
    Table table{"Lost branches", {{"place", "Place"}, {"branch", "Branch"}, {"length", "Length, mm"}}, {}};
    add_place_columns(table);
    for (std::size_t i = 0; i < found.lost.size(); ++i) {
        std::vector<Cell> row{place_code(kLostLetter, i), id_of(found.lost[i].branch), found.lost[i].length_mm};
        add_place(row, found.lost[i].at);
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table false_table(const validate::Validation& found) {
    Table table{"False branches", {{"place", "Place"}, {"length", "Length, mm"}}, {}};
    add_place_columns(table);
    for (std::size_t i = 0; i < found.false_parts.size(); ++i) {
        std::vector<Cell> row{place_code(kFalseLetter, i), found.false_parts[i].length_mm};
        add_place(row, found.false_parts[i].at);
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table merged_table(const validate::Validation& found) {
    Table table{"Merged branches",
                {{"place", "Place"}, {"branch", "Branch"}, {"other_branch", "Other branch"}, {"gap", "Gap, mm"}},
                {}};
    add_place_columns(table);
    for (std::size_t i = 0; i < found.merged.size(); ++i) {
        const validate::Merged& one = found.merged[i];
        std::vector<Cell> row{place_code(kMergedLetter, i), id_of(one.branches[0]), id_of(one.branches[1]), one.gap_mm};
        add_place(row, one.at);
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table constrictions_table(const validate::Validation& found) {
    return radii_table("Changed constrictions", found.constrictions, kConstrictionLetter);
}

Table widths_table(const validate::Validation& found) {
    Table table = radii_table("Changed widths", found.widths, kWidthLetter);
    table.columns.insert(table.columns.begin() + 2, {"length", "Length, mm"});
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        table.rows[i].insert(table.rows[i].begin() + 2, found.widths[i].length_mm);
    return table;
}

Table positions_table(const validate::Validation& found) {
    Table table{"Moved branches",
                {{"place", "Place"}, {"branch", "Branch"}, {"length", "Length, mm"}, {"offset", "Off, mm"}},
                {}};
    add_place_columns(table);
    for (std::size_t i = 0; i < found.positions.size(); ++i) {
        const validate::Offset& one = found.positions[i];
        std::vector<Cell> row{place_code(kPositionLetter, i), id_of(one.branch), one.length_mm, one.offset_mm};
        add_place(row, one.at);
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table farthest_table(const ValidatedDataSet& set, Held how) {
    Table table{"Farthest: " + title_of(how),
                {{"place", "Place"}, {"branch", "Nearest branch"}, {"distance", "Distance, mm"}},
                {}};
    add_place_columns(table);
    const SurfaceDistances* distances = distances_of(set, how);
    if (distances == nullptr) return table;
    for (std::size_t i = 0; i < distances->farthest.size(); ++i) {
        const FarPlace& far = distances->farthest[i];
        const std::string code = how == Held::kToCones ? place_code(kFarLetter, i) : std::to_string(i + 1);
        std::vector<Cell> row{code, id_of(far.branch), far.distance_mm};
        add_place(row, far.at);
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table worst_branches_table(const ValidatedDataSet& set, std::size_t most) {
    Table table{"Branches whose radius is most off",
                {{"branch", "Branch"},
                 {"error_percent", "Error, %"},
                 {"along", "At, mm"},
                 {"input_radius", "Read, mm"},
                 {"surface_radius", "Surface, mm"},
                 {"cones_radius", "Cones, mm"}},
                {}};
    if (!set.mask_radii_mm.empty()) table.columns.push_back({"mask_radius", "Mask, mm"});
    add_place_columns(table);
    for (const validate::BranchError& branch : validate::worst_branches(set.validation, most)) {
        const validate::RadiusPlace& place = set.validation.radii[branch.worst];
        std::vector<Cell> row{
            id_of(branch.branch), 100.0 * branch.error,
            place.along_mm,       place.input_mm,
            place.surface_mm,     set.cones_radii_mm.empty() ? kNothing : set.cones_radii_mm[branch.worst]};
        if (!set.mask_radii_mm.empty()) row.emplace_back(set.mask_radii_mm[branch.worst]);
        add_place(row, place.at);
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table for_people(Table table) {
    const auto is_empty = [](const Cell& cell) { return cell.number ? std::isnan(*cell.number) : cell.text.empty(); };
    for (std::size_t c = table.columns.size(); c-- > 0;) {
        if (!std::ranges::all_of(table.rows, [&](const std::vector<Cell>& row) { return is_empty(row[c]); })) continue;
        const auto at = static_cast<std::ptrdiff_t>(c);
        table.columns.erase(table.columns.begin() + at);
        for (std::vector<Cell>& row : table.rows) row.erase(row.begin() + at);
    }
    constexpr double kNoLength = 5e-5; // mm: less than a tenth of a micrometre
    for (std::vector<Cell>& row : table.rows)
        for (Cell& cell : row)
            if (cell.number && std::abs(*cell.number) < kNoLength) cell = 0;
    return table;
}

Table all_distances_table(std::span<const ValidatedDataSet> sets) {
    Table all;
    for (const Held how : {Held::kToCones, Held::kToMask, Held::kFromMask}) {
        Table table = distance_table(sets, how);
        table.columns.insert(table.columns.begin() + 2, {"distance", "Distance"});
        all.columns = table.columns;
        for (std::vector<Cell>& row : table.rows) {
            row.insert(row.begin() + 2, title_of(how));
            all.rows.push_back(std::move(row));
        }
    }
    return all;
}

Table all_places_table(std::span<const ValidatedDataSet> sets) {
    Table all{"Places",
              {{"data_set", "No."},
               {"question", "Question"},
               {"branch", "Branch"},
               {"other_branch", "Other branch"},
               {"x", "x, mm"},
               {"y", "y, mm"},
               {"z", "z, mm"},
               {"length", "Length, mm"},
               {"gap", "Gap, mm"},
               {"offset", "Off, mm"},
               {"expected_radius", "Radius should be, mm"},
               {"radius", "Radius is, mm"},
               unit_column()},
              {}};
    for (std::size_t n = 0; n < sets.size(); ++n) {
        const validate::Validation& found = sets[n].validation;
        const std::pair<const char*, Table> parts[] = {
            {"lost", lost_table(found)},     {"false", false_table(found)},
            {"merged", merged_table(found)}, {"constriction", constrictions_table(found)},
            {"width", widths_table(found)},  {"position", positions_table(found)}};
        for (const auto& [question, part] : parts)
            for (const std::vector<Cell>& from : part.rows) {
                std::vector<Cell> row{count_of(n + 1), question};
                fill(all, row);
                for (std::size_t c = 0; c < part.columns.size(); ++c)
                    for (std::size_t to = 2; to < all.columns.size(); ++to)
                        if (all.columns[to].name == part.columns[c].name) row[to] = from[c];
                row.back() = unit_of(sets[n]);
                all.rows.push_back(std::move(row));
            }
    }
    return all;
}

Table files_table(std::span<const ValidatedDataSet> sets) {
    Table table{"Files", {{"data_set", "No."}, {"role", "What"}, {"file", "File"}, {"sha256", "SHA-256"}}, {}};
    for (std::size_t n = 0; n < sets.size(); ++n)
        for (const InputFile& file : sets[n].files)
            table.rows.push_back({count_of(n + 1), file.role, file.path, file.sha256});
    return table;
}

} // namespace ramus::app
