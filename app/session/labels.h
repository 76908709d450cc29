// Labels: what branches are called. A name is its branch's alone, or, where that was asked for, also the name of all
// that depends on it: then a branch without a name of its own has that of the nearest such branch that it depends on.
//
// Pure and linear; nothing is kept: names change rarely, and who draws often keeps label_sources() while they do not.
#pragma once

#include "app/session/session.h"
#include "core/tree/dependency.h"

#include <map>
#include <string>
#include <vector>

namespace ramus::app {

using BranchNames = std::map<int, std::string>; // by branch id

// The branch whose name `branch` bears; kNoBranch when it bears none.
[[nodiscard]] int label_source(const tree::Dependency& dependency, const Marks& marks, int branch);
// The same for every branch at once.
[[nodiscard]] std::vector<int> label_sources(const tree::Dependency& dependency, const Marks& marks);

// The name that `branch` bears; empty when it bears none.
[[nodiscard]] std::string label_of(const tree::Dependency& dependency, const Marks& marks, int branch);

// An empty name takes it away.
void set_name(Marks& marks, int branch, const std::string& name, bool of_subtree);
[[nodiscard]] bool names_subtree(const Marks& marks, int branch);

} // namespace ramus::app
