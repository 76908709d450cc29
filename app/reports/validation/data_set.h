// Results of validating one data set (a tree with its surface and optionally a mask) for tables, plots and pages, and
// averages over several data sets. mm, RAS.
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

// A vertex of one surface that is far from the other surface.
struct FarPlace {
    glm::dvec3 at{0.0};
    double distance_mm = 0.0;
    int branch = 0; // with the nearest centerline
};

// Distances from the vertices of one surface to another surface.
struct SurfaceDistances {
    measure::DeviationStatistics statistics;
    std::vector<FarPlace> farthest; // farthest first
    // For cones: statistics without the vertices beyond free ends, where a cone ends in half a sphere and the
    // convolution surface by the paper's sum. None: these vertices are unknown.
    std::optional<measure::DeviationStatistics> but_for_ends{};
};

// Volumes of the surface and the mask.
struct Volumes {
    std::optional<double> surface_mm3; // of the surface; none if it is not closed
    double mask_mm3 = 0.0;             // of the voxels
    double dice = 0.0;                 // Dice coefficient of their voxels
};

struct InputFile {
    std::string role; // "tree"
    std::string path;
    std::string sha256; // core/io/checksum.h
};

struct ValidatedDataSet {
    std::string tree, surface, mask; // files as named by the user; empty: surface computed, no mask
    tree::Claims claims;             // of the tree
    SurfaceDistances to_cones;
    std::optional<SurfaceDistances> to_mask, from_mask; // to and from the mask's isosurface
    std::optional<Volumes> volumes;                     // if there is a mask
    std::optional<double> half_voxel_mm;                // half the diagonal of the mask's voxels
    validate::Validation validation;
    // At the places of `validation.radii`; empty: not requested.
    std::vector<double> cones_radii_mm, mask_radii_mm;
    std::vector<InputFile> files;
    std::vector<ReportPicture> pictures;
    std::vector<ReportPicture> close_ups; // of the first findings of the questions
};

[[nodiscard]] std::string name_of(const ValidatedDataSet& set); // file name of the tree, without its folder
// The format of lengths for all data sets: mm if all trees claim mm.
[[nodiscard]] Lengths lengths_of(std::span<const ValidatedDataSet> sets);

// Data sets with the same unit of length. Data sets of different units are never averaged.
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

// The statistic over data sets: mean, or standard deviation of a sample (divided by n - 1; 0 for one data set).
enum class Of { kMean, kDeviation };

// The statistic of each figure with equal weight for every data set, whatever its number of vertices: the mean of the
// means, of the standard deviations and so on, as for the ten trees of the paper's Table I; not the figures of all
// vertices together. `above_percent` is set if all data sets have it. `all` must not be empty.
[[nodiscard]] DistanceFigures summary_of(std::span<const DistanceFigures> all, Of what);

struct ValidationSummary {
    std::size_t data_sets = 0;
    DistanceFigures to_cones;
    std::optional<DistanceFigures> to_mask, from_mask; // if all have a mask
    std::optional<double> surface_mm3, mask_mm3, dice; // of the data sets that have them
    std::optional<double> radius_median, radius_p95;   // over data sets with suitable places
    double points_outside_percent = 0.0;
    std::optional<double> offset_median, offset_p95, offset_max; // over the same data sets; mm
    double lost = 0.0, false_parts = 0.0, merged = 0.0, constrictions = 0.0, widths = 0.0, positions = 0.0;
};
// Summary of a unit group, or of a subset of it. Must not be empty.
[[nodiscard]] ValidationSummary summary_of(std::span<const ValidatedDataSet* const> sets, Of what);

[[nodiscard]] double outside_percent(const validate::Fidelity& fidelity);

} // namespace ramus::app
