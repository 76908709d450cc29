#include "core/mesh/polygonize/octree/update_octree.h"

#include <algorithm>
#include <array>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::mesh::bricks {

namespace {

// The changes that may affect one cube: segments and sizing pieces of both states.
using Changed = std::array<std::vector<std::uint32_t>, 4>;

bool is_empty(const Changed& changed) {
    return std::ranges::all_of(changed, [](const auto& list) { return list.empty(); });
}

class Updater {
public:
    Updater(Octree& octree, const TreeState& before, const TreeState& after)
        : octree_(octree), before_(before), after_(after), splitter_{after.field, after.sizing, octree.lattice} {}

    // Level by level, so that the nodes of one can be split in parallel.
    void update(const Cube& top, const Changed& changed) {
        std::vector<Node> level(1);
        level[0].cube = top;
        level[0].changed = changed;
        while (!level.empty()) {
            std::vector<std::vector<Node>> children(level.size());
            tbb::parallel_for(std::size_t{0}, level.size(), [&](std::size_t i) { children[i] = split(level[i]); });
            std::vector<Node> next;
            for (std::size_t i = 0; i < level.size(); ++i)
                for (Node& child : children[i]) enter(std::move(child), next);
            level = std::move(next);
        }
    }

    // Replaces old subtrees by those of the seeds.
    OctreeChanges finish(Job& job) {
        std::vector<std::array<std::uint32_t, field::kChildren>> old;
        const std::size_t first = octree_.subtrees.size();
        // append_subtrees enters the new codes; the old ones are still needed.
        old.reserve(octree_.upper.size());
        for (const UpperNode& node : octree_.upper) old.push_back(node.children);
        append_subtrees(splitter_, seeds, octree_, job);
        for (const Seed& seed : seeds) {
            remove_below(old[seed.parent][seed.child]);
            changed_children_.emplace_back(seed.parent, seed.child);
        }
        changes_.subtrees.assign(octree_.subtrees.size(), 0);
        changes_.below.assign(octree_.upper.size(), 0);
        changes_.children.assign(octree_.upper.size(), 0);
        for (std::size_t subtree = first; subtree < octree_.subtrees.size(); ++subtree) {
            changes_.subtrees[subtree] = 1;
            changes_.added.push_back(static_cast<std::uint32_t>(subtree));
        }
        for (const auto& [upper, child] : changed_children_) {
            changes_.children[upper] = static_cast<std::uint8_t>(changes_.children[upper] | 1U << child);
            changes_.mark(octree_, upper);
        }
        return std::move(changes_);
    }

    std::vector<Seed> seeds;

private:
    // A cube that changes reach: an upper node, or a child of one that is still to be entered.
    struct Node {
        Cube cube;
        Changed changed;
        std::uint32_t upper = 0;
        bool fresh = false; // new, and so is all below it
        bool exists = false, is_full = false;
        Seed seed;
    };

    [[nodiscard]] std::vector<Node> split(const Node& node) const {
        thread_local Children children;
        splitter_.split_upper(node.cube, children);
        std::array<Changed, field::kChildren> parts = deal(node.cube, node.changed);
        std::vector<Node> changed;
        for (std::size_t c = 0; c < field::kChildren; ++c) {
            if (!node.fresh) {
                if (parts[c][0].empty() && parts[c][1].empty()) drop_irrelevant(node.cube, children, c, parts[c]);
                if (is_empty(parts[c])) continue;
            }
            Node& child = changed.emplace_back();
            child.changed = std::move(parts[c]);
            child.fresh = node.fresh;
            child.exists = children.verdicts[c] >= Children::Verdict::kBrick;
            child.is_full = children.verdicts[c] == Children::Verdict::kInside;
            if (child.exists) child.seed = Seed(splitter_, node.cube, children, c, node.upper);
            child.seed.parent = node.upper;
            child.seed.child = static_cast<std::uint32_t>(c);
        }
        return changed;
    }

