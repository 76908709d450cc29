// Edits: manual corrections of a tree, as values. apply() takes a tree and returns another one. An edit refers to
// branches by id, and to places by fractions of a branch's length, in the tree before the edit. So a list of edits,
// applied in order to the tree of a file, always gives the same tree.
//
// Guarantees: the result keeps all guarantees of VesselTree; systems are never connected; branches that an edit does
// not touch keep their points exactly. Not guaranteed: edits do not check whether vessels touch on the surface.
#pragma once

#include "core/base/error.h"
#include "core/tree/vessel_tree.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::tree {

struct Edit {
    enum class Kind : std::uint8_t {
        kJoin,     // connects the free end fractions[0] (0 or 1) of branches[0] with a place of branches[1]
        kCut,      // removes `value` mm of branches[0] around fractions[0]; 0: the diameter there
        kDelete,   // removes `branches`; a node that keeps two branches becomes an inner point of one
        kMoveRoot, // moves the root of the piece to the free end of branches[0] nearer to fractions[0]
        kFlip,     // reverses the flow through branches[0]: moves the root to the thickest end beyond it
        kRadius,   // `branches` get the radius `value`, mm
        kScale,    // the radii of `branches` are multiplied by `value`
    };
    Kind kind = Kind::kCut;
    std::vector<int> branches;         // ids; ascending where the order has no meaning
    std::array<double, 2> fractions{}; // of a branch's length from the parent's end
    double value = 0.0;
    bool operator==(const Edit&) const = default;
};

// Names in files and their order: "join", "cut", "delete", "root", "flip", "radius", "scale".
inline constexpr std::pair<Edit::Kind, std::string_view> kEditNames[] = {
    {Edit::Kind::kJoin, "join"},     {Edit::Kind::kCut, "cut"},   {Edit::Kind::kDelete, "delete"},
    {Edit::Kind::kMoveRoot, "root"}, {Edit::Kind::kFlip, "flip"}, {Edit::Kind::kRadius, "radius"},
    {Edit::Kind::kScale, "scale"}};
[[nodiscard]] std::string_view name_of(Edit::Kind kind);

// "branch 12 was cut at 0.4": for comments in files.
[[nodiscard]] std::string sentence(const Edit& edit);

struct EditedTree {
    VesselTree tree;
    // By branch of `tree`: the branches before the edit that it is made of, the longest share first. A branch that
    // consists of the new segment alone has none.
    std::vector<std::vector<int>> sources;
};

// Applies one edit.
// Cut: also removes a rest of the branch of less than a radius on either side, up to the whole branch. A part that
// loses its root gets a root at the cut. Radius, scale: a node shared with other branches keeps its radius unless all
// branches there are named. A branch with no points but two such nodes gets a point between them. Fails, with a
// message, if an id does not exist. Join fails if the first place is no free end, the systems differ, or the places are
// already connected. Delete fails if it would disconnect other branches, or leave nothing. Root and flip fail if there
// is no free end. Radius and scale fail if a radius is not positive or above kMaximumRadius.
[[nodiscard]] Result<EditedTree> apply(const VesselTree& tree, const Edit& edit);

// Applies edits one after the other.
[[nodiscard]] Result<VesselTree> apply_all(VesselTree tree, std::span<const Edit> edits);

// By point: the number of segments that end there. 1: a free end.
[[nodiscard]] std::vector<int> degrees(const VesselTree& tree);

// The part of a branch that a cut removes, as fractions of the branch's length.
struct CutRange {
    double from = 0.0, to = 1.0;
};
[[nodiscard]] CutRange cut_range(const VesselTree& tree, int branch, double fraction, double gap_mm);

} // namespace ramus::tree
