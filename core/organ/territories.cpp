#include "core/organ/territories.h"

#include <algorithm>

namespace ramus::organ {

namespace {

std::string branch_name(int id) { return "branch " + std::to_string(id); }

// Whether a root branch forks.
bool is_stem(const tree::Branch& branch) { return branch.parent == tree::kNoBranch && !branch.children.empty(); }

} // namespace

Grouping by_system(const tree::VesselTree& tree, bool with_stem) {
    Grouping grouping;
    for (const tree::System& system : tree.systems) grouping.names.push_back(system.name);
    if (grouping.names.empty()) grouping.names.emplace_back("all");
    for (const tree::Branch& branch : tree.branches)
        grouping.group.push_back(is_stem(branch) && !with_stem ? kNoGroup : branch.system);
    return grouping;
}

Grouping by_generation(const tree::VesselTree& tree, int generation) {
    Grouping grouping;
    grouping.group.assign(tree.branches.size(), kNoGroup);
    std::vector<int> open;
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const tree::Branch& branch = tree.branches[id];
        const bool leaf = branch.generation < generation && branch.children.empty();
        if (branch.generation != generation && !leaf) continue;
        open.push_back(static_cast<int>(id));
        while (!open.empty()) {
            const auto at = static_cast<std::size_t>(open.back());
            open.pop_back();
            grouping.group[at] = static_cast<int>(grouping.names.size());
            open.insert(open.end(), tree.branches[at].children.begin(), tree.branches[at].children.end());
        }
        grouping.names.push_back(branch_name(static_cast<int>(id)));
    }
    return grouping;
}

Grouping by_branches(const tree::VesselTree& tree, const tree::Dependency& dependency,
                     const std::vector<int>& branches) {
    Grouping grouping;
    const int rest = static_cast<int>(branches.size());
    grouping.group.assign(tree.branches.size(), rest);
    for (const int id : branches) {
        grouping.names.push_back(branch_name(id));
        for (const int before : dependency.upstream(id)) grouping.group[static_cast<std::size_t>(before)] = kNoGroup;
    }
    // Outer groups first, so that inner ones take their branches from them.
    std::vector<int> outward(branches.size());
    for (std::size_t n = 0; n < branches.size(); ++n) outward[n] = static_cast<int>(n);
    std::ranges::stable_sort(outward, [&](int a, int b) {
        return dependency.with_dependents(branches[static_cast<std::size_t>(a)]).size() >
               dependency.with_dependents(branches[static_cast<std::size_t>(b)]).size();
    });
    for (const int n : outward)
        for (const int id : dependency.with_dependents(branches[static_cast<std::size_t>(n)]))
            grouping.group[static_cast<std::size_t>(id)] = n;
    grouping.names.emplace_back("rest");
    return grouping;
}

std::vector<std::uint8_t> trunk_of(const Grouping& grouping) {
    std::vector<std::uint8_t> trunk;
    for (const int group : grouping.group) trunk.push_back(group == kNoGroup ? 1 : 0);
    return trunk;
}

std::vector<Territory> territories_of(const tree::VesselTree& tree, const Supply& supply, const Grouping& grouping) {
    std::vector<Territory> territories;
    for (const std::string& name : grouping.names) territories.push_back({name, 0, {}, 0});
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        if (grouping.group[id] == kNoGroup) continue;
        Territory& territory = territories[static_cast<std::size_t>(grouping.group[id])];
        if (territory.branches.empty()) territory.system = tree.branches[id].system;
        territory.branches.push_back(static_cast<int>(id));
    }
    for (const std::int32_t branch : supply.branch)
        ++territories[static_cast<std::size_t>(grouping.group[static_cast<std::size_t>(branch)])].voxels;
    return territories;
}

} // namespace ramus::organ
