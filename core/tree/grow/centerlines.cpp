#include "core/tree/grow/centerlines.h"

#include <algorithm>
#include <cmath>

namespace ramus::tree::growth {

namespace {

constexpr double kWinding = 0.05;      // sideways way of a bend, as a fraction of the branch's length
constexpr double kSharpestTurn = 0.92; // least cosine between consecutive steps of a centerline
constexpr int kRounds = 6;             // of bending less where vessels touch; the last leaves them straight

struct Shape {
    Vec start_way{0.0};
    Vec end_way{0.0};
    Vec bow{0.0};  // sideways, in units of the length: one bend
    Vec sway{0.0}; // two bends, one to each side
};

// The direction of flow through a node: the mean of the incoming and the outgoing direction.
Vec way_through(const Skeleton& tree, int node) {
    const Node& n = tree.at(node);
    Vec onward(0.0);
    for (int c = 0; c < n.child_count; ++c) {
        const int child = n.children[static_cast<std::size_t>(c)];
        onward += tree.way(child) * (tree.at(child).flow / n.flow);
    }
    const Vec sum = (node > 0 ? tree.way(node) : onward) + onward;
    return direction(Vec(0.0), sum);
}

std::vector<Shape> shapes(const Skeleton& tree, double tortuosity, std::uint64_t seed) {
    std::vector<Shape> result(tree.nodes.size());
    for (int id = 1; id < tree.size(); ++id) {
        Random random(seed ^ (0xA0761D6478BD642FULL * static_cast<std::uint64_t>(id)));
        Shape& shape = result[static_cast<std::size_t>(id)];
        const Node& node = tree.at(id);
        const Vec chord = tree.way(id);
        // A child with a larger share of the parent's flow continues straighter.
        const double share = node.flow / tree.at(node.parent).flow;
        shape.start_way = direction(Vec(0.0), share * way_through(tree, node.parent) + (1.0 - share) * chord);
        if (node.child_count > 0) {
            shape.end_way = way_through(tree, id);
        } else {
            const Vec arc = 2.0 * glm::dot(chord, shape.start_way) * chord - shape.start_way;
            shape.end_way = direction(Vec(0.0), chord + 0.5 * arc);
        }
        const auto sideways = [&] {
            const Vec any = random.in_ball();
            return kWinding * tortuosity * (any - glm::dot(any, chord) * chord);
        };
        shape.bow = sideways();
        shape.sway = sideways();
    }
    return result;
}

// Cubic from node to node plus the bends, which leave ends and tangents as they are; bending 0 is the straight segment.
// Coordinates are rounded to 1 / decimal mm: files need not carry digits that mean nothing.
std::vector<Vec> sample(const Skeleton& tree, int id, const Shape& shape, double bending, double spacing_mm,
                        double decimal) {
    const Vec& a = tree.at(tree.at(id).parent).position;
    const Vec& b = tree.at(id).position;
    const double length = glm::length(b - a);
    const Vec third = (b - a) / 3.0;
    const Vec near_a = a + third + bending * (shape.start_way * (length / 3.0) - third);
    const Vec near_b = b - third - bending * (shape.end_way * (length / 3.0) - third);
    const auto at = [&](double t) {
        const double u = 1.0 - t;
        const double bump = 16.0 * t * t * u * u;
        return u * u * u * a + 3.0 * u * u * t * near_a + 3.0 * u * t * t * near_b + t * t * t * b +
               bending * length * bump * (shape.bow + (1.0 - 2.0 * t) * 2.0 * shape.sway);
    };

    // Even steps of arc length, read off a finer table.
    const int fine = std::clamp(static_cast<int>(8.0 * length / spacing_mm), 16, 2000);
    std::vector<double> run(static_cast<std::size_t>(fine) + 1, 0.0);
    Vec before = a;
    for (int i = 1; i <= fine; ++i) {
        const Vec now = at(static_cast<double>(i) / fine);
        run[static_cast<std::size_t>(i)] = run[static_cast<std::size_t>(i) - 1] + glm::length(now - before);
        before = now;
    }
    const int steps = std::max(2, static_cast<int>(std::floor(run.back() / spacing_mm + 0.5)));
    std::vector<Vec> line{a};
    std::size_t i = 1;
    for (int k = 1; k < steps; ++k) {
        const double want = run.back() * k / steps;
        while (run[i] < want) ++i;
        const double part = (want - run[i - 1]) / (run[i] - run[i - 1]);
        line.push_back(at((static_cast<double>(i - 1) + part) / fine));
    }
    line.push_back(b);
    for (Vec& point : line) point = glm::floor(point * decimal + 0.5) / decimal;
    return line;
}

bool kinked(const std::vector<Vec>& line) {
    for (std::size_t i = 2; i < line.size(); ++i)
        if (glm::dot(direction(line[i - 2], line[i - 1]), direction(line[i - 1], line[i])) < kSharpestTurn) return true;
    return false;
}

} // namespace

BentTree bend(const Skeleton& tree, const Organ& organ, double spacing_mm, double tortuosity, double joint_reach,
              std::uint64_t seed) {
    const std::vector<Shape> shape = shapes(tree, tortuosity, seed);
    std::vector<double> bending(tree.nodes.size(), 1.0);
    std::vector<bool> stale(tree.nodes.size(), true);
    BentTree result;
    result.lines.resize(tree.nodes.size());
    std::vector<bool> unfit(tree.nodes.size(), false);
    double decimal = 1.0;
    while (2e6 > decimal * (organ.high().x - organ.low().x)) decimal *= 10.0;
    const auto draw = [&](int id) {
        const auto at = static_cast<std::size_t>(id);
        auto& line = result.lines[at];
        line = sample(tree, id, shape[at], bending[at], spacing_mm, decimal);
        unfit[at] = kinked(line);
        if (tree.at(id).parent == 0) return; // the stem comes from outside
        for (const Vec& point : line)
            if (organ.depth_mm(point) < tree.radius_mm(id)) unfit[at] = true;
    };
    for (int id = 1; id < tree.size(); ++id) draw(id);
    Touching touching(tree, result.lines, organ, joint_reach);

    std::vector<bool> changed(tree.nodes.size(), false);
    const std::vector<bool> all(tree.nodes.size(), true);
    std::vector<std::pair<int, int>> pairs = touching.find(result.lines, changed, all);
    for (int round = 1; round <= kRounds; ++round) {
        std::fill(changed.begin(), changed.end(), false);
        const auto calm = [&](int id) {
            const auto at = static_cast<std::size_t>(id);
            if (changed[at] || bending[at] == 0.0) return;
            bending[at] = round < kRounds ? 0.55 * bending[at] : 0.0;
            changed[at] = true;
        };
        for (const auto& [a, b] : pairs) {
            calm(a);
            calm(b);
        }
        for (int id = 1; id < tree.size(); ++id)
            if (unfit[static_cast<std::size_t>(id)]) calm(id);
        if (std::find(changed.begin(), changed.end(), true) == changed.end()) break;
        for (int id = 1; id < tree.size(); ++id)
            if (changed[static_cast<std::size_t>(id)]) draw(id);
        pairs = touching.find(result.lines, changed, changed);
    }
    // Segments that touch although straight were not tested again.
    std::fill(changed.begin(), changed.end(), false);
    pairs = touching.find(result.lines, changed, all);
    for (const auto& [a, b] : pairs) result.misplaced.push_back(tree.at(a).flow < tree.at(b).flow ? a : b);
    for (int id = 2; id < tree.size(); ++id)
        for (const Vec& point : result.lines[static_cast<std::size_t>(id)])
            if (organ.depth_mm(point) < 0.0) result.misplaced.push_back(id);
    return result;
}

} // namespace ramus::tree::growth
