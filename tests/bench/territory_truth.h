// Organs whose supply is known to the last leaf, and what a scan shows of their trees.
#pragma once

#include "core/organ/organ.h"
#include "core/organ/territories.h"
#include "core/tree/vessel_tree.h"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace ramus::bench {

// An organ, the whole tree in it, and the leaf whose end is nearest to each voxel.
struct Truth {
    std::string name;
    tree::VesselTree tree;
    organ::Organ organ;
    std::vector<std::int32_t> leaf; // by voxel: branch id
};

// A tree of so many leaves in the liver that is built in, with voxels of `voxel` mm.
[[nodiscard]] Truth grown_liver(int leaves, std::uint64_t seed, double voxel);
// The same in the organ of a mask, with the voxels of the mask, in its largest part.
[[nodiscard]] Truth grown_in(const std::string& name, const organ::Organ& organ, int leaves, std::uint64_t seed);

// Which branches of the whole tree are visible: the thickest, so many that the tree of them has at least `count`
// branches. (A branch with one visible child is one branch with that child.)
[[nodiscard]] std::vector<char> thickest(const tree::VesselTree& whole, std::size_t count);

// Removes each end branch of the visible tree with this probability, all at once.
void lose_ends(const tree::VesselTree& whole, std::vector<char>& visible, double probability, std::mt19937_64& random);

// The heads of `count` parts of the visible tree, as ids of the whole one: the part with the most flow (radius cubed)
// is divided at its next fork, again and again. Children with less than a quarter of the flow do not make a fork.
[[nodiscard]] std::vector<int> heads_of(const tree::VesselTree& whole, const std::vector<char>& visible,
                                        std::size_t count);
// By branch of the whole tree: the head that it hangs on, or organ::kNoGroup.
[[nodiscard]] std::vector<int> groups_of(const tree::VesselTree& whole, const std::vector<int>& heads);

// The visible tree, and for each of its branches the branches of the whole one that it consists of, in order.
struct Seen {
    tree::VesselTree tree;
    std::vector<std::vector<int>> parts;
};
// `noise`: standard deviation of the logarithm of each visible branch's factor on its radii.
[[nodiscard]] Seen seen_of(const tree::VesselTree& whole, const std::vector<char>& visible, double noise,
                           std::mt19937_64& random);
// The groups of the branches that are seen.
[[nodiscard]] organ::Grouping grouping_of(const Seen& seen, const tree::VesselTree& whole,
                                          const std::vector<int>& groups, std::size_t heads);

struct Score {
    double dice = 0.0, volume_error = 0.0; // means over the parts; the error as a fraction of the true volume
};
// Voxels whose leaf hangs on the trunk in front of all heads have no true territory and are not compared.
[[nodiscard]] Score score_of(const Truth& truth, const std::vector<int>& groups, const std::vector<int>& found,
                             std::size_t heads);

} // namespace ramus::bench
