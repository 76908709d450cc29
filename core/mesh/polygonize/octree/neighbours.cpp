#include "core/mesh/polygonize/octree/neighbours.h"

#include <algorithm>
#include <oneapi/tbb/parallel_for.h>
#include <vector>

namespace ramus::mesh::bricks {

namespace {

// The 27 places around a cube, itself in the middle. A brick that is larger than the cube stands in all the places it
// covers.
using Places = std::array<OctreePlace, kDirections>;

// Along one axis the children around a child lie in the parent's places -1, 0 and 1, as child 0 or 1.
struct Step {
    int place, child;
};
constexpr std::array<Step, 4> kSteps{Step{0, 1}, Step{1, 0}, Step{1, 1}, Step{2, 0}};

// The 4 x 4 x 4 places at the size of the parent's children: around all eight of them.
using Block = std::array<OctreePlace, 64>;

Block places_around_children(const Octree& octree, const Places& around) {
    Block block;
    std::size_t n = 0;
    for (const Step z : kSteps) {
        for (const Step y : kSteps) {
            for (const Step x : kSteps) {
                const OctreePlace place = around[static_cast<std::size_t>(x.place + 3 * y.place + 9 * z.place)];
                block[n++] =
                    place.is_node()
                        ? octree.nodes[place.index()][static_cast<std::size_t>(x.child + 2 * y.child + 4 * z.child)]
                        : place;
            }
        }
    }
    return block;
}

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

Neighbourhood describe(const Octree& octree, const Places& around) {
    Neighbourhood described;
    described.same = described.coarser = described.finer = described.full = 0;
    const int level = octree.bricks[around[kSelf].index()].level;
    for (std::size_t d = 0; d < kDirections; ++d) {
        const OctreePlace place = around[d];
        const std::uint32_t bit = std::uint32_t{1} << d;
        if (place.is_node()) described.finer |= bit;
        if (place.is_full()) described.full |= bit;
        if (!place.is_brick()) continue;
        described.brick[d] = place.index();
        (octree.bricks[place.index()].level == level ? described.same : described.coarser) |= bit;
    }
    return described;
}

void walk(const Octree& octree, const Places& around, ChunkedArray<Neighbourhood>& found) {
    const OctreePlace self = around[kSelf];
    if (self.is_brick()) found[self.index()] = describe(octree, around);
    if (!self.is_node()) return;
    const Block block = places_around_children(octree, around);
    for (std::size_t child = 0; child < field::kChildren; ++child)
        if (!octree.nodes[self.index()][child].is_empty()) walk(octree, around_child(block, child), found);
}

// The same for what owns the places: codes of UpperNode::children, of which tiles' insides inherit their tile's.
constexpr std::uint32_t kChangedNothing = 0xFFFFFFFEU; // nothing now, but something before

struct Surroundings {
    Places places;
    std::array<std::uint32_t, kDirections> owners;
};

// Calls visit(tile, surroundings) for the tiles below those upper nodes that lead on, depth first. `changes` may be
// null.
template <class LeadsOn, class Visit> class UpperWalk {
public:
    UpperWalk(const Octree& octree, const OctreeChanges* changes, const LeadsOn& leads_on, const Visit& visit)
        : octree_(octree), changes_(changes), leads_on_(leads_on), visit_(visit) {}

    void walk() {
        Surroundings root;
        root.owners.fill(UpperNode::kNothing);
        root.places[kSelf] = OctreePlace::node(octree_.upper[0].node);
        root.owners[kSelf] = UpperNode::node_code(0);
        walk(root);
    }

private:
    std::uint32_t owner_of_child(std::uint32_t owner, std::size_t child) const {
        if (owner == kChangedNothing || !UpperNode::is_node(owner)) return owner;
        const std::uint32_t parent = UpperNode::node_of(owner);
        const std::uint32_t code = octree_.upper[parent].children[child];
        const bool gone =
            code == UpperNode::kNothing && changes_ != nullptr && (changes_->children[parent] >> child & 1) != 0;
        return gone ? kChangedNothing : code;
    }

    void walk(const Surroundings& around) {
        const Block block = places_around_children(octree_, around.places);
        std::array<std::uint32_t, 64> owners;
        std::size_t n = 0;
        for (const Step z : kSteps)
            for (const Step y : kSteps)
                for (const Step x : kSteps)
                    owners[n++] =
                        owner_of_child(around.owners[static_cast<std::size_t>(x.place + 3 * y.place + 9 * z.place)],
                                       static_cast<std::size_t>(x.child + 2 * y.child + 4 * z.child));
        const UpperNode& self = octree_.upper[UpperNode::node_of(around.owners[kSelf])];
        for (std::size_t child = 0; child < field::kChildren; ++child) {
            if (self.children[child] == UpperNode::kNothing) continue;
            Surroundings next;
            next.places = around_child(block, child);
            next.owners = around_child(owners, child);
            if (UpperNode::is_tile(self.children[child]))
                visit_(self.children[child], next);
            else if (leads_on_(next))
                walk(next);
        }
    }

    const Octree& octree_;
    const OctreeChanges* changes_;
    const LeadsOn& leads_on_;
    const Visit& visit_;
};

} // namespace

void OctreeChanges::mark(const Octree& octree, std::uint32_t upper) {
    for (; below[upper] == 0; upper = octree.upper[upper].parent) below[upper] = 1;
}

void find_neighbours(const Octree& octree, std::span<const std::uint32_t> tiles, ChunkedArray<Neighbourhood>& found) {
    found.resize(octree.bricks.size());
    OctreeChanges wanted;
    wanted.tiles.assign(octree.tiles.size(), 0);
    wanted.below.assign(octree.upper.size(), 0);
    for (const std::uint32_t tile : tiles) {
        const Tile& t = octree.tiles[tile];
        found.provide(t.first_brick, t.first_brick + t.brick_count);
        wanted.tiles[tile] = 1, wanted.mark(octree, t.parent);
    }
    std::vector<Places> around;
    around.reserve(tiles.size());
    const auto collect = [&](std::uint32_t tile, const Surroundings& surroundings) {
        if (wanted.tiles[tile] != 0) around.push_back(surroundings.places);
    };
    const auto leads_on = [&](const Surroundings& around_node) {
        return wanted.below[UpperNode::node_of(around_node.owners[kSelf])] != 0;
    };
    UpperWalk(octree, nullptr, leads_on, collect).walk();
    tbb::parallel_for(std::size_t{0}, around.size(), [&](std::size_t i) { walk(octree, around[i], found); });
}

std::vector<std::uint32_t> tiles_beside(const Octree& octree, const OctreeChanges& changes) {
    std::vector<std::uint32_t> beside;
    const auto touches_changes = [&](const Surroundings& around) {
        return std::ranges::any_of(around.owners, [&](std::uint32_t owner) {
            if (owner == kChangedNothing) return true;
            if (owner == UpperNode::kNothing) return false;
            return UpperNode::is_tile(owner) ? changes.tiles[owner] != 0
                                             : changes.below[UpperNode::node_of(owner)] != 0;
        });
    };
    const auto visit = [&](std::uint32_t tile, const Surroundings& around) {
        if (changes.tiles[tile] == 0 && touches_changes(around)) beside.push_back(tile);
    };
    UpperWalk(octree, &changes, touches_changes, visit).walk();
    return beside;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> touching_tiles(const Octree& octree) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    const auto everywhere = [](const Surroundings&) { return true; };
    // The smaller of two sees the larger one; of two of the same size the first notes it.
    const auto visit = [&](std::uint32_t tile, const Surroundings& around) {
        for (const std::uint32_t owner : around.owners) {
            if (owner == UpperNode::kNothing || !UpperNode::is_tile(owner) || owner == tile) continue;
            if (octree.tiles[owner].level > octree.tiles[tile].level || tile < owner) pairs.emplace_back(tile, owner);
        }
    };
    UpperWalk(octree, nullptr, everywhere, visit).walk();
    return pairs;
}

} // namespace ramus::mesh::bricks
