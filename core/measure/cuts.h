// What a set of cuts costs. A cut divides a branch at a fraction of its length from the parent's end; lost is all that
// the roots do not reach any more. In a tree that is what lies beyond the cut and all that depends on the branch. In a
// network with loops one cut on a way that has another way round loses nothing, while two cuts may lose together what
// neither loses alone: so the part lost by all cuts together is found by walking from the roots, not by adding up.
#pragma once

#include "core/measure/amount.h"

#include <span>
#include <utility>
#include <vector>

namespace ramus::measure {

using Cut = std::pair<int, double>; // branch, and where: of its length from the parent's end, 0 to 1

// The lost part of one branch, as fractions of its length from the parent's end: empty unless from < to.
struct LostSpan {
    double from = 1.0;
    double to = 1.0;
    [[nodiscard]] bool any() const { return from < to; }
    [[nodiscard]] bool whole() const { return from <= 0.0 && to >= 1.0; }
    bool operator==(const LostSpan&) const = default;
};

// By branch, all cuts together: for drawing. Empty when there are no cuts. Linear in the size of the tree.
[[nodiscard]] std::vector<LostSpan> lost_spans(const tree::VesselTree& tree, std::span<const Cut> cuts);

struct CutFigures {
    double diameter_mm = 0.0; // of the vessel at the cut
    bool reconstruct = false; // the vessel is larger than the limit
    Amount lost;              // by this cut alone; branches that are lost in part count as branches
};

struct CutReport {
    std::vector<CutFigures> cuts; // in the order given
    Amount together;              // lost by all cuts, nothing counted twice
    int in_part = 0;              // branches of `together` that are lost in part only
    std::vector<LostSpan> spans;  // lost_spans()
};

// `dependents`: dependent_amounts() of the same tree.
[[nodiscard]] CutReport cut_report(const tree::VesselTree& tree, const tree::Dependency& dependency,
                                   std::span<const Amount> dependents, std::span<const Cut> cuts,
                                   double reconstruct_mm);

} // namespace ramus::measure
