// State of the table of branches in the side panel between frames.
#pragma once

#include "app/session/branch_filter.h"

#include <array>
#include <string>
#include <vector>

namespace ramus::app {

struct BranchList {
    std::array<char, 128> filter{};  // as typed
    std::string trouble;             // what is wrong with the filter; empty: nothing
    std::vector<int> rows;           // branch ids, filtered and sorted
    std::vector<int> given_subtrees; // ids whose names label subtrees, ascending
    std::vector<double> largest;     // over all branches, per quantity with a column
    int sorted = 0;                  // the sorted column, when drawn last
    std::vector<std::string> names;  // labels by branch id; empty if there are none
    int anchor = tree::kNoBranch;    // start of a range selection
    int cursor = tree::kNoBranch;    // position of the arrow keys
    int shown = tree::kNoBranch;     // the selected branch that the list has scrolled to
    bool focused = false;            // receives the arrow keys
    bool apart = false;              // in a separate window

    // The inputs of `rows`.
    const TreeFacts* of = nullptr;
    std::string applied;
    BranchFilter parsed;
    std::vector<int> selection;
    std::vector<tree::BranchState> states;
    BranchNames given;
    std::vector<tree::System> systems; // of the session
    bool made = false;
};

} // namespace ramus::app
