// Grows a synthetic portal vein inside a liver-like volume, for demonstrations, tests and benchmarks. Terminals are
// placed at random, coarse to fine, so that they fill the organ evenly. Each is joined to the tree where that costs the
// least blood volume, with the best place for the new fork (constrained constructive optimisation: Schreiner & Buxbaum,
// IEEE TBME 1993). Forks are then relaxed, and the straight segments are bent into smooth, slightly winding
// centerlines.
//
// Guarantees: exactly the number of branches asked for; at every fork the parent's radius cubed equals the sum of the
// children's cubed (Murray), with one radius along each branch and at its far end; every point but the stem's lies
// inside the organ; vessels touch only near their common fork: where two come closer than the sum of their radii, the
// way between the two points along the tree is at most kJointReach times that sum. The same options give the same
// points on every machine. Not a model of physiology: the terminals' flows are random, not measured.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/tree/vessel_tree.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace ramus::tree {

namespace growth {
class Organ;
class Random;
} // namespace growth

inline constexpr double kJointReach = 3.0;
inline constexpr int kMaxGrownBranches = 1'000'000;

struct GrowOptions {
    int branches = 1504; // 1, 3 or more; a tree of forks has an odd count, so an even one gets one threefold fork
    std::uint64_t seed = 1;
    double organ_width_mm = 214.0; // left to right; the default holds about 1.5 litres
    double root_radius_mm = 6.0;   // of the stem; Murray's law sets all others
    double spacing_mm = 1.0;       // between centerline points, as a voxel-based skeleton has them
    double tortuosity = 1.0;       // 0: straight between forks; 1: gently winding
};

struct GrownTree {
    std::vector<Point> points; // the first is the root; parents come before their children
    std::vector<int> parents;  // index into points; -1 at the root
    double organ_volume_mm3 = 0.0;
    double terminal_radius_mm = 0.0; // mean over the leaves
};

// What is wrong with the options, if anything.
[[nodiscard]] std::optional<Error> wrong_with(const GrowOptions& options);

// Fails on wrong options, on an organ too small for so many branches, and when cancelled.
[[nodiscard]] Result<GrownTree> grow(const GrowOptions& options, Job& job);

// The same in another organ, with its own random numbers. The options must be right (wrong_with()); organ_width_mm is
// not used. Masks: core/organ/grow_in.h.
[[nodiscard]] Result<GrownTree> grow(const GrowOptions& options, const growth::Organ& organ, growth::Random& random,
                                     Job& job);

// The same points with branches and their hierarchy.
[[nodiscard]] VesselTree vessel_tree_of(GrownTree grown);

// Depth of a point below the surface of the organ that these options grow in: positive inside (mm).
[[nodiscard]] std::vector<double> organ_depths_mm(const GrowOptions& options, const std::vector<Point>& points);

} // namespace ramus::tree
