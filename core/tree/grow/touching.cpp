#include "core/tree/grow/touching.h"

#include "core/tree/grow/segment_grid.h"

#include <algorithm>

namespace ramus::tree::growth {

namespace {

struct Piece {
    int segment;
    Vec a;
    Vec b;
    double from_start_mm; // arc length from the segment's parent node to a
};

class Ways {
public:
    Ways(const Skeleton& tree, std::vector<double> lengths) : tree_(tree), length_(std::move(lengths)) {
        level_.assign(tree.nodes.size(), 0);
        for (const int id : tree.from_root())
            if (id > 0) level_[static_cast<std::size_t>(id)] = level_[static_cast<std::size_t>(tree.at(id).parent)] + 1;
    }

    // Whether the way along the tree between two places, each given by its segment and arc length, is at most `limit`.
    [[nodiscard]] bool within(int a, double along_a, int b, double along_b, double limit) const {
        if (a == b) return std::max(along_a, along_b) - std::min(along_a, along_b) <= limit;
        if (level(a) < level(b)) {
            std::swap(a, b);
            std::swap(along_a, along_b);
        }
        double way = along_a; // from the first place to the start of segment a
        while (level(a) > level(b)) {
            a = tree_.at(a).parent;
            if (a == b) return way + length(b) - along_b <= limit;
            way += length(a);
            if (way > limit) return false;
        }
        way += along_b;
        while (tree_.at(a).parent != tree_.at(b).parent) {
            if (way > limit) return false;
            a = tree_.at(a).parent;
            b = tree_.at(b).parent;
            way += length(a) + length(b);
        }
        return way <= limit;
    }

private:
    [[nodiscard]] int level(int segment) const { return level_[static_cast<std::size_t>(segment)]; }
    [[nodiscard]] double length(int segment) const { return length_[static_cast<std::size_t>(segment)]; }

    const Skeleton& tree_;
    std::vector<double> length_;
    std::vector<int> level_;
};

} // namespace

std::vector<std::pair<int, int>> touching(const Skeleton& tree, const Centerlines& lines,
                                          const std::vector<bool>& changed, const Organ& organ, double spacing_mm,
                                          double joint_reach) {
    std::vector<Piece> pieces;
    std::vector<double> lengths(lines.size(), 0.0);
    for (std::size_t i = 0; i < lines.size(); ++i)
        for (std::size_t k = 1; k < lines[i].size(); ++k) {
            pieces.push_back({static_cast<int>(i), lines[i][k - 1], lines[i][k], lengths[i]});
            lengths[i] += glm::length(lines[i][k] - lines[i][k - 1]);
        }
    const Ways ways(tree, lengths);
    const double fair_cell = cube_root(organ.volume_mm3() / static_cast<double>(pieces.size() + 1));
    SegmentGrid grid(organ.low(), organ.high(), std::max(fair_cell, spacing_mm));
    std::vector<std::pair<int, int>> pairs;
    std::vector<int> near;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        const double radius = tree.radius_mm(piece.segment);
        grid.place(static_cast<int>(i), piece.a, piece.b, radius);
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        if (!changed[static_cast<std::size_t>(piece.segment)]) continue;
        const double radius = tree.radius_mm(piece.segment);
        grid.query(piece.a, piece.b, radius, near);
        for (const int other_id : near) {
            const Piece& other = pieces[static_cast<std::size_t>(other_id)];
            if (other_id < static_cast<int>(i) && changed[static_cast<std::size_t>(other.segment)])
                continue; // was seen
            const double sum = radius + tree.radius_mm(other.segment);
            const Approach at = closest_approach(piece.a, piece.b, other.a, other.b);
            if (at.distance >= sum) continue;
            const double along = piece.from_start_mm + at.first * glm::length(piece.b - piece.a);
            const double other_along = other.from_start_mm + at.second * glm::length(other.b - other.a);
            if (ways.within(piece.segment, along, other.segment, other_along, joint_reach * sum)) continue;
            pairs.emplace_back(std::min(piece.segment, other.segment), std::max(piece.segment, other.segment));
        }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

} // namespace ramus::tree::growth
