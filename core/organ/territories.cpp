#include "core/organ/territories.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <optional>
#include <utility>

namespace ramus::organ {

namespace {

std::string branch_name(int id) { return "branch " + std::to_string(id); }

// Whether a root branch forks.
bool is_stem(const tree::Branch& branch) { return branch.parent == tree::kNoBranch && !branch.children.empty(); }

// The order in which groups take their branches: inner ones take them from outer ones.
std::vector<std::size_t> outer_first(const tree::Dependency& dependency, const std::vector<int>& branches) {
    std::vector<std::size_t> order(branches.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(),
                             [&](std::size_t n) { return dependency.with_dependents(branches[n]).size(); });
    return order;
}

} // namespace

Grouping by_system(const tree::VesselTree& tree, bool with_stem) {
    Grouping grouping;
    for (const tree::System& system : tree.systems) grouping.names.push_back(system.name);
    if (grouping.names.empty()) grouping.names.emplace_back("all");
    for (const tree::Branch& branch : tree.branches)
        grouping.branches.push_back({is_stem(branch) && !with_stem ? kNoGroup : branch.system});
    return grouping;
}

Grouping by_generation(const tree::VesselTree& tree, int generation) {
    Grouping grouping;
    grouping.branches.resize(tree.branches.size());
    std::vector<int> open;
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const tree::Branch& branch = tree.branches[id];
        const bool leaf = branch.generation < generation && branch.children.empty();
        if (branch.generation != generation && !leaf) continue;
        open.push_back(static_cast<int>(id));
        while (!open.empty()) {
            const auto at = static_cast<std::size_t>(open.back());
            open.pop_back();
            grouping.branches[at].group = static_cast<int>(grouping.names.size());
            open.insert(open.end(), tree.branches[at].children.begin(), tree.branches[at].children.end());
        }
        grouping.names.push_back(branch_name(static_cast<int>(id)));
    }
    return grouping;
}

Grouping by_branches(const tree::VesselTree& tree, const tree::Dependency& dependency,
                     const std::vector<int>& branches) {
    std::vector<std::pair<int, std::string>> named;
    for (const int id : branches) named.emplace_back(id, branch_name(id));
    return by_names(tree, dependency, named);
}

Grouping by_names(const tree::VesselTree& tree, const tree::Dependency& dependency,
                  std::span<const std::pair<int, std::string>> named) {
    Grouping grouping;
    std::vector<int> branches, groups; // by element of `named`
    for (const auto& [branch, name] : named) {
        const auto known = std::ranges::find(grouping.names, name);
        branches.push_back(branch);
        groups.push_back(static_cast<int>(known - grouping.names.begin()));
        if (known == grouping.names.end()) grouping.names.push_back(name);
    }
    grouping.branches.assign(tree.branches.size(), {static_cast<int>(grouping.names.size())});
    grouping.names.emplace_back("rest");
    for (const int id : branches)
        for (const int before : dependency.upstream(id))
            grouping.branches[static_cast<std::size_t>(before)].group = kNoGroup;
    for (const std::size_t n : outer_first(dependency, branches))
        for (const int id : dependency.with_dependents(branches[n]))
            grouping.branches[static_cast<std::size_t>(id)].group = groups[n];
    return grouping;
}

Grouping by_cuts(const tree::VesselTree& tree, const tree::Dependency& dependency, std::span<const measure::Cut> cuts) {
    Grouping grouping;
    const int rest = static_cast<int>(cuts.size());
    for (const tree::Branch& branch : tree.branches) grouping.branches.push_back({is_stem(branch) ? kNoGroup : rest});
    std::vector<int> branches;
    for (const auto& [branch, at] : cuts) {
        branches.push_back(branch);
        grouping.names.push_back("beyond the cut of " + branch_name(branch));
    }
    grouping.names.emplace_back("rest");
    for (const std::size_t n : outer_first(dependency, branches)) {
        if (!dependency.is_bridge(branches[n])) continue; // nothing depends on it
        const auto head = static_cast<std::size_t>(branches[n]);
        const int outer = grouping.branches[head].group, before = outer == kNoGroup ? rest : outer;
        for (const int id : dependency.with_dependents(branches[n]))
            grouping.branches[static_cast<std::size_t>(id)] = {static_cast<int>(n)};
        grouping.branches[head] = {static_cast<int>(n), cuts[n].second, before};
    }
    return grouping;
}

Result<void> check_count(const Grouping& grouping) {
    if (grouping.names.size() > 65'534)
        return fail("there are more than 65,534 territories", {}, "group by fewer branches");
    return {};
}

void restrict_to(Grouping& grouping, const tree::VesselTree& tree, std::span<const std::uint8_t> systems) {
    for (std::size_t id = 0; id < tree.branches.size(); ++id)
        if (systems[static_cast<std::size_t>(tree.branches[id].system)] == 0) grouping.branches[id] = {};
}

std::vector<std::uint8_t> all_but_system(const tree::VesselTree& tree, std::size_t system) {
    Grouping grouping = by_system(tree);
    std::vector<std::uint8_t> systems(grouping.names.size(), 0);
    systems[system] = 1;
    restrict_to(grouping, tree, systems);
    return trunk_of(grouping);
}

Result<std::vector<Supply>> supplies_by_system(const Organ& organ, const tree::VesselTree& tree,
                                               const SupplyOptions& options, const JobRange& job) {
    const std::size_t count = std::max<std::size_t>(tree.systems.size(), 1);
    std::vector<Supply> supplies;
    std::optional<Error> none;
    for (std::size_t system = 0; system < count; ++system) {
        const auto from = static_cast<float>(system) / static_cast<float>(count);
        auto found = supply_of(organ, tree, options, all_but_system(tree, system),
                               job.part(from, from + 1.0F / static_cast<float>(count)));
        if (!found && found.error().what == "cancelled") return tl::unexpected(found.error());
        if (!found) none = found.error();
        supplies.push_back(found ? std::move(*found) : Supply{});
    }
    if (none && std::ranges::all_of(supplies, &std::vector<std::int32_t>::empty, &Supply::branch))
        return tl::unexpected(*none);
    return supplies;
}

std::vector<std::uint8_t> trunk_of(const Grouping& grouping) {
    std::vector<std::uint8_t> trunk;
    for (const Grouping::Part& part : grouping.branches) trunk.push_back(part.group == kNoGroup ? 1 : 0);
    return trunk;
}

std::vector<int> voxel_groups(const Supply& supply, const Grouping& grouping) {
    std::vector<int> groups(supply.branch.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, groups.size()), [&](const auto& range) {
        for (std::size_t voxel = range.begin(); voxel < range.end(); ++voxel)
            groups[voxel] = grouping.group_at(static_cast<std::size_t>(supply.branch[voxel]),
                                              static_cast<double>(supply.at[voxel]));
    });
    return groups;
}

std::vector<Territory> territories_of(const tree::VesselTree& tree, const Supply& supply, const Grouping& grouping) {
    std::vector<Territory> territories;
    for (const std::string& name : grouping.names) territories.push_back({name, 0, {}, 0});
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const int group = grouping.branches[id].group;
        if (group == kNoGroup) continue;
        Territory& territory = territories[static_cast<std::size_t>(group)];
        if (territory.branches.empty()) territory.system = tree.branches[id].system;
        territory.branches.push_back(static_cast<int>(id));
    }
    for (const int group : voxel_groups(supply, grouping)) ++territories[static_cast<std::size_t>(group)].voxels;
    return territories;
}

} // namespace ramus::organ
