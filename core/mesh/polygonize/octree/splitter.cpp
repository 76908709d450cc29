#include "core/mesh/polygonize/octree/splitter.h"

#include <algorithm>
#include <limits>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::mesh::bricks {

namespace {

// Distributes `list` to the children according to `bits`. `memory` receives the lists. Those of a short list get room
// for all of it; where that would be much, they are counted first.
std::array<Indices, field::kChildren> deal(Indices list, std::span<const std::uint8_t> bits,
                                           std::vector<std::uint32_t>& memory) {
    constexpr std::size_t kLong = std::size_t{1} << 16;
    std::array<std::size_t, field::kChildren + 1> first{};
    for (std::size_t c = 0; c < field::kChildren; ++c) {
        std::size_t room = list.size();
        if (list.size() > kLong)
            room = 1 + static_cast<std::size_t>(std::count_if(bits.begin(), bits.begin() + std::ssize(list),
                                                              [&](std::uint8_t b) { return (b >> c & 1) != 0; }));
        first[c + 1] = first[c] + room;
    }
    if (memory.size() < first.back()) memory.resize(first.back());
    std::array<std::uint32_t*, field::kChildren> begin;
    for (std::size_t c = 0; c < field::kChildren; ++c) begin[c] = memory.data() + first[c];
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

// A part of an octree with its own indices.
struct Part {
    OctreeEntry top;
    std::vector<OctreeNode> nodes;
    std::vector<Brick> bricks;
    std::vector<std::uint32_t> lists;

    OctreeEntry add_brick(const Cube& cube) {
        bricks.push_back({cube.corner, cube.level, static_cast<std::uint32_t>(lists.size()),
                          static_cast<std::uint32_t>(cube.segments.size()), 0});
        lists.insert(lists.end(), cube.segments.begin(), cube.segments.end());
        return OctreeEntry::brick(bricks.size() - 1);
    }
};

bool has_bricks(const Octree& octree, const Subtree& subtree, const Part& part) {
    const auto same = [](const Brick& a, const Brick& b) { return a.corner == b.corner && a.level == b.level; };
    return std::ranges::equal(std::span(octree.bricks).subspan(subtree.first_brick, subtree.brick_count), part.bricks,
                              same);
}

// Builds a part depth first, children in Morton order, so that the order of bricks is the same in every run. `scratch`
// has an entry for every level.
OctreeEntry descend(const Splitter& splitter, const Cube& cube, std::span<Children> scratch, Part& part) {
    const std::size_t index = part.nodes.size();
    part.nodes.emplace_back();
    Children& children = scratch.front();
    splitter.split(cube, children);
    for (std::size_t c = 0; c < field::kChildren; ++c) {
        OctreeEntry entry;
        if (children.verdicts[c] == Children::Verdict::kInside) entry = OctreeEntry::full();
        if (children.verdicts[c] == Children::Verdict::kBrick) entry = part.add_brick(children.cubes[c]);
        if (children.verdicts[c] == Children::Verdict::kSplit)
            entry = descend(splitter, children.cubes[c], scratch.subspan(1), part);
        part.nodes[index][c] = entry; // by index: the recursion adds nodes
    }
    return OctreeEntry::node(index);
}

} // namespace

glm::vec3 Splitter::middle_of(const Cube& cube) const {
    return glm::vec3(lattice.position(cube.corner) + glm::dvec3(child_side(cube)) - field.extent().middle());
}

void Splitter::split(const Cube& cube, Children& children, bool upper) const {
    const int level = cube.level - 1;
    const field::ChildCubes cubes = children_of(cube);
    const float isovalue = field.isovalue();
    children.bits.resize(std::max(cube.segments.size(), cube.pieces.size()));
    const auto bounds = field.bound_children(cube.segments, cubes, children.bits);
    const auto segments = deal(cube.segments, children.bits, children.segments);
    bool some = false;
    for (int c = 0; c < field::kChildren; ++c) {
        const auto i = static_cast<std::size_t>(c);
        // The margin is far above the rounding of a sample, so no sign change is ever dropped.
        children.verdicts[i] = bounds.upper[i] < isovalue * 0.999F   ? Children::Verdict::kOutside
                               : bounds.lower[i] > isovalue * 1.001F ? Children::Verdict::kInside
                                                                     : Children::Verdict::kBrick;
        some = some || children.verdicts[i] == Children::Verdict::kBrick;
        const glm::ivec3 corner = cube.corner + glm::ivec3(c & 1, c >> 1 & 1, c >> 2) * brick_units(level);
        children.cubes[i] = {corner, level, segments[i], {}};
    }
    if (!some || level == 0) return;
    std::array<Indices, field::kChildren> pieces;
    const bool uniform = sizing.pieces.empty();
    if (!uniform) {
        const std::span<const SizingPiece> all = upper ? std::span(sizing.groups) : std::span(sizing.pieces);
        children.bits.resize(std::max(children.bits.size(), cube.pieces.size()));
        active_children(all, cube.pieces, cubes, children.bits);
        pieces = deal(cube.pieces, children.bits, children.pieces);
    }
    for (std::size_t c = 0; c < field::kChildren; ++c) {
        if (children.verdicts[c] != Children::Verdict::kBrick) continue;
        if (uniform || !pieces[c].empty()) children.verdicts[c] = Children::Verdict::kSplit;
        children.cubes[c].pieces = pieces[c];
    }
}

bool Splitter::any_active(const Cube& cube, std::size_t child, Indices groups) const {
    const field::ChildCubes cubes = children_of(cube);
    std::array<std::uint8_t, Sizing::kGroupPieces> bits;
    return std::ranges::any_of(groups, [&](std::uint32_t group) {
        const Indices members = pieces_of_group(sizing, group);
        active_children(sizing.pieces, members, cubes, bits);
        return std::any_of(bits.begin(), bits.begin() + static_cast<std::ptrdiff_t>(members.size()),
                           [&](std::uint8_t b) { return (b >> child & 1) != 0; });
    });
}

void Splitter::expand(const Cube& cube, std::size_t child, Indices groups, std::vector<std::uint32_t>& pieces) const {
    const field::ChildCubes cubes = children_of(cube);
    std::array<std::uint8_t, Sizing::kGroupPieces> bits;
    for (const std::uint32_t group : groups) {
        const Indices members = pieces_of_group(sizing, group);
        active_children(sizing.pieces, members, cubes, bits);
        for (std::size_t m = 0; m < members.size(); ++m)
            if ((bits[m] >> child & 1) != 0) pieces.push_back(members[m]);
    }
}

bool Splitter::is_subtree(const Cube& cube) const {
    float thinnest = std::numeric_limits<float>::max();
    for (const std::uint32_t index : cube.segments) {
        const field::FieldSegment& s = field.skeleton().segments()[index];
        thinnest = std::min({thinnest, s.radius, s.end_radius()});
    }
    return cube.level <= level_of_radius(sizing, thinnest, lattice) + kSubtreeLevels;
}

Seed::Seed(const Splitter& splitter, const Cube& parent_cube, const Children& children, std::size_t c,
           std::uint32_t parent_node)
    : cube(children.cubes[c]), is_brick(children.verdicts[c] == Children::Verdict::kBrick), parent(parent_node),
      child(static_cast<std::uint32_t>(c)), segments(cube.segments.begin(), cube.segments.end()) {
    is_subtree = is_brick || splitter.is_subtree(cube);
    if (!is_subtree && !splitter.sizing.pieces.empty() && !splitter.any_active(parent_cube, c, cube.pieces)) {
        // No piece requires smaller cells here: is_subtree() saw the thin end of a long segment that lies elsewhere.
        is_brick = is_subtree = true;
    } else if (!is_subtree) {
        pieces.assign(cube.pieces.begin(), cube.pieces.end());
    } else if (!is_brick && !splitter.sizing.pieces.empty()) {
        splitter.expand(parent_cube, c, cube.pieces, pieces);
        is_brick = pieces.empty();
    }
    cube.segments = segments;
    cube.pieces = pieces;
}

namespace {

Part part_of(const Splitter& splitter, const Seed& seed) {
    thread_local std::vector<Children> scratch(kMaximumLevels + 2);
    Part part;
    part.top = seed.is_brick ? part.add_brick(seed.cube) : descend(splitter, seed.cube, scratch, part);
    return part;
}

// Appends the subtrees of some seeds. Moves the seeds that were not skipped to the front, and returns their number.
std::size_t append_some(const Splitter& splitter, std::span<Seed> seeds, Octree& octree, const Job& job) {
    std::vector<Part> parts(seeds.size());
    tbb::parallel_for(std::size_t{0}, seeds.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        parts[i] = part_of(splitter, seeds[i]);
        seeds[i].segments = {}, seeds[i].pieces = {};
    });
    if (job.cancelled()) return 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (seeds[i].present != UpperNode::kNothing && has_bricks(octree, octree.subtrees[seeds[i].present], parts[i]))
            continue;
        if (kept != i) seeds[kept] = std::move(seeds[i]), parts[kept] = std::move(parts[i]);
        ++kept;
    }
    parts.resize(kept);

