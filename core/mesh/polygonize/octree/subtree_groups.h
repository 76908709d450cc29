// SubtreeGroups: finds the subtrees of an octree, group by group, so that the lists of few of them are in memory at a
// time. A group is what lies in one cube that few segments reach. Groups, and the subtrees of each, are in depth-first
// order, so that the order of all does not depend on the groups.
#pragma once

#include "core/mesh/polygonize/octree/splitter.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

// A node above the subtrees that is not in the octree yet.
struct FoundUpper {
    std::uint32_t parent = 0; // index in the list of its group; of the first one: in Octree::upper
    std::uint8_t child = 0;   // which child of its parent it is
    std::uint8_t full = 0;    // one bit per child: inside the surface
};

struct SubtreeGroup {
    std::vector<FoundUpper> upper; // breadth first; none if the cube of the group is a subtree
    std::vector<Seed> seeds;       // depth first; their parents are indices of `upper`, if there are any
};

// Enters the upper nodes of a group in the octree, and returns their indices in Octree::upper.
std::vector<std::uint32_t> enter_upper(Octree& octree, std::span<const FoundUpper> upper);
// The same, and gives the seeds their parents in Octree::upper.
void enter_upper(Octree& octree, SubtreeGroup& group);

// Segments of a group at most: trees with fewer are one group.
inline constexpr std::size_t kGroupSegments = std::size_t{1} << 18;

class SubtreeGroups {
public:
    // Divides the top cube down to cubes that at most `most_segments` reach, and enters what is above them. There are
    // fewer groups if cancelled. Keeps references to the field and the sizing of the splitter.
    SubtreeGroups(const Splitter& splitter, Octree& octree, std::size_t most_segments, const Job& job);

    [[nodiscard]] std::size_t size() const { return cubes_.size(); }
    // Divides the cube of a group down to the subtrees. Incomplete if cancelled.
    [[nodiscard]] SubtreeGroup group(std::size_t n, const Job& job) const;

private:
    Splitter splitter_;
    TopLists lists_;
    std::vector<Seed> cubes_;
};

} // namespace ramus::mesh::bricks
