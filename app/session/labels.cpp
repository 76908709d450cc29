#include "app/session/labels.h"

namespace ramus::app {

int label_source(const tree::Dependency& dependency, const BranchNames& names, int branch) {
    if (names.empty()) return tree::kNoBranch;
    int id = branch;
    while (id != tree::kNoBranch && !names.contains(id)) id = dependency.parent(id);
    return id;
}

std::vector<int> label_sources(const tree::Dependency& dependency, const BranchNames& names) {
    std::vector<int> sources(static_cast<std::size_t>(dependency.branch_count()), tree::kNoBranch);
    if (names.empty()) return sources;
    for (const int id : dependency.order()) {
        const int parent = dependency.parent(id);
        sources[static_cast<std::size_t>(id)] = names.contains(id)          ? id
                                                : parent == tree::kNoBranch ? tree::kNoBranch
                                                                            : sources[static_cast<std::size_t>(parent)];
    }
    return sources;
}

std::string label_of(const tree::Dependency& dependency, const BranchNames& names, int branch) {
    const int source = label_source(dependency, names, branch);
    return source == tree::kNoBranch ? std::string{} : names.at(source);
}

} // namespace ramus::app
