#include "core/mesh/polygonize/brick_set.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::mesh::bricks {

namespace {

constexpr float kSqrt3Half = 0.8660254F;

std::uint64_t hash(glm::ivec3 corner, int level) {
    // Corners of a level are multiples of its brick's edge: shift the zeros away before mixing.
    const auto x = static_cast<std::uint64_t>(static_cast<std::uint32_t>(corner.x >> (4 + level)));
    const auto y = static_cast<std::uint64_t>(static_cast<std::uint32_t>(corner.y >> (4 + level)));
    const auto z = static_cast<std::uint64_t>(static_cast<std::uint32_t>(corner.z >> (4 + level)));
    std::uint64_t h = (x * 0x9E3779B97F4A7C15ULL) ^ (y * 0xC2B2AE3D27D4EB4FULL) ^ (z * 0x165667B19E3779F9ULL) ^
                      (static_cast<std::uint64_t>(level) * 0xD6E8FEB86659FD93ULL);
    h ^= h >> 32;
    h *= 0xD6E8FEB86659FD93ULL;
    return h ^ (h >> 29);
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
        grew = false;
        std::vector<Frontier> next;
        for (Frontier& entry : frontier) {
            if (entry.leaf || entry.node.level == 0) {
                next.push_back(std::move(entry));
                continue;
            }
            for (int child = 0; child < 8; ++child) {
                Node node;
                node.corner = Splitter::child_corner(entry.node, child);
                node.level = entry.node.level - 1;
                const auto verdict = splitter.judge(entry.node.segments, entry.node.pieces, node);
                if (verdict == Splitter::Verdict::kDropped) continue;
                next.push_back({std::move(node), verdict == Splitter::Verdict::kLeaf});
                grew = true;
            }
        }
        frontier = std::move(next);
    }
    return frontier;
}

} // namespace

std::uint32_t BrickSet::find(glm::ivec3 corner, int level) const {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash(corner, level) & mask;; slot = (slot + 1) & mask) {
        const std::uint32_t index = slots_[slot];
        if (index == kNone) return kNone;
        if (bricks[index].level == level && bricks[index].corner == corner) return index;
    }
}

void BrickSet::build_index() {
    slots_.assign(std::bit_ceil(bricks.size() * 2 + 16), kNone);
    const std::size_t mask = slots_.size() - 1;
    for (std::uint32_t index = 0; index < bricks.size(); ++index) {
        std::size_t slot = hash(bricks[index].corner, bricks[index].level) & mask;
        while (slots_[slot] != kNone) slot = (slot + 1) & mask;
        slots_[slot] = index;
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
        if (frontier[i].leaf || frontier[i].node.level == 0) {
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
