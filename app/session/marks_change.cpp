#include "app/session/marks_change.h"

namespace ramus::app {

MarksChange MarksChange::between(const Marks& before, const Marks& after) {
    MarksChange change;
    for (const MarksRow& row : marks_table())
        if (!row.same(before, after)) change.parts_.push_back({&row, row.change(before, after)});
    change.parts_.shrink_to_fit();
    return change;
}

void MarksChange::apply(Marks& marks, Direction direction) const {
    for (const Part& part : parts_) part.change->apply(marks, direction);
}

std::vector<int> MarksChange::restated() const {
    const auto* states = static_cast<const StatesChange*>(change_of(&Marks::states));
    return states == nullptr ? std::vector<int>() : states->branches();
}

} // namespace ramus::app
