// Moves marks and camera to another tree, after the tree was edited or its file was read with other options.
#pragma once

#include "app/session/session.h"
#include "core/tree/edit_tree.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace ramus::app {

// For each branch of `before`, the identical branch of `after`, or kNoBranch. If all branches of both trees have equal
// shape, ids are kept; otherwise branches match if their ends, points and middle are at the same places.
[[nodiscard]] std::vector<int> same_branches(const tree::VesselTree& before, const tree::VesselTree& after);

// Maps branches of one tree to branches of another. Both trees must outlive the map.
class BranchMap {
public:
    // For the same file, read with other options.
    [[nodiscard]] static BranchMap read_again(const tree::VesselTree& before, const tree::VesselTree& after);
    [[nodiscard]] static BranchMap edited(const tree::VesselTree& before, const tree::EditedTree& after);

    // The branches that `branch` became, nearest to the root first; empty: it is gone.
    [[nodiscard]] const std::vector<int>& became(int branch) const;
    // The subset of became() whose largest part comes from `branch`.
    [[nodiscard]] const std::vector<int>& mostly(int branch) const;
    // The same place on the tree after; none if its branch is gone or no vessel is there any more.
    [[nodiscard]] std::optional<measure::BranchPlace> place(const measure::BranchPlace& place) const;

    [[nodiscard]] bool was_edited() const { return was_edited_; }
    [[nodiscard]] const tree::VesselTree& before() const { return *before_; }
    [[nodiscard]] const tree::VesselTree& after() const { return *after_; }

private:
    using Lists = std::vector<std::vector<int>>; // by branch of the tree before
    BranchMap(const tree::VesselTree& before, const tree::VesselTree& after, bool was_edited)
        : before_(&before), after_(&after), became_(before.branches.size()), was_edited_(was_edited) {}
    [[nodiscard]] static const std::vector<int>& in(const Lists& lists, int branch);

    const tree::VesselTree *before_, *after_;
    Lists became_, mostly_; // `mostly_` is empty if it equals `became_`
    bool was_edited_ = false, same_shape_ = false;
};

struct CarriedOver {
    Marks marks;
    std::size_t lost = 0; // marks of branches that are gone
};
// Moves `marks` to the tree after `map`. Marks on branches follow their branches; positions in mm stay. After rereading
// a file, completely hidden systems stay hidden, and default margins and limits are replaced by those of the new tree.
[[nodiscard]] CarriedOver carried_over(const Marks& marks, const BranchMap& map);

// The same way on the tree after; none if one of its ends is gone, or a whole branch was divided.
[[nodiscard]] std::optional<Way> carried_over(const Way& way, const BranchMap& map);

// If the comparison's mask is the file that the tree was made from, both get the same unit.
void follow_unit(Marks& marks, const TreeFile& file);

// A camera that shows `after` as `camera` shows `before`, from the same side and at the same size, if one tree is a
// moved and scaled version of the other.
[[nodiscard]] render::Camera carried_over(const render::Camera& camera, const tree::VesselTree& before,
                                          const tree::VesselTree& after);

} // namespace ramus::app
