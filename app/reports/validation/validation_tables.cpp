#include "app/reports/validation/validation_tables.h"

#include "app/reports/validation/branch_radii.h"
#include "core/base/words.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

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

// Nothing in the columns that the row does not reach.
void fill(const Table& table, std::vector<Cell>& row) {
    while (row.size() < table.columns.size()) row.emplace_back("");
}

Table constriction_table(const std::string& title, const std::vector<validate::Constriction>& list, bool coded) {
    Table table{title, {{"place", "Place"}, {"branch", "Branch"}}, {}};
    add_place_columns(table);
    table.columns.insert(table.columns.end(),
                         {{"expected_radius_mm", "Radius should be, mm"}, {"radius_mm", "Radius is, mm"}});
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string code = coded ? place_code(kConstrictionLetter, i) : std::to_string(i + 1);
        std::vector<Cell> row{code, id_of(list[i].branch)};
        add_place(row, list[i].at);
        row.insert(row.end(), {list[i].expected_radius_mm, list[i].radius_mm});
        table.rows.push_back(std::move(row));
    }
    return table;
}

} // namespace

std::string noun_of(HeldAgainst other) {
    return other == HeldAgainst::kCones ? "truncated cones" : "isosurface of the mask";
}

const SurfaceDistances* distances_of(const ValidatedDataSet& set, HeldAgainst other) {
    if (other == HeldAgainst::kCones) return &set.to_cones;
    return set.to_mask ? &*set.to_mask : nullptr;
}

std::string place_code(char letter, std::size_t index) { return std::string(1, letter) + std::to_string(index + 1); }

