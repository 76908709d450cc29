// What validation found of one data set, a tree with its surface and perhaps its mask, as tables, plots and pages need
// it; and what all data sets have on average. mm, RAS.
#pragma once

#include "app/reports/html.h"
#include "app/session/numbers.h"
#include "core/measure/deviation/deviation.h"
#include "core/validate/validation.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ramus::app {

// A vertex of the surface that is far from the other one.
struct FarPlace {
    glm::dvec3 at{0.0};
    double distance_mm = 0.0;
    int branch = 0; // whose centerline is nearest
};

// From the vertices of one surface to another one.
struct SurfaceDistances {
    measure::DeviationStatistics statistics;
    std::vector<FarPlace> farthest; // the farthest first
    // Of cones: without the vertices beyond free ends of vessels, where a cone has half a ball and the surface ends by
    // the paper's sum. None: it is not known which those are.
    std::optional<measure::DeviationStatistics> but_for_ends{};
};

// Of the surface and the mask.
struct Volumes {
    std::optional<double> surface_mm3; // inside of the surface; none of one that is not closed
    double mask_mm3 = 0.0;             // of the voxels
    double dice = 0.0;                 // Dice's coefficient of their voxels
};

struct InputFile {
    std::string role; // "tree"
    std::string path;
    std::string sha256; // core/io/checksum.h
};

struct ValidatedDataSet {
    std::string tree, surface, mask; // files as they were named; empty: the surface was made, there is no mask
    tree::Claims claims;             // of the tree
    SurfaceDistances to_cones;
    std::optional<SurfaceDistances> to_mask, from_mask; // to the mask's isosurface, and from it to the surface
    std::optional<Volumes> volumes;                     // with a mask
    std::optional<double> half_voxel_mm;                // half the diagonal of the mask's voxels
    validate::Validation validation;
    // At the places of `validation.radii`; empty: not asked for.
    std::vector<double> cones_radii_mm, mask_radii_mm;
    std::vector<InputFile> files;
    std::vector<ReportPicture> pictures;
    std::vector<ReportPicture> close_ups; // of places that answer the questions, the first of them
};

[[nodiscard]] std::string name_of(const ValidatedDataSet& set); // of its tree's file, without the folder
// How people are told of all of them: in mm where all trees say so.
[[nodiscard]] Lengths lengths_of(std::span<const ValidatedDataSet> sets);

// Data sets whose lengths are in one unit. Those of different units are never averaged together.
struct UnitGroup {
    std::string unit;                          // "mm" or "unknown"
    std::vector<const ValidatedDataSet*> sets; // not empty
};
[[nodiscard]] std::vector<UnitGroup> by_unit(std::span<const ValidatedDataSet> sets); // mm first

// The figures of the paper's Table I, with the 95th percentile.
struct DistanceFigures {
    double mean = 0.0, sigma = 0.0, rms = 0.0, min = 0.0, max = 0.0, median = 0.0, percentile_95 = 0.0;
    std::optional<double> above_percent; // above half a voxel's diagonal
};
[[nodiscard]] DistanceFigures figures_of(const measure::DeviationStatistics& statistics);

// What is said of a figure of several data sets: its mean, or its standard deviation (of a sample: divided by one less
// than there are; 0 of one).
enum class Of { kMean, kDeviation };

// Of each figure, every data set weighing the same, however many vertices it has: the mean of the means, of the
// standard deviations, of the least and largest distances, as the paper's Table I has them of its ten trees. Not the
// figures of all vertices together. The share above half a voxel is there when all have it. `all` is not empty.
[[nodiscard]] DistanceFigures summary_of(std::span<const DistanceFigures> all, Of what);

struct ValidationSummary {
    std::size_t data_sets = 0;
    DistanceFigures to_cones;
    std::optional<DistanceFigures> to_mask, from_mask; // when all have a mask
    std::optional<double> surface_mm3, mask_mm3, dice; // of the data sets that have them
    std::optional<double> radius_median, radius_p95;   // of the data sets that have places for it
    double points_outside_percent = 0.0;
    std::optional<double> offset_median, offset_p95, offset_max; // of the same data sets; mm
    double lost = 0.0, false_parts = 0.0, merged = 0.0, constrictions = 0.0, widths = 0.0, positions = 0.0;
};
// Of a group, or of a part of one that has what is looked for. Not empty.
[[nodiscard]] ValidationSummary summary_of(std::span<const ValidatedDataSet* const> sets, Of what);

[[nodiscard]] double outside_percent(const validate::Fidelity& fidelity);

} // namespace ramus::app
