#include "core/tree/curves.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace ramus::tree {

namespace {

constexpr double kRounded = 1.0;   // radii: the farthest from a point that its corner is rounded
constexpr double kShort = 0.4;     // radii: the kernel rounds corners of segments shorter than twice this length
constexpr double kSlight = 5.0;    // degrees: a corner that turns by less stays
constexpr double kPerPiece = 45.0; // degrees that a piece of half a corner stands for
constexpr int kMostPieces = 3;     // for half a corner
constexpr double kMeet = 1e-9;     // share of a segment: two corners meet if no more than this is straight between them

// The rounding of the corner at an inner point.
struct Corner {
    double reach = 0.0; // mm along both segments; 0: it stays
    int pieces = 0;     // for each half
};

// The slope of the radius (per mm) at an inner point, from the slopes of the segments before and after it.
double monotone_slope(double before, double behind, double length_before, double length_behind) {
    if (before * behind <= 0.0) return 0.0;
    const double a = 2.0 * length_behind + length_before, b = length_behind + 2.0 * length_before;
    return (a + b) / (a / before + b / behind);
}

// A branch's points.
class Run {
public:
    explicit Run(std::vector<Point> points) : points_(std::move(points)), lengths_(points_.size() - 1) {
        for (std::size_t i = 0; i < lengths_.size(); ++i)
            lengths_[i] = glm::distance(points_[i].position, points_[i + 1].position);
        for (std::size_t i = 0; i < points_.size(); ++i) corners_.push_back(rounded(i));
    }

    [[nodiscard]] const Corner& corner(std::size_t i) const { return corners_[i]; }

    // The point of the curve that replaces a point.
    [[nodiscard]] Point point(std::size_t i) const {
        const Corner& here = corner(i);
        return here.reach > 0.0 ? Point{on_corner(i, here.reach, 0.5), points_[i].radius} : points_[i];
    }

    [[nodiscard]] CurvePieces pieces(std::size_t i) const {
        const Corner &first = corner(i), &last = corner(i + 1);
        const bool meet = first.reach + last.reach >= (1.0 - kMeet) * lengths_[i];
        return {static_cast<std::uint8_t>(first.pieces), static_cast<std::uint8_t>(last.pieces),
                static_cast<std::uint8_t>(meet && first.reach > 0.0 && last.reach > 0.0 ? 0 : 1)};
    }

    // The ends of the pieces of a segment's curve, without the last one.
    [[nodiscard]] std::vector<Point> between(std::size_t i, const CurvePieces& pieces) const {
        std::vector<Point> ends;
        const Corner &first = corner(i), &last = corner(i + 1);
        const double length = lengths_[i];
        // An unrounded corner may have pieces: pruning may have changed its neighbours since the pieces were counted.
        const double from = first.reach > 0.0 ? first.reach : std::min(points_[i].radius, 0.25 * length);
        const double to = last.reach > 0.0 ? last.reach : std::min(points_[i + 1].radius, 0.25 * length);
        for (int n = 1; n <= pieces.first; ++n) {
            const double share = static_cast<double>(n) / pieces.first;
            const glm::dvec3 at = first.reach > 0.0 ? on_corner(i, from, 0.5 + 0.5 * share)
                                                    : points_[i].position + share * from * direction(i);
            ends.push_back({at, radius(i, share * from)});
        }
        for (int n = pieces.middle == 0 ? 1 : 0; n < pieces.last; ++n) {
            const double share = static_cast<double>(n) / pieces.last;
            const glm::dvec3 at = last.reach > 0.0 ? on_corner(i + 1, to, 0.5 * share)
                                                   : points_[i + 1].position - (1.0 - share) * to * direction(i);
            ends.push_back({at, radius(i, length - (1.0 - share) * to)});
        }
        return ends;
    }

