// What becomes of marks and camera when the tree that they belong to is edited, or read again in another way.
#pragma once

#include "app/session/session.h"
#include "core/tree/edit_tree.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace ramus::app {

// For each branch of `before` the same branch of `after`, or kNoBranch. Where both trees have branches of the same
// shape, each branch is itself; else one with ends, points and middle at the very same places.
[[nodiscard]] std::vector<int> same_branches(const tree::VesselTree& before, const tree::VesselTree& after);

// Where the branches of one tree are in another.
class BranchMap {
public:
    // The same file, read in another way.
    [[nodiscard]] static BranchMap read_again(const tree::VesselTree& before, const tree::VesselTree& after);
    [[nodiscard]] static BranchMap edited(const tree::VesselTree& before, const tree::EditedTree& after);

    // The branches that `branch` became, the one nearest to the root first; none: it is gone.
    [[nodiscard]] const std::vector<int>& became(int branch) const;
    // Those of them that consist of `branch` more than of any other branch.
    [[nodiscard]] const std::vector<int>& mostly(int branch) const;
    // The same place; none: its branch is gone, or no vessel is there any more.
    [[nodiscard]] std::optional<measure::BranchPlace> place(const measure::BranchPlace& place) const;

    [[nodiscard]] bool was_edited() const { return was_edited_; }
    [[nodiscard]] const tree::VesselTree& before() const { return *before_; }
    [[nodiscard]] const tree::VesselTree& after() const { return *after_; }

private:
    using Lists = std::vector<std::vector<int>>; // by branch before
    BranchMap(const tree::VesselTree& before, const tree::VesselTree& after, bool was_edited)
        : before_(&before), after_(&after), became_(before.branches.size()), was_edited_(was_edited) {}
    [[nodiscard]] static const std::vector<int>& in(const Lists& lists, int branch);

    const tree::VesselTree *before_, *after_;
    Lists became_, mostly_; // `mostly_` is empty where it would be `became_`
    bool was_edited_ = false, same_shape_ = false;
};

struct CarriedOver {
    Marks marks;
    std::size_t lost = 0; // marks of branches that are gone
};
// `marks` on the tree after `map`. What belongs to branches follows them; what has a place in mm stays there. After
// reading the file again a system that is hidden as a whole stays so, and margins and limits that are the usual ones of
// the tree before become those of the tree after.
[[nodiscard]] CarriedOver carried_over(const Marks& marks, const BranchMap& map);

// A mask that the isosurface is of, and the tree was made of, has one unit for both.
void follow_unit(Marks& marks, const TreeFile& file);

// The camera that sees `after` as `camera` sees `before`: from the same side and as large, where one tree is the other
// moved and scaled.
[[nodiscard]] render::Camera carried_over(const render::Camera& camera, const tree::VesselTree& before,
                                          const tree::VesselTree& after);

} // namespace ramus::app
