// PartialOctree: an octree of which only some subtrees get bricks, for a process that makes a part of a surface. Which
// subtrees there are, and how large each is, is known of the whole octree; a team finds them together. The order of
// subtrees is that of build_octree(), and so is everything inside those that are built.
#pragma once

#include "core/mesh/polygonize/octree/subtree_groups.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

// The subtrees of some groups, in plain values that processes tell each other.
struct FoundSubtrees {
    struct Group {
        std::uint32_t upper = 0, subtrees = 0; // numbers of both
    };
    struct One {
        glm::ivec3 corner{0};
        std::int32_t level = 0;
        std::uint32_t parent = 0, child = 0; // as of a seed
        SubtreeSize size;
    };
    std::vector<Group> groups;
    std::vector<FoundUpper> upper;
    std::vector<One> subtrees;
};

class PartialOctree {
public:
    // `parts`: for so many parts it is made. Keeps references to the field and the sizing.
    PartialOctree(const field::Field& field, const Sizing& sizing, std::size_t parts, Job& job,
                  const LargeAllocator<std::byte>& memory = {});
    PartialOctree(const PartialOctree&) = delete;
    PartialOctree& operator=(const PartialOctree&) = delete;

    [[nodiscard]] std::size_t groups() const { return groups_.size(); }
    // Finds the subtrees of group `first` and of every `step`th after it. Fewer if cancelled.
    [[nodiscard]] FoundSubtrees find(std::size_t first, std::size_t step, const Job& job) const;
    // Enters all subtrees in the octree, without bricks, and returns their sizes. `found`: by `first` of find(), of all
    // groups.
    [[nodiscard]] std::vector<SubtreeSize> enter(std::span<const FoundSubtrees> found);
    // Builds the subtrees whose entry in `wanted` is not 0. Incomplete if cancelled.
    void build(std::span<const std::uint8_t> wanted, Job& job);

    [[nodiscard]] Octree& octree() { return octree_; }

private:
    Octree octree_;
    Splitter splitter_;
    SubtreeGroups groups_;
    std::vector<std::size_t> first_; // by group: its first subtree, and the end
};

} // namespace ramus::mesh::bricks
