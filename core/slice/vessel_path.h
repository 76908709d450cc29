// VesselPath: a way along centerlines, resampled at equal steps of arc length, with a frame at each sample. Sections
// across a vessel and pictures along it are made of these samples.
//
// Method. The file's centerline is smoothed by Gaussians over its arc length; beyond the ends the curve continues by
// point reflection, so that the ends stay.
// - Positions: standard deviation of half a radius, but at most two voxels. No position moves by more than half of the
//   smallest voxel spacing. Without known voxels positions are not smoothed.
// - Tangents: the direction of the positions, smoothed with a standard deviation of one radius, but of no more than a
//   third of the distance from the nearer end; and of at least a quarter of a radius, one and a half voxels and two
//   steps.
// - Frames: rotation minimising, by double reflection (W. Wang, B. Juettler, D. Zheng, Y. Liu, "Computation of rotation
//   minimizing frames", ACM TOG 27 (1), 2008). At the first sample `right` and `down` are those of axes_across().
//
// Guarantees: samples are equally spaced in arc length, the last one is the end of the way. Tangents, `right` and
// `down` are of unit length and at right angles; `to_viewer()` has the same sign along the tangent at all samples. On
// an arc of a circle tangents are exact, but within three quarters of a radius of the ends they lean towards the chord.
// Radii are those of the file. Not guaranteed: that planes across the tangents of neighbouring samples do not intersect
// within a wide picture. Units: mm.
#pragma once

#include "core/base/error.h"
#include "core/measure/branch_point.h"
#include "core/slice/pixel_grid.h"
#include "core/tree/vessel_tree.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace ramus::slice {

struct PathSample {
    glm::dvec3 at{0.0};
    glm::dvec3 tangent{0.0, 0.0, 1.0}; // towards the end of the way
    Axes axes;                         // at right angles to the tangent
    double radius_mm = 0.0;
    double arc_mm = 0.0; // from the start
    measure::BranchPlace place;

    [[nodiscard]] Plane plane() const { return {at, tangent}; }
};

// The part of one branch on a way.
struct PathPart {
    int branch = tree::kNoBranch;
    double from = 0.0, to = 1.0;       // fractions; from > to: against the branch's direction
    double begin_mm = 0.0, end_mm = 0; // arc lengths
};

struct VesselPath {
    std::vector<PathSample> samples; // at least two
    std::vector<PathPart> parts;     // from the start to the end
    double step_mm = 0.0;            // arc length from a sample to the next

    [[nodiscard]] double length_mm() const { return samples.back().arc_mm; }
    [[nodiscard]] bool uses(int branch) const;
    // Interpolates between samples; `arc_mm` is clamped to the way.
    [[nodiscard]] PathSample at(double arc_mm) const;
    // The arc length at a place; none if the way does not lead through it.
    [[nodiscard]] std::optional<double> arc_of(const measure::BranchPlace& place) const;
    // The sample that is nearest to an arc length.
    [[nodiscard]] std::size_t nearest(double arc_mm) const;
};

// The step is the greatest that divides the way's length and is not above `step_mm` (0: half of the smallest voxel
// spacing of the tree; 0.5 mm without voxels). All fail on a branch that the tree does not have, and on a step that is
// not positive or needs more than a million samples.
[[nodiscard]] Result<VesselPath> path_of_branch(const tree::VesselTree& tree, int branch, double step_mm = 0.0);
// From the root along the hierarchy to the end of a branch.
[[nodiscard]] Result<VesselPath> path_from_root(const tree::VesselTree& tree, int branch, double step_mm = 0.0);
// The shortest way, through loops, too. Fails if the places are equal or not connected.
[[nodiscard]] Result<VesselPath> path_between(const tree::VesselTree& tree, const measure::BranchPlace& from,
                                              const measure::BranchPlace& to, double step_mm = 0.0);

} // namespace ramus::slice
