// MarksChange: the difference between two values of Marks, in both directions. A step of the history costs memory in
// proportion to its change (app/session/member_change.h), however large the tree is.
//
// between(a, b) applied forward to `a` gives exactly `b`, backward to `b` gives exactly `a`. It must not be applied to
// other values.
#pragma once

#include "app/session/marks_table.h"

#include <memory>
#include <vector>

namespace ramus::app {

class MarksChange {
public:
    using Direction = ChangeDirection;

    [[nodiscard]] static MarksChange between(const Marks& before, const Marks& after);
    void apply(Marks& marks, Direction direction) const;

    // Whether branch ids refer to other branches afterwards.
    [[nodiscard]] bool edits_tree() const { return change_of(&Marks::edits) || change_of(&Marks::reading); }
    [[nodiscard]] bool selects() const { return change_of(&Marks::selection) != nullptr; }
    // The branches whose state differs, ascending.
    [[nodiscard]] std::vector<int> restated() const;

private:
    struct Part {
        const MarksRow* row;
        std::shared_ptr<const MemberChange> change;
    };
    template <class T> [[nodiscard]] const MemberChange* change_of(T Marks::*member) const { // null: unchanged
        for (const Part& part : parts_)
            if (part.row->is(member)) return part.change.get();
        return nullptr;
    }

    std::vector<Part> parts_; // of the members that differ
};

} // namespace ramus::app
