// Computes the loss caused by a set of cuts. A cut divides a branch at a fraction of its length from the parent's end.
// Lost are the parts of the tree that no root reaches any more. In a tree these are the rest of the branch beyond the
// cut and its dependents. In a network with loops one cut may lose nothing, and two cuts may lose together what neither
// loses alone. So the joint loss is found by a search from the roots, and not by adding up.
#pragma once

#include "core/measure/amount.h"

#include <span>
#include <utility>
#include <vector>

namespace ramus::measure {

using Cut = std::pair<int, double>; // branch, and fraction of its length from the parent's end

// The lost part of one branch, as fractions of its length from the parent's end: empty unless from < to.
struct LostSpan {
    double from = 1.0;
    double to = 1.0;
    [[nodiscard]] bool any() const { return from < to; }
    [[nodiscard]] bool whole() const { return from <= 0.0 && to >= 1.0; }
    bool operator==(const LostSpan&) const = default;
};

// By branch: the part lost by all cuts together, for drawing. Empty if there are no cuts. Linear in the size of the
// tree.
[[nodiscard]] std::vector<LostSpan> lost_spans(const tree::VesselTree& tree, std::span<const Cut> cuts);

struct CutFigures {
    double diameter_mm = 0.0; // of the vessel at the cut
    bool reconstruct = false; // the diameter exceeds the limit
    Amount lost;              // by this cut alone; partly lost branches count as branches
};

struct CutReport {
    std::vector<CutFigures> cuts; // in the order given
    Amount together;              // lost by all cuts; nothing is counted twice
    int in_part = 0;              // partly lost branches of `together`
    std::vector<LostSpan> spans;  // lost_spans()
};

// `dependents`: dependent_amounts() of the tree. `reconstruct_mm`: the limit of CutFigures::reconstruct, a diameter.
[[nodiscard]] CutReport cut_report(const tree::VesselTree& tree, const tree::Dependency& dependency,
                                   std::span<const Amount> dependents, std::span<const Cut> cuts,
                                   double reconstruct_mm);

} // namespace ramus::measure
