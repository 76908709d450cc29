#include "core/tree/suspicions.h"

#include "core/base/disjoint_sets.h"
#include "core/base/words.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

namespace ramus::tree {

namespace {

std::string figure(double value) { return in_digits(value, 4); }

void suspect(std::vector<Note>& notes, std::string topic, std::string text, const glm::dvec3& at) {
    notes.push_back({Note::Kind::kSuspect, std::move(topic), std::move(text), at});
}

// The radii of the neighbours of a point.
struct Around {
    double least = HUGE_VAL, most = 0.0, sum = 0.0;
    int count = 0;
    void add(double radius) { least = std::min(least, radius), most = std::max(most, radius), sum += radius, ++count; }
    [[nodiscard]] bool apart_from(double radius) const {
        return radius > kRadiusJump * most || radius * (count > 1 ? kRadiusJump : kRadiusTaper) < least;
    }
};

// Notes the thickest point of each piece with a radius larger than the length of the piece, and all points with a
// radius below kThinnestOfThickest of the thickest.
void check_sizes(const std::vector<Point>& points, const std::vector<Edge>& edges, std::vector<Note>& notes) {
    DisjointSets pieces(points.size());
    for (const auto& [a, b] : edges) pieces.join(a, b);
    std::vector<double> length(points.size(), 0.0);
    for (const auto& [a, b] : edges) length[pieces.find(a)] += glm::distance(points[a].position, points[b].position);
    std::map<std::uint32_t, std::uint32_t> thickest; // by piece
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        const auto piece = static_cast<std::uint32_t>(pieces.find(p));
        if (points[p].radius <= length[piece]) continue;
        const auto [found, is_new] = thickest.emplace(piece, p);
        if (!is_new && points[found->second].radius < points[p].radius) found->second = p;
    }
    for (const auto& [piece, p] : thickest)
        suspect(notes, "radii",
                "radius " + figure(points[p].radius) + " mm is larger than the whole vessel is long, " +
                    figure(length[piece]) + " mm",
                points[p].position);
    const double most = points.empty() ? 0.0 : std::ranges::max_element(points, {}, &Point::radius)->radius;
    for (const Point& point : points)
        if (point.radius < kThinnestOfThickest * most)
            suspect(notes, "radii",
                    "radius " + figure(point.radius) + " mm is next to nothing compared with the thickest, " +
                        figure(most) + " mm",
                    point.position);
}

} // namespace

std::optional<Note> check_invented(std::size_t invented, std::size_t points) {
    if (static_cast<double>(invented) <= kMostInvented * static_cast<double>(points)) return std::nullopt;
    return Note{Note::Kind::kSuspect,
                std::string(kInventedRadii),
                std::to_string(invented) + " of " + std::to_string(points) +
                    " radii are invented: nobody measured how wide the vessels are there",
                {}};
}

std::vector<Note> check_radii(std::vector<Point>& points, const std::vector<Edge>& edges, bool repair) {
    const std::string topic(name_of(Repair::kRadiusJumps));
    std::vector<Note> notes;
    check_sizes(points, edges, notes);
    std::vector<Around> around(points.size());
    for (const auto& [a, b] : edges) around[a].add(points[b].radius), around[b].add(points[a].radius);
    std::vector<bool> told(points.size(), false);
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        double& radius = points[p].radius;
        const Around& beside = around[p];
        if (beside.count == 0 || !beside.apart_from(radius)) continue;
        told[p] = true;
        const std::string found =
            "radius " + figure(radius) + " mm is " +
            (beside.count == 1 ? "next to " + figure(beside.most)
                               : "between " + figure(beside.least) + " and " + figure(beside.most)) +
            " mm";
        if (beside.count != 2) {
            suspect(notes, topic, found, points[p].position);
        } else if (repair) {
            const double mean = beside.sum / 2.0;
            notes.push_back(
                {Note::Kind::kRepaired, topic, found + "; replaced by " + figure(mean), points[p].position});
            radius = mean;
        } else {
            suspect(notes, topic, found + "; --repair all takes the mean of its neighbours", points[p].position);
        }
    }
    for (const auto& [a, b] : edges) {
        const auto [least, most] = std::minmax(points[a].radius, points[b].radius);
        if (told[a] || told[b] || around[a].count != 2 || around[b].count != 2 || most <= kRadiusStep * least) continue;
        suspect(notes, topic,
                "the radius goes from " + figure(points[a].radius) + " to " + figure(points[b].radius) +
                    " mm between two points",
                0.5 * (points[a].position + points[b].position));
    }
    return notes;
}

std::vector<Note> check_network(const VesselTree& tree) {
    std::vector<Note> notes;
    std::vector<bool> reached(tree.points.size(), false);
    for (const std::uint32_t root : tree.roots) reached[root] = true;
    // Ids ascend in the order in which branches were followed from the roots.
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const std::vector<std::uint32_t>& line = tree.branches[id].points;
        if (!reached[line.back()])
            reached[line.back()] = true;
        else
            suspect(notes, "loops", "branch " + std::to_string(id) + " closes a loop: nothing depends on it",
                    0.5 * (tree.points[line[(line.size() - 1) / 2]].position +
                           tree.points[line[line.size() / 2]].position));
    }
    if (tree.roots.size() < 2) return notes;
    struct Piece {
        std::size_t branches = 0;
        double length_mm = 0.0;
        int system = 0;
    };
    std::map<std::uint32_t, Piece> pieces; // by root
    std::vector<std::uint32_t> root_of(tree.branches.size());
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const Branch& branch = tree.branches[id];
        root_of[id] =
            branch.parent == kNoBranch ? branch.points.front() : root_of[static_cast<std::size_t>(branch.parent)];
        Piece& piece = pieces[root_of[id]];
        ++piece.branches, piece.length_mm += length_mm(tree, branch), piece.system = branch.system;
    }
    std::map<int, std::uint32_t> longest; // by system
    for (const auto& [root, piece] : pieces) {
        const auto [found, is_new] = longest.emplace(piece.system, root);
        if (!is_new && pieces[found->second].length_mm < piece.length_mm) found->second = root;
    }
    for (const auto& [root, piece] : pieces)
        if (longest[piece.system] != root)
            suspect(notes, "pieces",
                    "a piece of " + std::to_string(piece.branches) + (piece.branches == 1 ? " branch" : " branches") +
                        ", " + figure(piece.length_mm) + " mm long, is connected with nothing else",
                    tree.points[root].position);
    return notes;
}

} // namespace ramus::tree
