// What validation found, as tables for CSV and pages: the paper's Table I, the four questions with each place, the
// worst places, the files. Data sets have numbers from 1, in the order in which they were given.
#pragma once

#include "app/reports/report_tables.h"
#include "app/reports/validation/data_set.h"

#include <cstddef>
#include <span>
#include <string>

namespace ramus::app {

enum class Held { kToCones, kToMask, kFromMask };
[[nodiscard]] std::string title_of(Held how); // "Surface to truncated cones"
// null: the data set has no mask.
[[nodiscard]] const SurfaceDistances* distances_of(const ValidatedDataSet& set, Held how);

// "L3": what a picture calls a place and a table has in its first column; `index` from 0.
[[nodiscard]] std::string place_code(char letter, std::size_t index);
inline constexpr char kLostLetter = 'L', kFalseLetter = 'F', kMergedLetter = 'M', kConstrictionLetter = 'C',
                      kWidthLetter = 'W', kPositionLetter = 'P', kFarLetter = 'D';

// The tables of data sets have the column `unit`, and averages for each unit (data_set.h); those of one data set have
// it when add_unit() was called.

// A row for each data set, and for several an average and a standard deviation. No rows: none has a mask.
[[nodiscard]] Table distance_table(std::span<const ValidatedDataSet> sets, Held how);
// How many places answer each question; a row for each data set.
[[nodiscard]] Table questions_table(std::span<const ValidatedDataSet> sets);
// How well each surface follows its tree: points outside, offsets of the axis, errors of the radius. A row for each
// data set.
[[nodiscard]] Table fidelity_table(std::span<const ValidatedDataSet> sets);
// Volumes of each surface and its mask, and their overlap; a row for each mask. No rows: there are no masks.
[[nodiscard]] Table volumes_table(std::span<const ValidatedDataSet> sets);
// Pieces and loops of each surface beside its tree's. No rows: all are of cones.
[[nodiscard]] Table shape_table(std::span<const ValidatedDataSet> sets);
[[nodiscard]] std::string text_of(const validate::Shape& shape); // "1 piece, 2 loops; the tree has 1 piece, 0 loops"

// Of one data set, with the codes of its places.
[[nodiscard]] Table lost_table(const validate::Validation& found);
[[nodiscard]] Table false_table(const validate::Validation& found);
[[nodiscard]] Table merged_table(const validate::Validation& found);
[[nodiscard]] Table constrictions_table(const validate::Validation& found);
[[nodiscard]] Table widths_table(const validate::Validation& found);
[[nodiscard]] Table positions_table(const validate::Validation& found);
[[nodiscard]] Table farthest_table(const ValidatedDataSet& set, Held how);
[[nodiscard]] Table worst_branches_table(const ValidatedDataSet& set, std::size_t most);

// Without the columns that have nothing in any row, and 0 for numbers so small that no vessel differs by them (10 nm).
[[nodiscard]] Table for_people(Table table);

// For CSV: all distance tables in one, every place of every question, the files.
[[nodiscard]] Table all_distances_table(std::span<const ValidatedDataSet> sets);
[[nodiscard]] Table all_places_table(std::span<const ValidatedDataSet> sets);
[[nodiscard]] Table files_table(std::span<const ValidatedDataSet> sets);

} // namespace ramus::app
