// Labels: the displayed names of branches. A name applies to its branch, or on request to all dependents, too. A branch
// without a name of its own gets the name of the nearest branch it depends on that is named for its subtree.
//
// Pure functions, linear in the number of branches, without a cache. Callers that draw often should keep
// label_sources() while names do not change.
#pragma once

#include "app/session/session.h"
#include "core/tree/dependency.h"

#include <map>
#include <string>
#include <vector>

namespace ramus::app {

using BranchNames = std::map<int, std::string>; // by branch id

// The branch whose name is the label of `branch`; kNoBranch if there is no label.
[[nodiscard]] int label_source(const tree::Dependency& dependency, const Marks& marks, int branch);
// The same for all branches.
[[nodiscard]] std::vector<int> label_sources(const tree::Dependency& dependency, const Marks& marks);

// The label of `branch`; empty if there is none.
[[nodiscard]] std::string label_of(const tree::Dependency& dependency, const Marks& marks, int branch);

// Sets a name; an empty name removes it. `of_subtree`: it applies to all dependents, too.
void set_name(Marks& marks, int branch, const std::string& name, bool of_subtree);
[[nodiscard]] bool names_subtree(const Marks& marks, int branch);

} // namespace ramus::app
