#include "core/mesh/polygonize/octree/neighbours.h"

#include <algorithm>
#include <oneapi/tbb/parallel_for.h>
#include <vector>

namespace ramus::mesh::bricks {

namespace {

template <class Value>
std::array<Value, kDirections> around_child(const std::array<Value, 64>& block, std::size_t child) {
    std::array<Value, kDirections> around;
    const std::size_t first = (child & 1) + 4 * (child >> 1 & 1) + 16 * (child >> 2);
    std::size_t n = 0;
    for (std::size_t z = 0; z < 3; ++z)
        for (std::size_t y = 0; y < 3; ++y)
            for (std::size_t x = 0; x < 3; ++x) around[n++] = block[first + x + 4 * y + 16 * z];
    return around;
}

// The owners of the entries around a cube, as codes of UpperNode::children. Entries inside a subtree have its code.
constexpr std::uint32_t kChangedNothing = 0xFFFFFFFEU; // nothing now, but something before

struct Surroundings {
    EntriesAround entries;
    std::array<std::uint32_t, kDirections> owners;
};

// Calls visit(subtree, surroundings), depth first, for the subtrees below the upper nodes for which `enters` returns
// true. `changes` may be null.
template <class Enters, class Visit> class UpperWalk {
public:
    UpperWalk(const Octree& octree, const OctreeChanges* changes, const Enters& enters, const Visit& visit)
        : octree_(octree), changes_(changes), enters_(enters), visit_(visit) {}

    void walk() {
        Surroundings top;
        top.owners.fill(UpperNode::kNothing);
        top.entries.at[kSelf] = OctreeEntry::node(octree_.upper[0].node);
        top.owners[kSelf] = UpperNode::node_code(0);
        walk(top);
    }

private:
    [[nodiscard]] std::uint32_t owner_of_child(std::uint32_t owner, std::size_t child) const {
        if (owner == kChangedNothing || !UpperNode::is_node(owner)) return owner;
        const std::uint32_t parent = UpperNode::node_of(owner);
        const std::uint32_t code = octree_.upper[parent].children[child];
        const bool gone =
            code == UpperNode::kNothing && changes_ != nullptr && (changes_->children[parent] >> child & 1) != 0;
        return gone ? kChangedNothing : code;
    }

    void walk(const Surroundings& around) {
        const EntriesAroundChildren entries = entries_around_children(octree_, around.entries);
        std::array<std::uint32_t, 64> owners;
        std::size_t n = 0;
        for (const ChildStep z : kChildSteps)
            for (const ChildStep y : kChildSteps)
                for (const ChildStep x : kChildSteps)
                    owners[n++] =
                        owner_of_child(around.owners[static_cast<std::size_t>(x.cube + 3 * y.cube + 9 * z.cube)],
                                       static_cast<std::size_t>(x.child + 2 * y.child + 4 * z.child));
        const UpperNode& self = octree_.upper[UpperNode::node_of(around.owners[kSelf])];
        for (std::size_t child = 0; child < field::kChildren; ++child) {
            if (self.children[child] == UpperNode::kNothing) continue;
            Surroundings next;
            next.entries = entries_around_child(entries, child);
            next.owners = around_child(owners, child);
            if (UpperNode::is_subtree(self.children[child]))
                visit_(self.children[child], next);
            else if (enters_(next))
                walk(next);
        }
    }

    const Octree& octree_;
    const OctreeChanges* changes_;
    const Enters& enters_;
    const Visit& visit_;
};

} // namespace

void OctreeChanges::mark(const Octree& octree, std::uint32_t upper) {
    for (; below[upper] == 0; upper = octree.upper[upper].parent) below[upper] = 1;
}

void find_neighbours(const Octree& octree, std::span<const std::uint32_t> subtrees,
                     ChunkedArray<Neighbourhood>& found) {
    found.resize(octree.bricks.size());
    OctreeChanges requested;
    requested.subtrees.assign(octree.subtrees.size(), 0);
    requested.below.assign(octree.upper.size(), 0);
    for (const std::uint32_t subtree : subtrees) {
        const Subtree& t = octree.subtrees[subtree];
        found.provide(t.first_brick, t.first_brick + t.brick_count);
        requested.subtrees[subtree] = 1, requested.mark(octree, t.parent);
    }
    std::vector<EntriesAround> around;
    around.reserve(subtrees.size());
    const auto collect = [&](std::uint32_t subtree, const Surroundings& surroundings) {
        if (requested.subtrees[subtree] != 0) around.push_back(surroundings.entries);
    };
    const auto enters = [&](const Surroundings& around_node) {
        return requested.below[UpperNode::node_of(around_node.owners[kSelf])] != 0;
    };
    UpperWalk(octree, nullptr, enters, collect).walk();
    tbb::parallel_for(std::size_t{0}, around.size(), [&](std::size_t i) { describe_bricks(octree, around[i], found); });
}

std::vector<std::uint32_t> subtrees_beside(const Octree& octree, const OctreeChanges& changes) {
    std::vector<std::uint32_t> beside;
    const auto touches_changes = [&](const Surroundings& around) {
        return std::ranges::any_of(around.owners, [&](std::uint32_t owner) {
            if (owner == kChangedNothing) return true;
            if (owner == UpperNode::kNothing) return false;
            return UpperNode::is_subtree(owner) ? changes.subtrees[owner] != 0
                                                : changes.below[UpperNode::node_of(owner)] != 0;
        });
    };
    const auto visit = [&](std::uint32_t subtree, const Surroundings& around) {
        if (changes.subtrees[subtree] == 0 && touches_changes(around)) beside.push_back(subtree);
    };
    UpperWalk(octree, &changes, touches_changes, visit).walk();
    return beside;
}

LargeArray<std::pair<std::uint32_t, std::uint32_t>> touching_subtrees(const Octree& octree,
                                                                      const LargeAllocator<std::byte>& memory) {
    LargeArray<std::pair<std::uint32_t, std::uint32_t>> pairs(memory);
    const auto everywhere = [](const Surroundings&) { return true; };
    // The smaller subtree of a pair finds the larger one; of two with the same size, the first one adds the pair.
    const auto visit = [&](std::uint32_t subtree, const Surroundings& around) {
        for (const std::uint32_t owner : around.owners) {
            if (owner == UpperNode::kNothing || !UpperNode::is_subtree(owner) || owner == subtree) continue;
            if (octree.subtrees[owner].level > octree.subtrees[subtree].level || subtree < owner)
                pairs.emplace_back(subtree, owner);
        }
    };
    UpperWalk(octree, nullptr, everywhere, visit).walk();
    return pairs;
}

} // namespace ramus::mesh::bricks
