#include "core/mesh/polygonize/octree/octree.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <oneapi/tbb/parallel_for.h>
#include <span>

namespace ramus::mesh::bricks {

namespace {

using Indices = std::span<const std::uint32_t>;

// A cube of the octree with what of the tree concerns it.
struct Cube {
    glm::ivec3 corner{0};
    int level = 0;
    Indices segments, pieces;
};

// The children of a cube that the surface may cross, and the memory of their lists.
struct Children {
    enum class Verdict { kOutside, kInside, kBrick, kSplit };
    std::array<Verdict, field::kChildren> verdicts{};
    std::array<Cube, field::kChildren> cubes;

    std::vector<std::uint32_t> segments, pieces;
    std::vector<std::uint8_t> bits;
};

// Deals out `list` to the children by the bits beside it; `memory` is to hold the lists.
std::array<Indices, field::kChildren> deal(Indices list, std::span<const std::uint8_t> bits,
                                           std::vector<std::uint32_t>& memory) {
    if (memory.size() < field::kChildren * list.size()) memory.resize(field::kChildren * list.size());
    std::array<std::uint32_t*, field::kChildren> begin;
    for (std::size_t c = 0; c < field::kChildren; ++c) begin[c] = memory.data() + c * list.size();
    auto end = begin;
    for (std::size_t m = 0; m < list.size(); ++m) {
        for (std::size_t c = 0; c < field::kChildren; ++c) {
            *end[c] = list[m]; // overwritten by the next where the bit is not set
            end[c] += bits[m] >> c & 1;
        }
    }
    std::array<Indices, field::kChildren> lists;
    for (std::size_t c = 0; c < field::kChildren; ++c) lists[c] = Indices(begin[c], end[c]);
    return lists;
}

class Splitter {
public:
    Splitter(const field::ConvolutionField& field, const field::CullingSegments& culling, const Sizing& sizing,
             const Lattice& lattice)
        : field_(field), culling_(culling), sizing_(sizing), lattice_(lattice),
          isovalue_(static_cast<float>(field.kernel().isovalue)) {}

    void split(const Cube& cube, Children& children) const {
        const int level = cube.level - 1;
        const double side = lattice_.unit_mm * brick_units(level);
        const glm::vec3 middle(lattice_.position(cube.corner) + glm::dvec3(side) - culling_.origin);
        children.bits.resize(std::max(cube.segments.size(), cube.pieces.size()));
        const auto bounds =
            field::cull_children(field_, culling_, cube.segments, middle, static_cast<float>(side), children.bits);
        const auto segments = deal(cube.segments, children.bits, children.segments);
        bool some = false;
        for (int c = 0; c < field::kChildren; ++c) {
            const auto i = static_cast<std::size_t>(c);
            // The margin is far above the rounding of a sample, so a dropped region never hides a change of sign.
            children.verdicts[i] = bounds.upper[i] < isovalue_ * 0.999F   ? Children::Verdict::kOutside
                                   : bounds.lower[i] > isovalue_ * 1.001F ? Children::Verdict::kInside
                                                                          : Children::Verdict::kBrick;
            some = some || children.verdicts[i] == Children::Verdict::kBrick;
            const glm::ivec3 corner = cube.corner + glm::ivec3(c & 1, c >> 1 & 1, c >> 2) * brick_units(level);
            children.cubes[i] = {corner, level, segments[i], {}};
        }
        if (!some || level == 0) return;
        std::array<Indices, field::kChildren> pieces;
        const bool uniform = sizing_.pieces.empty();
        if (!uniform) {
            active_children(sizing_, cube.pieces, middle, static_cast<float>(side), children.bits);
            pieces = deal(cube.pieces, children.bits, children.pieces);
        }
        for (std::size_t c = 0; c < field::kChildren; ++c) {
            if (children.verdicts[c] != Children::Verdict::kBrick) continue;
            if (uniform || !pieces[c].empty()) children.verdicts[c] = Children::Verdict::kSplit;
            children.cubes[c].pieces = pieces[c];
        }
    }

private:
    const field::ConvolutionField& field_;
    const field::CullingSegments& culling_;
    const Sizing& sizing_;
    const Lattice& lattice_;
    float isovalue_;
};

// Part of an octree, counted from its own beginnings.
struct Part {
    OctreePlace top;
    std::vector<OctreeNode> nodes;
    std::vector<Brick> bricks;
    std::vector<std::uint32_t> lists;

