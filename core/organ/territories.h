// Territories: parts of an organ by the branches that supply them. Branches are put into groups; those in front of all
// groups (the trunk) are no territory of their own.
#pragma once

#include "core/base/error.h"
#include "core/measure/cuts.h"
#include "core/organ/supply.h"
#include "core/tree/dependency.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ramus::organ {

inline constexpr int kNoGroup = -1; // the trunk: it supplies nothing itself

// Groups of branches. A group may begin within a branch, at a cut.
struct Grouping {
    struct Part {
        int group = kNoGroup;  // index into `names`
        double from = 0.0;     // where it begins: fraction of the branch's length from the parent's end
        int before = kNoGroup; // group of what is in front of that, if anything is
    };
    std::vector<Part> branches;     // by branch id
    std::vector<std::string> names; // of the groups, for people
    [[nodiscard]] int group_at(std::size_t branch, double at) const {
        const Part& part = branches[branch];
        return at >= part.from ? part.group : part.before;
    }
};

// One group for each system, or one for a tree without systems. The stem, which is the branch of a root where that
// forks, is of no group unless `with_stem`.
[[nodiscard]] Grouping by_system(const tree::VesselTree& tree, bool with_stem = false);
// One for each branch of a generation (0: a root), with all branches behind it; branches in front of them are the
// trunk. Leaves of lower generations are groups of their own.
[[nodiscard]] Grouping by_generation(const tree::VesselTree& tree, int generation);
// One for each of the branches, with all that depend on it (but those of a later group inside of it); what neither
// belongs to them nor lies in front of one of them is the group "rest".
[[nodiscard]] Grouping by_branches(const tree::VesselTree& tree, const tree::Dependency& dependency,
                                   const std::vector<int>& branches);
// The same for branches with names: those of one name form one group.
[[nodiscard]] Grouping by_names(const tree::VesselTree& tree, const tree::Dependency& dependency,
                                std::span<const std::pair<int, std::string>> named);

// One for what each cut takes away (measure/cuts.h), and "rest". A cut that loses nothing has an empty group. At most
// one cut of a branch.
[[nodiscard]] Grouping by_cuts(const tree::VesselTree& tree, const tree::Dependency& dependency,
                               std::span<const measure::Cut> cuts);

// Fails for more groups than a label map has labels: 65,534.
[[nodiscard]] Result<void> check_count(const Grouping& grouping);

// Branches of the systems whose entry is 0 are of no group from now on.
void restrict_to(Grouping& grouping, const tree::VesselTree& tree, std::span<const std::uint8_t> systems);
// `excluded` of supply_of() for one system on its own: the stems and the branches of other systems.
[[nodiscard]] std::vector<std::uint8_t> all_but_system(const tree::VesselTree& tree, std::size_t system);

// The supply by each system on its own, without its stem; one that does not reach the organ has no voxels. Fails if
// none reaches it, and when cancelled (what == "cancelled").
[[nodiscard]] Result<std::vector<Supply>> supplies_by_system(const Organ& organ, const tree::VesselTree& tree,
                                                             const SupplyOptions& options, const JobRange& job);

// By branch id, not 0: of no group (`excluded` of supply_of()).
[[nodiscard]] std::vector<std::uint8_t> trunk_of(const Grouping& grouping);

// By voxel of the organ: its group. `supply`: without the trunk.
[[nodiscard]] std::vector<int> voxel_groups(const Supply& supply, const Grouping& grouping);

struct Territory {
    std::string name;
    int system = 0; // index into VesselTree::systems, 0 where there are none
    std::vector<int> branches;
    std::size_t voxels = 0;
};

// The territories of all groups, in their order, also those without a voxel.
[[nodiscard]] std::vector<Territory> territories_of(const tree::VesselTree& tree, const Supply& supply,
                                                    const Grouping& grouping);

} // namespace ramus::organ
