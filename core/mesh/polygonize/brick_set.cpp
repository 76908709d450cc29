#include "core/mesh/polygonize/brick_set.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <numeric>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::mesh::bricks {

namespace {

constexpr float kSqrt3Half = 0.8660254F;

// Brick coordinates of a level fit kMaximumLevels bits each.
std::uint64_t pack(glm::ivec3 corner, int level) {
    // One bit more than kMaximumLevels: neighbours may lie just outside the root.
    const auto part = [&](int c) {
        return static_cast<std::uint64_t>(static_cast<std::uint32_t>(c >> (4 + level))) & 0x7FFFFU;
    };
    return (part(corner.x) << 43) | (part(corner.y) << 24) | (part(corner.z) << 5) | static_cast<std::uint64_t>(level);
}

std::uint64_t hash(std::uint64_t key) {
    key *= 0x9E3779B97F4A7C15ULL;
    return key ^ (key >> 32);
}

struct Node {
    glm::ivec3 corner{0};
    int level = 0;
    std::vector<std::uint32_t> segments;
    std::vector<std::uint32_t> pieces;
};

struct Leaves {
    std::vector<Brick> bricks;
    std::vector<std::uint32_t> lists;
};

class Splitter {
public:
    Splitter(const field::ConvolutionField& field, const field::CullingArrays& culling, const Sizing& sizing,
             const Lattice& lattice)
        : field_(field), culling_(culling), sizing_(sizing), lattice_(lattice),
          isovalue_(static_cast<float>(field.kernel().isovalue)) {}

    enum class Verdict { kDropped, kLeaf, kSplit };

    // Reduces the parent's lists to those of the node and decides what becomes of it.
    Verdict judge(const std::vector<std::uint32_t>& parent_segments, const std::vector<std::uint32_t>& parent_pieces,
                  Node& node) const {
        const double side = lattice_.unit_mm * brick_units(node.level);
        const glm::dvec3 middle = lattice_.position(node.corner) + glm::dvec3(0.5 * side);
        const glm::vec3 centre(middle - culling_.origin);
        // Single precision positions relative to the origin: widen the ball by what they may be off.
        const float rounding = 4e-7F * std::max({std::abs(centre.x), std::abs(centre.y), std::abs(centre.z)});
        const float ball = kSqrt3Half * static_cast<float>(side) * 1.0001F + rounding;
        const field::Bounds bounds = field::cull(field_, culling_, parent_segments, centre, ball, node.segments);
        // The margin is far above the rounding of a sample, so a dropped region never hides a change of sign.
        if (bounds.upper < isovalue_ * 0.999F || bounds.lower > isovalue_ * 1.001F) return Verdict::kDropped;
        if (node.level == 0) return Verdict::kLeaf;
        if (sizing_.pieces.empty()) return Verdict::kSplit;
        active_pieces(sizing_, parent_pieces, centre, static_cast<float>(side), node.pieces);
        return node.pieces.empty() ? Verdict::kLeaf : Verdict::kSplit;
    }

    static glm::ivec3 child_corner(const Node& node, int child) {
        const int half = brick_units(node.level - 1);
        return node.corner + glm::ivec3(child & 1, child >> 1 & 1, child >> 2) * half;
    }

    // Depth first, children in Morton order: the order of the leaves is the same in every run.
    void descend(const Node& node, std::vector<Node>& scratch, std::size_t depth, Leaves& leaves) const {
        if (scratch.size() <= depth) scratch.resize(depth + 8);
        for (int child = 0; child < 8; ++child) {
            // By index: the recursion may grow the scratch.
            scratch[depth].corner = child_corner(node, child);
            scratch[depth].level = node.level - 1;
            const Verdict verdict = judge(node.segments, node.pieces, scratch[depth]);
            if (verdict == Verdict::kLeaf) add_leaf(scratch[depth], leaves);
            if (verdict == Verdict::kSplit) {
                Node inner = std::move(scratch[depth]);
                descend(inner, scratch, depth + 1, leaves);
                scratch[depth] = std::move(inner);
            }
        }
    }

    static void add_leaf(const Node& node, Leaves& leaves) {
        leaves.bricks.push_back({node.corner, node.level, static_cast<std::uint32_t>(leaves.lists.size()),
                                 static_cast<std::uint32_t>(node.segments.size())});
        leaves.lists.insert(leaves.lists.end(), node.segments.begin(), node.segments.end());
    }

private:
    const field::ConvolutionField& field_;
    const field::CullingArrays& culling_;
    const Sizing& sizing_;
    const Lattice& lattice_;
    float isovalue_;
};

// A frontier entry: either a subtree still to be split, or (leaf) a finished brick.
struct Frontier {
    Node node;
    bool leaf = false;
};

std::vector<Frontier> open_frontier(const Splitter& splitter, Node root, std::size_t wanted) {
    std::vector<Frontier> frontier;
    frontier.push_back({std::move(root), false});
    for (bool grew = true; grew && frontier.size() < wanted;) {
        std::vector<std::vector<Frontier>> next(frontier.size());
        tbb::parallel_for(std::size_t{0}, frontier.size(), [&](std::size_t i) {
            Frontier& entry = frontier[i];
            if (entry.leaf) {
                next[i].push_back(std::move(entry));
                return;
            }
            for (int child = 0; child < 8; ++child) {
                Node node;
                node.corner = Splitter::child_corner(entry.node, child);
                node.level = entry.node.level - 1;
                const auto verdict = splitter.judge(entry.node.segments, entry.node.pieces, node);
                if (verdict != Splitter::Verdict::kDropped)
                    next[i].push_back({std::move(node), verdict == Splitter::Verdict::kLeaf});
            }
        });
        grew = std::ranges::any_of(frontier, [](const Frontier& entry) { return !entry.leaf; });
        frontier.clear();
        for (auto& part : next) std::ranges::move(part, std::back_inserter(frontier));
    }
    return frontier;
}

} // namespace

