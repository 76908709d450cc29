// MarksChange: the difference between two values of Marks, both ways, in little memory: a step of the history costs
// what it changed (app/session/member_change.h), however large the tree is.
//
// between(a, b) applied forward to `a` gives `b`, backward to `b` gives `a`, exactly; other values are not allowed.
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

    // The ids of branches mean other branches afterwards.
    [[nodiscard]] bool edits_tree() const { return change_of(&Marks::edits) || change_of(&Marks::reading); }
    [[nodiscard]] bool selects() const { return change_of(&Marks::selection) != nullptr; }
    // The branches whose state differs, ascending.
    [[nodiscard]] std::vector<int> restated() const;

private:
    struct Part {
        const MarksRow* row;
        std::shared_ptr<const MemberChange> change;
    };
    template <class T> [[nodiscard]] const MemberChange* change_of(T Marks::*member) const { // null: it is the same
        for (const Part& part : parts_)
            if (part.row->is(member)) return part.change.get();
        return nullptr;
    }

    std::vector<Part> parts_; // of the members that differ
};

} // namespace ramus::app