Table distance_table(std::span<const ValidatedDataSet> sets, HeldAgainst other) {
    Table table{"Surface to " + noun_of(other),
                {{"data_set", "No."},
                 {"tree", "Tree"},
                 {"vertices", "Vertices"},
                 {"mean_mm", "Mean, mm"},
                 {"sigma_mm", "Sigma, mm"},
                 {"rms_mm", "RMS, mm"},
                 {"min_mm", "Min, mm"},
                 {"max_mm", "Max, mm"},
                 {"median_mm", "Median, mm"},
                 {"percentile_95_mm", "95th percentile, mm"},
                 {"above_percent", "Above half a voxel, %"},
                 {"half_voxel_mm", "Half a voxel, mm"}},
                {}};
    std::vector<DistanceFigures> all;
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const SurfaceDistances* distances = distances_of(sets[i], other);
        if (distances == nullptr) continue;
        all.push_back(figures_of(distances->statistics));
        std::vector<Cell> row{count_of(i + 1), name_of(sets[i]), static_cast<double>(distances->statistics.count)};
        add_figures(row, all.back());
        row.emplace_back(or_nothing(sets[i].half_voxel_mm));
        table.rows.push_back(std::move(row));
    }
    if (sets.size() > 1 && !all.empty()) {
        std::vector<Cell> row{"", "average", ""};
        add_figures(row, mean_of(all));
        fill(table, row);
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table questions_table(std::span<const ValidatedDataSet> sets) {
    Table table{"The four questions, and radii",
                {{"data_set", "No."},
                 {"tree", "Tree"},
                 {"lost", "Lost"},
                 {"false", "False"},
                 {"merged", "Merged"},
                 {"constrictions", "Changed constrictions"},
                 {"smoothed_away", "Smoothed away"},
                 {"radius_error_median_percent", "Radius error, median %"},
                 {"radius_error_95_percent", "95th percentile %"}},
                {}};
    const auto percent = [](std::optional<double> share) { return share ? 100.0 * *share : kNothing; };
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const validate::Validation& found = sets[i].validation;
        const validate::RadiusError& error = found.radius_error;
        const bool has = error.places > 0;
        table.rows.push_back({count_of(i + 1), name_of(sets[i]), count_of(found.lost.size()),
                              count_of(found.false_parts.size()), count_of(found.merged.size()),
                              count_of(found.constrictions.size()), count_of(found.smoothed_away.size()),
                              has ? 100.0 * error.median : kNothing, has ? 100.0 * error.p95 : kNothing});
    }
    if (sets.size() > 1) {
        const ValidationAverages mean = averages_of(sets);
        table.rows.push_back({"", "average", mean.lost, mean.false_parts, mean.merged, mean.constrictions,
                              mean.smoothed_away, percent(mean.radius_median), percent(mean.radius_p95)});
    }
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
    Table table{"Lost branches", {{"place", "Place"}, {"branch", "Branch"}, {"length_mm", "Length, mm"}}, {}};
    add_place_columns(table);
    for (std::size_t i = 0; i < found.lost.size(); ++i) {
        std::vector<Cell> row{place_code(kLostLetter, i), id_of(found.lost[i].branch), found.lost[i].length_mm};
        add_place(row, found.lost[i].at);
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table false_table(const validate::Validation& found) {
    Table table{"False branches", {{"place", "Place"}, {"length_mm", "Length, mm"}}, {}};
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
                {{"place", "Place"}, {"branch", "Branch"}, {"other_branch", "Other branch"}, {"gap_mm", "Gap, mm"}},
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
    return constriction_table("Changed constrictions", found.constrictions, true);
}

Table smoothed_away_table(const validate::Validation& found) {
    return constriction_table("Narrow places that smoothing changes", found.smoothed_away, false);
}

Table farthest_table(const ValidatedDataSet& set, HeldAgainst other) {
    Table table{"Farthest from the " + noun_of(other),
                {{"place", "Place"}, {"branch", "Nearest branch"}, {"distance_mm", "Distance, mm"}},
                {}};
    add_place_columns(table);
    const SurfaceDistances* distances = distances_of(set, other);
    if (distances == nullptr) return table;
    for (std::size_t i = 0; i < distances->farthest.size(); ++i) {
        const FarPlace& far = distances->farthest[i];
        const std::string code = other == HeldAgainst::kCones ? place_code(kFarLetter, i) : std::to_string(i + 1);
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
                 {"along_mm", "At, mm"},
                 {"input_radius_mm", "Read, mm"},
                 {"surface_radius_mm", "Surface, mm"},
                 {"cones_radius_mm", "Cones, mm"}},
                {}};
    if (!set.mask_radii_mm.empty()) table.columns.push_back({"mask_radius_mm", "Mask, mm"});
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
    constexpr double kNoLength = 1e-5; // mm: ten nanometres
    for (std::vector<Cell>& row : table.rows)
        for (Cell& cell : row)
            if (cell.number && std::abs(*cell.number) < kNoLength) cell = 0;
    return table;
}

Table all_distances_table(std::span<const ValidatedDataSet> sets) {
    Table all;
    for (const HeldAgainst other : {HeldAgainst::kCones, HeldAgainst::kMask}) {
        Table table = distance_table(sets, other);
        table.columns.insert(table.columns.begin() + 2, {"to", "To"});
        all.columns = table.columns;
        for (std::vector<Cell>& row : table.rows) {
            row.insert(row.begin() + 2, noun_of(other));
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
               {"length_mm", "Length, mm"},
               {"gap_mm", "Gap, mm"},
               {"expected_radius_mm", "Radius should be, mm"},
               {"radius_mm", "Radius is, mm"}},
              {}};
    for (std::size_t n = 0; n < sets.size(); ++n) {
        const validate::Validation& found = sets[n].validation;
        const std::pair<const char*, Table> parts[] = {{"lost", lost_table(found)},
                                                       {"false", false_table(found)},
                                                       {"merged", merged_table(found)},
                                                       {"constriction", constrictions_table(found)},
                                                       {"smoothed_away", smoothed_away_table(found)}};
        for (const auto& [question, part] : parts)
            for (const std::vector<Cell>& from : part.rows) {
                std::vector<Cell> row{count_of(n + 1), question};
                fill(all, row);
                for (std::size_t c = 0; c < part.columns.size(); ++c)
                    for (std::size_t to = 2; to < all.columns.size(); ++to)
                        if (all.columns[to].name == part.columns[c].name) row[to] = from[c];
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
