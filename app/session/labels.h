// Labels: a name given to a branch also speaks for all that depends on it, down to the next branch with a name of its
// own. So a label is the name of the nearest named branch among the branch itself and all that it depends on.
//
// Pure and linear; nothing is kept: names change rarely, and who draws often keeps label_sources() while they do not.
#pragma once

#include "core/tree/dependency.h"

#include <map>
#include <string>
#include <vector>

namespace ramus::app {

using BranchNames = std::map<int, std::string>; // by branch id

// The branch whose name `branch` bears; kNoBranch when it bears none.
[[nodiscard]] int label_source(const tree::Dependency& dependency, const BranchNames& names, int branch);
// The same for every branch at once.
[[nodiscard]] std::vector<int> label_sources(const tree::Dependency& dependency, const BranchNames& names);

// The name that `branch` bears; empty when it bears none.
[[nodiscard]] std::string label_of(const tree::Dependency& dependency, const BranchNames& names, int branch);

} // namespace ramus::app
