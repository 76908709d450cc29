#include "core/mesh/polygonize/octree/neighbours.h"

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

Places places_around_child(const Block& block, std::size_t child) {
    Places around;
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

void walk(const Octree& octree, const Places& around, LargeArray<Neighbourhood>& found) {
    const OctreePlace self = around[kSelf];
    if (self.is_brick()) found[self.index()] = describe(octree, around);
    if (!self.is_node()) return;
    const Block block = places_around_children(octree, around);
    for (std::size_t child = 0; child < field::kChildren; ++child)
        if (!octree.nodes[self.index()][child].is_empty()) walk(octree, places_around_child(block, child), found);
}

} // namespace

LargeArray<Neighbourhood> find_neighbours(const Octree& octree) {
    LargeArray<Neighbourhood> found(octree.bricks.size());
    // The upper nodes, down to the subtrees' parents, by hand: parents come before their children.
    std::vector<Places> around(octree.upper_nodes);
    around[0][kSelf] = OctreePlace::node(0);
    for (std::size_t n = 0; n < octree.upper_nodes; ++n) {
        const Block block = places_around_children(octree, around[n]);
        for (std::size_t child = 0; child < field::kChildren; ++child) {
            const OctreePlace place = octree.nodes[n][child];
            if (place.is_node() && place.index() < octree.upper_nodes)
                around[place.index()] = places_around_child(block, child);
        }
    }
    tbb::parallel_for(std::size_t{0}, octree.tiles.size(), [&](std::size_t i) {
        const Tile& tile = octree.tiles[i];
        const Block block = places_around_children(octree, around[tile.parent]);
        walk(octree, places_around_child(block, tile.child), found);
    });
    return found;
}

} // namespace ramus::mesh::bricks