    // For a child with unchanged segments: drops the changed sizing pieces that have no effect there, since the nearby
    // vessels require cells as small or smaller.
    void drop_irrelevant(const Cube& parent, const Children& children, std::size_t c, Changed& changed) const {
        if (children.verdicts[c] < Children::Verdict::kBrick) {
            changed[2].clear(), changed[3].clear();
            return;
        }
        const Cube& cube = children.cubes[c];
        float thickest = 0.0F;
        for (const std::uint32_t index : cube.segments) {
            const field::FieldSegment& s = after_.field.skeleton().segments()[index];
            thickest = std::max(thickest, s.thickest());
        }
        const float most = most_asked(after_.sizing, thickest);
        const auto side = static_cast<float>(splitter_.child_side(parent));
        const glm::vec3 middle(octree_.lattice.position(cube.corner) + glm::dvec3(0.5 * side) -
                               after_.field.extent().middle());
        for (const std::size_t list : {2, 3}) {
            const Sizing& sizing = (list == 2 ? before_ : after_).sizing;
            std::erase_if(changed[list],
                          [&](std::uint32_t p) { return !can_matter(sizing.pieces[p], middle, side, most); });
        }
    }

    void enter(Node node, std::vector<Node>& next) {
        const std::uint32_t upper = node.seed.parent;
        const std::size_t c = node.seed.child;
        const std::uint32_t old = octree_.upper[upper].children[c];
        if (!node.exists) {
            remove(upper, c);
            if (node.is_full) octree_.nodes[octree_.upper[upper].node][c] = OctreeEntry::full();
            return;
        }
        if (node.seed.is_subtree) {
            const bool same_segments = node.changed[0].empty() && node.changed[1].empty();
            if (UpperNode::is_subtree(old) && same_segments && !node.fresh) node.seed.present = old;
            seeds.push_back(std::move(node.seed));
            return;
        }
        if (UpperNode::is_node(old)) {
            node.upper = UpperNode::node_of(old);
        } else {
            remove(upper, c);
            node.upper = octree_.add_upper_node();
            octree_.enter(upper, c, node.upper);
            node.fresh = true;
        }
        next.push_back(std::move(node));
        next.back().cube = next.back().seed.cube; // its lists are on the heap and stay where they are
    }

    void remove(std::uint32_t upper, std::size_t child) {
        std::uint32_t& code = octree_.upper[upper].children[child];
        remove_below(code);
        changed_children_.emplace_back(upper, child);
        code = UpperNode::kNothing;
        octree_.nodes[octree_.upper[upper].node][child] = OctreeEntry();
    }

    void remove_below(std::uint32_t code) {
        if (code == UpperNode::kNothing) return;
        if (UpperNode::is_subtree(code)) {
            changes_.removed.push_back(code);
            return;
        }
        for (const std::uint32_t child : octree_.upper[UpperNode::node_of(code)].children) remove_below(child);
    }

    [[nodiscard]] std::array<Changed, field::kChildren> deal(const Cube& cube, const Changed& changed) const {
        std::array<Changed, field::kChildren> parts;
        const field::ChildCubes cubes = splitter_.children_of(cube);
        thread_local std::vector<std::uint8_t> bits;
        for (std::size_t list = 0; list < changed.size(); ++list) {
            if (changed[list].empty()) continue;
            const TreeState& state = list % 2 == 0 ? before_ : after_;
            bits.assign(changed[list].size(), 0);
            if (list < 2)
                static_cast<void>(state.field.bound_children(changed[list], cubes, bits));
            else
                active_children(state.sizing.pieces, changed[list], cubes, bits);
            for (std::size_t m = 0; m < bits.size(); ++m)
                for (std::size_t c = 0; c < field::kChildren; ++c)
                    if ((bits[m] >> c & 1) != 0) parts[c][list].push_back(changed[list][m]);
        }
        return parts;
    }

    Octree& octree_;
    const TreeState& before_;
    const TreeState& after_;
    Splitter splitter_;
    OctreeChanges changes_;
    std::vector<std::pair<std::uint32_t, std::size_t>> changed_children_; // upper nodes and children that changed
};

} // namespace

OctreeChanges update_octree(Octree& octree, const TreeState& before, const TreeState& after, Job& job) {
    Updater updater(octree, before, after);
    const TopLists lists(after.field, after.sizing);
    const Changed changed{before.changed_segments, after.changed_segments, before.changed_pieces, after.changed_pieces};
    if (!is_empty(changed)) updater.update(lists.top_cube(octree.top_level), changed);
    return updater.finish(job);
}

} // namespace ramus::mesh::bricks