    struct First {
        std::size_t node, brick, list;
    };
    std::vector<First> first(parts.size() + 1);
    first[0] = {octree.nodes.size(), octree.bricks.size(), octree.lists.size()};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        first[i + 1] = {first[i].node + parts[i].nodes.size(), first[i].brick + parts[i].bricks.size(),
                        first[i].list + parts[i].lists.size()};
        UpperNode& parent = octree.upper[seeds[i].parent];
        octree.nodes[parent.node][seeds[i].child] = parts[i].top.shifted(first[i].brick, first[i].node);
        if (seeds[i].entered == UpperNode::kNothing) {
            seeds[i].entered = static_cast<std::uint32_t>(octree.subtrees.size());
            octree.subtrees.emplace_back();
        }
        parent.children[seeds[i].child] = UpperNode::subtree(seeds[i].entered);
        octree.subtrees[seeds[i].entered] = {seeds[i].parent,
                                             seeds[i].child,
                                             static_cast<std::uint32_t>(first[i].brick),
                                             static_cast<std::uint32_t>(parts[i].bricks.size()),
                                             seeds[i].cube.corner,
                                             seeds[i].cube.level};
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
            octree.bricks[brick + n].subtree = seeds[i].entered;
        }
        std::ranges::copy(parts[i].lists, octree.lists.begin() + static_cast<std::ptrdiff_t>(list));
        parts[i] = {};
    });
    return kept;
}

} // namespace

