#include "app/labels.h"

namespace ramus::app {

int label_source(const tree::VesselTree& tree, const BranchNames& names, int branch) {
    if (names.empty()) return tree::kNoBranch;
    int id = branch;
    while (id != tree::kNoBranch && !names.contains(id)) id = tree.branches[static_cast<std::size_t>(id)].parent;
    return id;
}

std::vector<int> label_sources(const tree::VesselTree& tree, const BranchNames& names) {
    std::vector<int> sources(tree.branches.size(), tree::kNoBranch);
    if (names.empty()) return sources;
    std::vector<int> open;
    for (std::size_t id = 0; id < tree.branches.size(); ++id)
        if (tree.branches[id].parent == tree::kNoBranch) open.push_back(static_cast<int>(id));
    while (!open.empty()) {
        const int id = open.back();
        open.pop_back();
        const tree::Branch& branch = tree.branches[static_cast<std::size_t>(id)];
        int& source = sources[static_cast<std::size_t>(id)];
        if (names.contains(id))
            source = id;
        else if (branch.parent != tree::kNoBranch)
            source = sources[static_cast<std::size_t>(branch.parent)];
        open.insert(open.end(), branch.children.begin(), branch.children.end());
    }
    return sources;
}

std::string label_of(const tree::VesselTree& tree, const BranchNames& names, int branch) {
    const int source = label_source(tree, names, branch);
    return source == tree::kNoBranch ? std::string{} : names.at(source);
}

} // namespace ramus::app
