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
    enum class Verdict { kDropped, kBrick, kSplit };
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
            const bool dropped = bounds.upper[i] < isovalue_ * 0.999F || bounds.lower[i] > isovalue_ * 1.001F;
            children.verdicts[i] = dropped ? Children::Verdict::kDropped : Children::Verdict::kBrick;
            some = some || !dropped;
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
            if (children.verdicts[c] == Children::Verdict::kDropped) continue;
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
                          static_cast<std::uint32_t>(cube.segments.size())});
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
        if (children.verdicts[c] == Children::Verdict::kBrick) place = part.add_brick(children.cubes[c]);
        if (children.verdicts[c] == Children::Verdict::kSplit)
            place = descend(splitter, children.cubes[c], scratch.subspan(1), part);
        part.nodes[index][c] = place; // by index: the recursion adds nodes
    }
    return OctreePlace::node(index);
}

// The upper octree down to enough subtrees to keep all cores evenly busy. A frontier entry is a cube still to be split,
// with its own memory, or a finished brick.
struct FrontierEntry {
    Cube cube;
    bool is_brick = false;
    std::uint32_t parent = 0;
    int child = 0;
    std::vector<std::uint32_t> segments, pieces; // what the cube's lists point to
};

FrontierEntry frontier_entry(const Children& children, std::size_t c, std::uint32_t parent) {
    FrontierEntry entry;
    entry.cube = children.cubes[c];
    entry.is_brick = children.verdicts[c] == Children::Verdict::kBrick;
    entry.parent = parent;
    entry.child = static_cast<int>(c);
    entry.segments.assign(entry.cube.segments.begin(), entry.cube.segments.end());
    entry.pieces.assign(entry.cube.pieces.begin(), entry.cube.pieces.end());
    entry.cube.segments = entry.segments;
    entry.cube.pieces = entry.pieces;
    return entry;
}

std::vector<FrontierEntry> open_frontier(const Splitter& splitter, const Cube& root, std::size_t wanted,
                                         std::vector<OctreeNode>& nodes) {
    const auto split_all = [&](std::vector<FrontierEntry>& entries) {
        std::vector<std::vector<FrontierEntry>> next(entries.size());
        const auto first_node = static_cast<std::uint32_t>(nodes.size());
        std::vector<std::uint32_t> node_of(entries.size());
        std::uint32_t added = 0;
        for (std::size_t i = 0; i < entries.size(); ++i) {
            if (entries[i].is_brick) continue;
            node_of[i] = first_node + added++;
            if (node_of[i] > 0)
                nodes[entries[i].parent][static_cast<std::size_t>(entries[i].child)] = OctreePlace::node(node_of[i]);
        }
        nodes.resize(nodes.size() + added);
        tbb::parallel_for(std::size_t{0}, entries.size(), [&](std::size_t i) {
            if (entries[i].is_brick) {
                next[i].push_back(std::move(entries[i]));
                return;
            }
            Children children;
            splitter.split(entries[i].cube, children);
            for (std::size_t c = 0; c < field::kChildren; ++c)
                if (children.verdicts[c] != Children::Verdict::kDropped)
                    next[i].push_back(frontier_entry(children, c, node_of[i]));
        });
        entries.clear();
        for (auto& part : next) std::ranges::move(part, std::back_inserter(entries));
        return added > 0;
    };
    std::vector<FrontierEntry> frontier(1);
    frontier[0].cube = root;
    do {
        if (!split_all(frontier)) break;
    } while (frontier.size() < wanted);
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
    constexpr std::size_t kSubtrees = 512;
    std::vector<FrontierEntry> frontier = open_frontier(splitter, root, kSubtrees, octree.nodes);
    octree.upper_nodes = octree.nodes.size();
    std::vector<Part> parts(frontier.size());
    tbb::parallel_for(std::size_t{0}, frontier.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        thread_local std::vector<Children> scratch(kMaximumLevels + 2);
        const FrontierEntry& entry = frontier[i];
        parts[i].top =
            entry.is_brick ? parts[i].add_brick(entry.cube) : descend(splitter, entry.cube, scratch, parts[i]);
        frontier[i].segments = {}, frontier[i].pieces = {};
    });
    if (job.cancelled()) return octree;

    struct First {
        std::size_t node, brick, list;
    };
    std::vector<First> first(parts.size() + 1);
    first[0] = {octree.nodes.size(), 0, 0};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        first[i + 1] = {first[i].node + parts[i].nodes.size(), first[i].brick + parts[i].bricks.size(),
                        first[i].list + parts[i].lists.size()};
        const OctreePlace place = parts[i].top.shifted(first[i].brick, first[i].node);
        octree.nodes[frontier[i].parent][static_cast<std::size_t>(frontier[i].child)] = place;
        octree.subtrees.emplace_back(frontier[i].parent, frontier[i].child);
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
        }
        std::ranges::copy(parts[i].lists, octree.lists.begin() + static_cast<std::ptrdiff_t>(list));
        parts[i] = {};
    });
    return octree;
}

} // namespace ramus::mesh::bricks