void append_subtrees(const Splitter& splitter, std::vector<Seed>& seeds, Octree& octree, Job& job) {
    // All at once, unless the octree is on the disk: then the parts being built are in memory.
    constexpr std::size_t kAtOnce = 2048;
    const bool on_disk = octree.lists.get_allocator().memory() != nullptr;
    const std::size_t at_once = on_disk ? kAtOnce : std::max<std::size_t>(seeds.size(), 1);
    std::size_t kept = 0;
    for (std::size_t first = 0; first < seeds.size() && !job.cancelled(); first += at_once) {
        const auto some = std::span(seeds).subspan(first, std::min(at_once, seeds.size() - first));
        const std::size_t entered = append_some(splitter, some, octree, job);
        for (std::size_t n = 0; n < entered; ++n, ++kept)
            if (kept != first + n) seeds[kept] = std::move(some[n]);
    }
    if (!job.cancelled()) seeds.resize(kept);
}

SubtreeSize size_of_subtree(const Splitter& splitter, const Seed& seed) {
    const Part part = part_of(splitter, seed);
    const auto is_parted = [&](const Brick& brick) {
        return splitter.field.keeps_apart(std::span(part.lists).subspan(brick.list_begin, brick.list_count));
    };
    return {static_cast<std::uint32_t>(part.bricks.size()),
            static_cast<std::uint32_t>(std::ranges::count_if(part.bricks, is_parted)), part.lists.size()};
}

} // namespace ramus::mesh::bricks