    OctreePlace add_brick(const Cube& cube) {
        bricks.push_back({cube.corner, cube.level, static_cast<std::uint32_t>(lists.size()),
                          static_cast<std::uint32_t>(cube.segments.size()), 0});
        lists.insert(lists.end(), cube.segments.begin(), cube.segments.end());
        return OctreePlace::brick(bricks.size() - 1);
    }
};

// Depth first, children in Morton order: the order of the bricks is the same in every run. `scratch` has an entry for
// every level.
OctreePlace descend(const Splitter& splitter, const Cube& cube, std::span<Children> scratch, Part& part) {
    const std::size_t index = part.nodes.size();
    part.nodes.emplace_back();
    Children& children = scratch.front();
    splitter.split(cube, children);
    for (std::size_t c = 0; c < field::kChildren; ++c) {
        OctreePlace place;
        if (children.verdicts[c] == Children::Verdict::kInside) place = OctreePlace::full();
        if (children.verdicts[c] == Children::Verdict::kBrick) place = part.add_brick(children.cubes[c]);
        if (children.verdicts[c] == Children::Verdict::kSplit)
            place = descend(splitter, children.cubes[c], scratch.subspan(1), part);
        part.nodes[index][c] = place; // by index: the recursion adds nodes
    }
    return OctreePlace::node(index);
}

// The upper octree, down to the tiles. A frontier entry is a cube still to be split, with its own memory, or a tile.
struct FrontierEntry {
    Cube cube;
    bool is_brick = false, is_tile = false;
    std::uint32_t parent = 0, child = 0;
    std::vector<std::uint32_t> segments, pieces; // what the cube's lists point to
};

FrontierEntry frontier_entry(const Children& children, std::size_t c, std::uint32_t parent, const Sizing& sizing,
                             const Lattice& lattice) {
    FrontierEntry entry;
    entry.cube = children.cubes[c];
    entry.is_brick = children.verdicts[c] == Children::Verdict::kBrick;
    entry.is_tile =
        entry.is_brick || entry.cube.level <= finest_level(sizing, entry.cube.pieces, lattice) + kTileLevels;
    entry.parent = parent;
    entry.child = static_cast<std::uint32_t>(c);
    entry.segments.assign(entry.cube.segments.begin(), entry.cube.segments.end());
    entry.pieces.assign(entry.cube.pieces.begin(), entry.cube.pieces.end());
    entry.cube.segments = entry.segments;
    entry.cube.pieces = entry.pieces;
    return entry;
}

// Splits all cubes larger than tiles, and returns the tiles in depth-first order.
std::vector<FrontierEntry> find_tiles(const Splitter& splitter, const Cube& root, const Sizing& sizing,
                                      const Lattice& lattice, LargeArray<OctreeNode>& nodes) {
    std::vector<FrontierEntry> frontier(1);
    frontier[0].cube = root;
    for (bool some = true; some;) {
        const auto first_node = static_cast<std::uint32_t>(nodes.size());
        std::vector<std::uint32_t> node_of(frontier.size());
        std::uint32_t added = 0;
        for (std::size_t i = 0; i < frontier.size(); ++i) {
            if (frontier[i].is_tile) continue;
            node_of[i] = first_node + added++;
            if (node_of[i] > 0) nodes[frontier[i].parent][frontier[i].child] = OctreePlace::node(node_of[i]);
        }
        some = added > 0;
        nodes.resize(nodes.size() + added, OctreeNode{});
        std::vector<std::vector<FrontierEntry>> next(frontier.size());
        tbb::parallel_for(std::size_t{0}, frontier.size(), [&](std::size_t i) {
            if (frontier[i].is_tile) {
                next[i].push_back(std::move(frontier[i]));
                return;
            }
            thread_local Children children;
            splitter.split(frontier[i].cube, children);
            for (std::size_t c = 0; c < field::kChildren; ++c) {
                if (children.verdicts[c] == Children::Verdict::kInside) nodes[node_of[i]][c] = OctreePlace::full();
                if (children.verdicts[c] >= Children::Verdict::kBrick)
                    next[i].push_back(frontier_entry(children, c, node_of[i], sizing, lattice));
            }
        });
        frontier.clear();
        for (auto& part : next) std::ranges::move(part, std::back_inserter(frontier));
    }
    return frontier;
}

} // namespace

int levels_needed(const field::ConvolutionField& field, const Sizing& sizing) {
    const glm::dvec3 extent = field.upper() - field.lower();
    const double largest = std::max({extent.x, extent.y, extent.z});
    return std::max(1, static_cast<int>(std::ceil(std::log2(largest / (4.0 * sizing.finest_cell_mm)))) + 1);
}

Octree build_octree(const field::ConvolutionField& field, const field::CullingSegments& culling, const Sizing& sizing,
                    Job& job) {
    Octree octree;
    octree.top_level = levels_needed(field, sizing);
    octree.lattice.unit_mm = 0.25 * sizing.finest_cell_mm;
    const double root_mm = octree.lattice.unit_mm * brick_units(octree.top_level);
    octree.lattice.origin = 0.5 * (field.lower() + field.upper()) - glm::dvec3(0.5 * root_mm);

    std::vector<std::uint32_t> all(std::max(field.segments().size(), sizing.pieces.size()));
    std::iota(all.begin(), all.end(), 0U);
    Cube root;
    root.level = octree.top_level;
    root.segments = Indices(all).first(field.segments().size());
    root.pieces = Indices(all).first(sizing.pieces.size());

    const Splitter splitter(field, culling, sizing, octree.lattice);
    std::vector<FrontierEntry> tiles = find_tiles(splitter, root, sizing, octree.lattice, octree.nodes);
    octree.upper_nodes = octree.nodes.size();
    std::vector<Part> parts(tiles.size());
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        thread_local std::vector<Children> scratch(kMaximumLevels + 2);
        const FrontierEntry& entry = tiles[i];
        parts[i].top =
            entry.is_brick ? parts[i].add_brick(entry.cube) : descend(splitter, entry.cube, scratch, parts[i]);
        tiles[i].segments = {}, tiles[i].pieces = {};
    });
    if (job.cancelled()) return octree;

    struct First {
        std::size_t node, brick, list;
    };
    std::vector<First> first(parts.size() + 1);
    first[0] = {octree.nodes.size(), 0, 0};
    octree.tiles.reserve(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        first[i + 1] = {first[i].node + parts[i].nodes.size(), first[i].brick + parts[i].bricks.size(),
                        first[i].list + parts[i].lists.size()};
        octree.nodes[tiles[i].parent][tiles[i].child] = parts[i].top.shifted(first[i].brick, first[i].node);
        octree.tiles.push_back({tiles[i].parent, tiles[i].child, static_cast<std::uint32_t>(first[i].brick),
                                static_cast<std::uint32_t>(parts[i].bricks.size())});
    }
    octree.nodes.resize(first.back().node);
    octree.bricks.resize(first.back().brick);
    octree.lists.resize(first.back().list);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
        const auto& [node, brick, list] = first[i];
        for (std::size_t n = 0; n < parts[i].nodes.size(); ++n)
            for (std::size_t c = 0; c < field::kChildren; ++c)
                octree.nodes[node + n][c] = parts[i].nodes[n][c].shifted(brick, node);
        for (std::size_t n = 0; n < parts[i].bricks.size(); ++n) {
            octree.bricks[brick + n] = parts[i].bricks[n];
            octree.bricks[brick + n].list_begin += static_cast<std::uint32_t>(list);
            octree.bricks[brick + n].tile = static_cast<std::uint32_t>(i);
        }
        std::ranges::copy(parts[i].lists, octree.lists.begin() + static_cast<std::ptrdiff_t>(list));
        parts[i] = {};
    });
    return octree;
}

} // namespace ramus::mesh::bricks
