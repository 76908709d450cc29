// The table of branches in the side panel: what it remembers between frames.
#pragma once

#include "app/session/branch_filter.h"

#include <array>
#include <string>
#include <vector>

namespace ramus::app {

struct BranchList {
    std::array<char, 128> filter{};  // as typed
    std::string trouble;             // what is wrong with it; empty: nothing
    std::vector<int> rows;           // branch ids, as they are filtered and sorted
    std::vector<int> given_subtrees; // likewise
    std::vector<double> largest;     // of all branches, of each quantity that has a column
    int sorted = 0;                  // the column that it is sorted by, when it was drawn last
    std::vector<std::string> names;  // that branches bear, by branch id; empty when none has a name
    int anchor = tree::kNoBranch;    // a range begins here
    int cursor = tree::kNoBranch;    // the arrow keys go on from here
    int shown = tree::kNoBranch;     // the selected branch that the list was scrolled to
    bool focused = false;            // the arrow keys are for it
    bool apart = false;              // in a window of its own

    // What `rows` were made of.
    const TreeFacts* of = nullptr;
    std::string applied;
    BranchFilter parsed;
    std::vector<int> selection;
    std::vector<render::BranchState> states;
    BranchNames given;
    std::vector<tree::System> systems; // of the session
    bool made = false;
};

} // namespace ramus::app