    // The share, 0 to 1, of a segment at which the foot of a place lies.
    [[nodiscard]] double share_along(std::size_t i, const glm::dvec3& place) const {
        return std::clamp(glm::dot(place - points_[i].position, direction(i)) / lengths_[i], 0.0, 1.0);
    }

private:
    [[nodiscard]] Corner rounded(std::size_t i) const {
        if (!is_smooth(i)) return {};
        const double radius = points_[i].radius;
        const double reach = std::min({0.5 * lengths_[i - 1], 0.5 * lengths_[i], kRounded * radius});
        const double cosine = glm::dot(direction(i - 1), direction(i));
        const double turn = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
        if (reach < kShort * radius || turn < kSlight) return {};
        return {reach, std::min(static_cast<int>(std::ceil(turn / kPerPiece)), kMostPieces)};
    }
    [[nodiscard]] glm::dvec3 direction(std::size_t segment) const {
        return (points_[segment + 1].position - points_[segment].position) / lengths_[segment];
    }
    [[nodiscard]] glm::dvec3 on_corner(std::size_t i, double reach, double share) const {
        const glm::dvec3 at = points_[i].position;
        const glm::dvec3 begin = at - reach * direction(i - 1), end = at + reach * direction(i);
        return glm::mix(glm::mix(begin, at, share), glm::mix(at, end, share), share);
    }
    // Requires an inner point, with segments on both sides.
    [[nodiscard]] bool is_smooth(std::size_t i) const {
        return i > 0 && i + 1 < points_.size() && lengths_[i - 1] > 0.0 && lengths_[i] > 0.0;
    }
    [[nodiscard]] double step(std::size_t segment) const { // of the radius, per mm
        return (points_[segment + 1].radius - points_[segment].radius) / lengths_[segment];
    }
    [[nodiscard]] double slope(std::size_t i, std::size_t segment) const {
        return is_smooth(i) ? monotone_slope(step(i - 1), step(i), lengths_[i - 1], lengths_[i]) : step(segment);
    }
    // So far along a segment, mm.
    [[nodiscard]] double radius(std::size_t segment, double along) const {
        const double length = lengths_[segment], s = along / length, s2 = s * s, s3 = s2 * s;
        return (2.0 * s3 - 3.0 * s2 + 1.0) * points_[segment].radius +
               (s3 - 2.0 * s2 + s) * length * slope(segment, segment) +
               (3.0 * s2 - 2.0 * s3) * points_[segment + 1].radius + (s3 - s2) * length * slope(segment + 1, segment);
    }

    std::vector<Point> points_;
    std::vector<double> lengths_;
    std::vector<Corner> corners_; // by point
};

Run run_of(const VesselTree& tree, const Branch& branch) {
    std::vector<Point> points;
    points.reserve(branch.points.size());
    for (const std::uint32_t p : branch.points) points.push_back(tree.points[p]);
    return Run(std::move(points));
}

} // namespace

std::vector<CurvePieces> pieces_of_curves(const VesselTree& tree) {
    std::vector<CurvePieces> pieces;
    pieces.reserve(tree.segment_count());
    for (const Branch& branch : tree.branches) {
        const Run run = run_of(tree, branch);
        for (std::size_t i = 0; i + 1 < branch.points.size(); ++i) pieces.push_back(run.pieces(i));
    }
    return pieces;
}

PreparedTree along_curves(PreparedTree lines, std::span<const CurvePieces> pieces) {
    std::vector<std::uint32_t> first(pieces.size() + 1, 0); // of each segment's pieces
    for (std::size_t i = 0; i < pieces.size(); ++i) first[i + 1] = first[i] + pieces[i].count();
    VesselTree& tree = lines.tree;
    const bool pruned = !lines.segment_index.empty();
    std::vector<int> source;
    std::vector<std::uint32_t> index;
    std::size_t segment = 0;
    for (Branch& branch : tree.branches) {
        const Run run = run_of(tree, branch);
        std::vector<std::uint32_t> points{branch.points.front()};
        for (std::size_t i = 0; i + 1 < branch.points.size(); ++i, ++segment) {
            const std::size_t of = pruned ? lines.segment_index[segment] : segment;
            source.insert(source.end(), pieces[of].count(), lines.segment_source[segment]);
            for (std::uint32_t piece = first[of]; pruned && piece < first[of + 1]; ++piece) index.push_back(piece);
            if (pieces[of].count() > 1)
                for (const Point& end : run.between(i, pieces[of])) {
                    points.push_back(static_cast<std::uint32_t>(tree.points.size()));
                    tree.points.push_back(end);
                    append_between(tree.point_data, branch.points[i], branch.points[i + 1],
                                   run.share_along(i, end.position));
                    if (!tree.labels.empty()) tree.labels.push_back(tree.labels[branch.points[i]]);
                }
            points.push_back(branch.points[i + 1]);
        }
        for (std::size_t i = 1; i + 1 < branch.points.size(); ++i) tree.points[branch.points[i]] = run.point(i);
        branch.points = std::move(points);
    }
    lines.segment_source = std::move(source);
    lines.segment_index = std::move(index);
    if (pruned) lines.source_segments = first.back();
    lines.centerline = Centerline::kSmooth;
    return lines;
}

} // namespace ramus::tree