const BrickSet::Cube* BrickSet::find(glm::ivec3 corner, int level) const {
    const std::uint64_t key = pack(corner, level);
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash(key) & mask;; slot = (slot + 1) & mask) {
        if (slots_[slot] == kNone) return nullptr;
        if (cubes_[slots_[slot]].key == key) return &cubes_[slots_[slot]];
    }
}

BrickSet::Cube& BrickSet::insert(glm::ivec3 corner, int level, bool& is_new) {
    const std::uint64_t key = pack(corner, level);
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash(key) & mask;
    while (slots_[slot] != kNone && cubes_[slots_[slot]].key != key) slot = (slot + 1) & mask;
    is_new = slots_[slot] == kNone;
    if (is_new) {
        slots_[slot] = static_cast<std::uint32_t>(cubes_.size());
        Cube& cube = cubes_.emplace_back();
        cube.key = key;
        cube.children.fill(kNone);
    }
    return cubes_[slots_[slot]];
}

void BrickSet::build_index() {
    // Only what a neighbour one level finer, equal or coarser can meet: each brick's parent, the parent's mark in its
    // own parent, and the brick itself where it lies beside smaller ones, which cannot be known here, so always.
    slots_.assign(std::bit_ceil(bricks.size() * 4 + 64), kNone);
    cubes_.clear();
    cubes_.reserve(bricks.size() * 3 / 2 + 16);
    const auto child_of = [](glm::ivec3 corner, int level) {
        const int bit = 4 + level;
        return static_cast<std::size_t>((corner.x >> bit & 1) | (corner.y >> bit & 1) << 1 |
                                        (corner.z >> bit & 1) << 2);
    };
    const auto parent_corner = [](glm::ivec3 corner, int level) {
        return corner & glm::ivec3(~(2 * brick_units(level) - 1));
    };
    for (std::uint32_t index = 0; index < bricks.size(); ++index) {
        const Brick& brick = bricks[index];
        bool is_new = false;
        insert(brick.corner, brick.level, is_new).brick = index;
        const glm::ivec3 parent = parent_corner(brick.corner, brick.level);
        insert(parent, brick.level + 1, is_new).children[child_of(brick.corner, brick.level)] = index;
        if (!is_new) continue;
        const glm::ivec3 grandparent = parent_corner(parent, brick.level + 1);
        insert(grandparent, brick.level + 2, is_new).children[child_of(parent, brick.level + 1)] = kFiner;
    }
}

int levels_needed(const field::ConvolutionField& field, const Sizing& sizing) {
    const glm::dvec3 extent = field.upper() - field.lower();
    const double largest = std::max({extent.x, extent.y, extent.z});
    return std::max(1, static_cast<int>(std::ceil(std::log2(largest / (4.0 * sizing.finest_cell_mm)))) + 1);
}

BrickSet build_bricks(const field::ConvolutionField& field, const field::CullingArrays& culling, const Sizing& sizing,
                      Job& job) {
    BrickSet set;
    set.top_level = levels_needed(field, sizing);
    set.lattice.unit_mm = 0.25 * sizing.finest_cell_mm;
    const double root_mm = set.lattice.unit_mm * brick_units(set.top_level);
    set.lattice.origin = 0.5 * (field.lower() + field.upper()) - glm::dvec3(0.5 * root_mm);

    const Splitter splitter(field, culling, sizing, set.lattice);
    Node root;
    root.level = set.top_level;
    root.segments.resize(field.segments().size());
    std::iota(root.segments.begin(), root.segments.end(), 0U);
    root.pieces.resize(sizing.pieces.size());
    std::iota(root.pieces.begin(), root.pieces.end(), 0U);

    constexpr std::size_t kSubtrees = 512; // enough to keep any number of cores evenly busy
    const std::vector<Frontier> frontier = open_frontier(splitter, std::move(root), kSubtrees);
    std::vector<Leaves> parts(frontier.size());
    tbb::parallel_for(std::size_t{0}, frontier.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        if (frontier[i].leaf) {
            Splitter::add_leaf(frontier[i].node, parts[i]);
        } else {
            std::vector<Node> scratch;
            splitter.descend(frontier[i].node, scratch, 0, parts[i]);
        }
    });
    if (job.cancelled()) return set;

    std::size_t brick_count = 0;
    std::size_t list_count = 0;
    for (const Leaves& part : parts) brick_count += part.bricks.size(), list_count += part.lists.size();
    set.bricks.reserve(brick_count);
    set.lists.reserve(list_count);
    for (Leaves& part : parts) {
        const auto shift = static_cast<std::uint32_t>(set.lists.size());
        for (Brick brick : part.bricks) {
            brick.list_begin += shift;
            set.bricks.push_back(brick);
        }
        set.lists.insert(set.lists.end(), part.lists.begin(), part.lists.end());
        part = {};
    }
    set.build_index();
    return set;
}

} // namespace ramus::mesh::bricks
