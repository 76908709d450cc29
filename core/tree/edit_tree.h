// Edits: what a person mends in a tree by hand, as values. A tree goes in, another comes out; nothing is changed in
// place. An edit names branches by their ids, and places by fractions of a branch's length, in the tree as it is before
// the edit: a list of edits applied in order to the tree of a file always gives the same tree.
//
// Guarantees: the result keeps all that VesselTree promises; systems stay apart; branches that an edit does not touch
// keep their points exactly. It does not look at the surface: that two vessels touch is for eyes.
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
        kJoin,     // branches[0] at its free end fractions[0] (0 or 1), with a place of branches[1], by one segment
        kCut,      // takes `value` mm out of branches[0] around fractions[0]; 0: the diameter there
        kDelete,   // takes `branches` away; a node left with two branches becomes an inner point of one
        kMoveRoot, // the root of the piece is the free end of branches[0] nearer to fractions[0]
        kFlip,     // blood runs the other way through branches[0]: the root moves to the thickest end beyond it
        kRadius,   // `branches` get the radius `value`, mm
        kScale,    // the radii of `branches` are multiplied by `value`
    };
    Kind kind = Kind::kCut;
    std::vector<int> branches;         // ids; ascending where order means nothing
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
    // By branch of `tree`: the branches before the edit that it is made of, that with the longest share first. A
    // branch of the new segment alone has none.
    std::vector<std::vector<int>> sources;
};

// A cut takes out what is left of less than a radius on either side as well; where nothing of the branch is left, a
// false connection is gone whole. A part that has lost its root has its own where it was cut.
// Radii: a node shared with other branches keeps its radius unless all branches there are named; a branch of two such
// nodes gets a point between them.
// Fails, and says why, where an id does not exist; join: the first place is no free end, the systems differ, or the
// places are connected already; delete: other branches would be left hanging, or nothing at all; root, flip: there is
// no free end; radius, scale: radii that are not positive or above kMaximumRadius.
[[nodiscard]] Result<EditedTree> apply(const VesselTree& tree, const Edit& edit);

// One after the other. `sources` as of one edit are of no use here, and left out.
[[nodiscard]] Result<VesselTree> apply_all(VesselTree tree, std::span<const Edit> edits);

// How many segments end at each point. 1: a free end.
[[nodiscard]] std::vector<int> degrees(const VesselTree& tree);

// What a cut takes out: fractions of the branch's length, from and to.
struct CutRange {
    double from = 0.0, to = 1.0;
};
[[nodiscard]] CutRange cut_range(const VesselTree& tree, int branch, double fraction, double gap_mm);

} // namespace ramus::tree
