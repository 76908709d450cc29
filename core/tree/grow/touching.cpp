#include "core/tree/grow/touching.h"

#include "core/base/sort_unique.h"

#include <algorithm>

namespace ramus::tree::growth {

namespace {

std::size_t piece_count(const Centerlines& lines) {
    std::size_t count = 0;
    for (const auto& line : lines) count += line.empty() ? 0 : line.size() - 1;
    return count;
}

} // namespace

Touching::Touching(const Skeleton& tree, const Centerlines& lines, const Organ& organ, double joint_reach)
    : tree_(tree), joint_reach_(joint_reach), level_(tree.nodes.size(), 0), length_(tree.nodes.size(), 0.0),
      of_segment_(tree.nodes.size(), {0, 0}),
      grid_(organ.low(), organ.high(),
            cube_root(organ.volume_mm3() / static_cast<double>(std::max<std::size_t>(piece_count(lines), 1000)))) {
    for (const int id : tree.from_root())
        if (id > 0) level_[static_cast<std::size_t>(id)] = level_[static_cast<std::size_t>(tree.at(id).parent)] + 1;
    for (std::size_t segment = 1; segment < lines.size(); ++segment) take(lines, segment);
}

void Touching::take(const Centerlines& lines, std::size_t segment) {
    auto& [first, last] = of_segment_[segment];
    for (std::size_t i = first; i < last; ++i) grid_.remove(static_cast<int>(i));
    first = pieces_.size();
    double& length = length_[segment];
    length = 0.0;
    const auto& line = lines[segment];
    const double radius = tree_.radius_mm(static_cast<int>(segment));
    for (std::size_t k = 1; k < line.size(); ++k) {
        grid_.insert(static_cast<int>(pieces_.size()), line[k - 1], line[k], radius);
        pieces_.push_back({static_cast<int>(segment), line[k - 1], line[k], length});
        length += glm::length(line[k] - line[k - 1]);
    }
    last = pieces_.size();
}

// Whether the way along the tree between two points, each given by its segment and arc length, is at most `limit`.
bool Touching::way_within(int a, double along_a, int b, double along_b, double limit) const {
    const auto level = [&](int segment) { return level_[static_cast<std::size_t>(segment)]; };
    const auto length = [&](int segment) { return length_[static_cast<std::size_t>(segment)]; };
    if (a == b) return std::max(along_a, along_b) - std::min(along_a, along_b) <= limit;
    if (level(a) < level(b)) {
        std::swap(a, b);
        std::swap(along_a, along_b);
    }
    double way = along_a; // from the first point to the start of segment a
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

std::vector<std::pair<int, int>> Touching::find(const Centerlines& lines, const std::vector<bool>& changed,
                                                const std::vector<bool>& marked) {
    for (std::size_t segment = 1; segment < lines.size(); ++segment)
        if (changed[segment]) take(lines, segment);
    std::vector<std::pair<int, int>> pairs;
    std::vector<int> near;
    for (std::size_t segment = 1; segment < lines.size(); ++segment) {
        if (!marked[segment]) continue;
        const double radius = tree_.radius_mm(static_cast<int>(segment));
        for (std::size_t i = of_segment_[segment].first; i < of_segment_[segment].second; ++i) {
            const Piece& piece = pieces_[i];
            grid_.query(piece.a, piece.b, radius, near);
            for (const int other_id : near) {
                const Piece& other = pieces_[static_cast<std::size_t>(other_id)];
                // A pair of marked segments occurs twice, and is tested once.
                if (other_id < static_cast<int>(i) && marked[static_cast<std::size_t>(other.segment)]) continue;
                const double sum = radius + tree_.radius_mm(other.segment);
                const Approach at = closest_approach(piece.a, piece.b, other.a, other.b);
                if (at.distance >= sum) continue;
                const double along = piece.from_start_mm + at.first * glm::length(piece.b - piece.a);
                const double other_along = other.from_start_mm + at.second * glm::length(other.b - other.a);
                if (way_within(piece.segment, along, other.segment, other_along, joint_reach_ * sum)) continue;
                pairs.emplace_back(std::min(piece.segment, other.segment), std::max(piece.segment, other.segment));
            }
        }
    }
    sort_unique(pairs);
    return pairs;
}

} // namespace ramus::tree::growth
