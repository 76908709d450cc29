// Tables of validation results for CSV and pages: the paper's Table I, the four questions with their places, the worst
// places, the files. Data sets are numbered from 1 in the given order.
#pragma once

#include "app/reports/report_tables.h"
#include "app/reports/validation/data_set.h"

#include <cstddef>
#include <span>
#include <string>

namespace ramus::app {

enum class Held { kToCones, kToMask, kFromMask };
[[nodiscard]] std::string title_of(Held how); // "Surface to truncated cones"
// Null: the data set has no mask.
[[nodiscard]] const SurfaceDistances* distances_of(const ValidatedDataSet& set, Held how);

// "L3": identifies a place in pictures and in the first column of tables; `index` from 0.
[[nodiscard]] std::string place_code(char letter, std::size_t index);
inline constexpr char kLostLetter = 'L', kFalseLetter = 'F', kMergedLetter = 'M', kConstrictionLetter = 'C',
                      kWidthLetter = 'W', kPositionLetter = 'P', kFarLetter = 'D';

// The tables of data sets have the column `unit`, and averages for each unit (data_set.h); those of one data set have
// it when add_unit() was called.

// One row per data set; for several also average and standard deviation. Empty if none has a mask.
[[nodiscard]] Table distance_table(std::span<const ValidatedDataSet> sets, Held how);
// Number of places per question; one row per data set.
[[nodiscard]] Table questions_table(std::span<const ValidatedDataSet> sets);
// How well each surface follows its tree: points outside, offsets of the axis, errors of the radius. One row per data
// set.
[[nodiscard]] Table fidelity_table(std::span<const ValidatedDataSet> sets);
// Volumes of surface and mask, and their overlap; one row per mask. Empty without masks.
[[nodiscard]] Table volumes_table(std::span<const ValidatedDataSet> sets);
// Pieces and loops of each surface and of its tree. Empty if all surfaces are cones.
[[nodiscard]] Table shape_table(std::span<const ValidatedDataSet> sets);
[[nodiscard]] std::string text_of(const validate::Shape& shape); // "1 piece, 2 loops; the tree has 1 piece, 0 loops"

// Tables of one data set, with the codes of its places.
[[nodiscard]] Table lost_table(const validate::Validation& found);
[[nodiscard]] Table false_table(const validate::Validation& found);
[[nodiscard]] Table merged_table(const validate::Validation& found);
[[nodiscard]] Table constrictions_table(const validate::Validation& found);
[[nodiscard]] Table widths_table(const validate::Validation& found);
[[nodiscard]] Table positions_table(const validate::Validation& found);
[[nodiscard]] Table farthest_table(const ValidatedDataSet& set, Held how);
[[nodiscard]] Table worst_branches_table(const ValidatedDataSet& set, std::size_t most);

// Removes columns without values, and rounds numbers below 10 nm, which are meaningless for vessels, to 0.
[[nodiscard]] Table for_people(Table table);

// For CSV: all distance tables, all places of all questions, and the files.
[[nodiscard]] Table all_distances_table(std::span<const ValidatedDataSet> sets);
[[nodiscard]] Table all_places_table(std::span<const ValidatedDataSet> sets);
[[nodiscard]] Table files_table(std::span<const ValidatedDataSet> sets);

} // namespace ramus::app
