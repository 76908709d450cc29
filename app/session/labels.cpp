#include "app/session/labels.h"

#include <algorithm>

namespace ramus::app {

bool names_subtree(const Marks& marks, int branch) { return std::ranges::binary_search(marks.subtree_names, branch); }

int label_source(const tree::Dependency& dependency, const Marks& marks, int branch) {
    if (marks.names.contains(branch)) return branch;
    if (marks.subtree_names.empty()) return tree::kNoBranch;
    int id = dependency.parent(branch);
    while (id != tree::kNoBranch && !names_subtree(marks, id)) id = dependency.parent(id);
    return id;
}

std::vector<int> label_sources(const tree::Dependency& dependency, const Marks& marks) {
    std::vector<int> sources(static_cast<std::size_t>(dependency.branch_count()), tree::kNoBranch);
    if (marks.names.empty()) return sources;
    std::vector<int> below = sources; // label that each branch passes on to unnamed dependents
    for (const int id : dependency.order()) {
        const auto index = static_cast<std::size_t>(id);
        const int parent = dependency.parent(id);
        const int above = parent == tree::kNoBranch ? tree::kNoBranch : below[static_cast<std::size_t>(parent)];
        sources[index] = marks.names.contains(id) ? id : above;
        below[index] = names_subtree(marks, id) ? id : above;
    }
    return sources;
}

std::string label_of(const tree::Dependency& dependency, const Marks& marks, int branch) {
    const int source = label_source(dependency, marks, branch);
    return source == tree::kNoBranch ? std::string{} : marks.names.at(source);
}

void set_name(Marks& marks, int branch, const std::string& name, bool of_subtree) {
    auto& wide = marks.subtree_names;
    std::erase(wide, branch);
    if (name.empty()) {
        marks.names.erase(branch);
        return;
    }
    marks.names[branch] = name;
    if (of_subtree) wide.insert(std::ranges::lower_bound(wide, branch), branch);
}

} // namespace ramus::app
