#include "core/mesh/polygonize/octree/octree.h"

#include "core/mesh/polygonize/octree/splitter.h"
#include "core/mesh/polygonize/octree/subtree_groups.h"

#include <algorithm>
#include <cmath>

namespace ramus::mesh::bricks {

std::uint32_t Octree::add_upper_node() {
    upper.push_back({static_cast<std::uint32_t>(nodes.size()), 0, {}});
    upper.back().children.fill(UpperNode::kNothing);
    nodes.push_back(OctreeNode{});
    return static_cast<std::uint32_t>(upper.size() - 1);
}

void Octree::enter(std::uint32_t parent, std::size_t child, std::uint32_t upper_node) {
    nodes[upper[parent].node][child] = OctreeEntry::node(upper[upper_node].node);
    upper[parent].children[child] = UpperNode::node_code(upper_node);
    upper[upper_node].parent = parent;
}

std::vector<std::uint32_t> Octree::subtrees_in_order() const {
    std::vector<std::uint32_t> order;
    order.reserve(subtrees.size());
    const auto walk = [&](const auto& self, std::uint32_t node) -> void {
        for (const std::uint32_t code : upper[node].children) {
            if (UpperNode::is_subtree(code)) order.push_back(code);
            if (UpperNode::is_node(code)) self(self, UpperNode::node_of(code));
        }
    };
    walk(walk, 0);
    return order;
}

int levels_needed(const field::Extent& extent, const Sizing& sizing) {
    const glm::dvec3 size = extent.upper - extent.lower;
    const double largest = std::max({size.x, size.y, size.z});
    return std::max(1, static_cast<int>(std::ceil(std::log2(largest / (4.0 * sizing.finest_cell_mm)))) + 1);
}

Bounds<glm::vec3> box_of_brick(const Octree& octree, std::uint32_t brick) {
    const Brick& one = octree.bricks[brick];
    Bounds<glm::vec3> box;
    for (const int units : {0, brick_units(one.level)})
        box.hold(glm::vec3(octree.lattice.position(one.corner + units)));
    return box;
}

Octree begin_octree(const field::Field& field, const Sizing& sizing, const LargeAllocator<std::byte>& memory) {
    Octree octree(memory);
    octree.top_level = levels_needed(field.extent(), sizing);
    octree.lattice.unit_mm = 0.25 * sizing.finest_cell_mm;
    const double top_mm = octree.lattice.unit_mm * brick_units(octree.top_level);
    octree.lattice.origin = field.extent().middle() - glm::dvec3(0.5 * top_mm);
    return octree;
}

Octree build_octree(const field::Field& field, const Sizing& sizing, Job& job,
                    const LargeAllocator<std::byte>& memory) {
    Octree octree = begin_octree(field, sizing, memory);
    const Splitter splitter{field, sizing, octree.lattice};
    const SubtreeGroups groups(splitter, octree, kGroupSegments, job);
    for (std::size_t n = 0; n < groups.size(); ++n) {
        SubtreeGroup group = groups.group(n, job);
        if (job.cancelled()) return begin_octree(field, sizing, memory);
        enter_upper(octree, group);
        append_subtrees(splitter, group.seeds, octree, job);
    }
    return octree;
}

} // namespace ramus::mesh::bricks
