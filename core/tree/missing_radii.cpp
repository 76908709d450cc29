#include "core/tree/missing_radii.h"

#include "core/base/grouped.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace ramus::tree {

namespace {

constexpr std::uint32_t kNoPoint = 0xFFFFFFFFU;
constexpr double kShortestEdge = 1e-9; // mm: conductances stay far from the largest number

// One point without a radius, after the elimination of the points beyond it in the search. Its radius is
// (flow + conductance_up * radius of `up`) / (conductance + conductance_up).
struct Unknown {
    std::uint32_t up = kNoPoint;
    double conductance_up = 0.0, conductance = 0.0, flow = 0.0;
};

} // namespace

FilledRadii fill_missing_radii(std::vector<Point>& points, const std::vector<Edge>& edges) {
    const auto is_missing = [&](std::uint32_t p) { return !(points[p].radius > 0.0); };
    const Grouped<std::uint32_t> around(points.size(), [&](const auto& put) {
        for (const auto& [a, b] : edges) {
            if (is_missing(a)) put(a, b);
            if (is_missing(b)) put(b, a);
        }
    });
    const auto conductance = [&](std::uint32_t a, std::uint32_t b) {
        return 1.0 / std::max(glm::distance(points[a].position, points[b].position), kShortestEdge);
    };
    FilledRadii filled;
    std::vector<Unknown> unknowns(points.size());
    std::vector<bool> reached(points.size(), false);
    std::vector<double> radii(points.size(), 0.0);
    std::vector<std::uint32_t> order; // of a component: every point behind the one that it was reached from
    for (std::uint32_t start = 0; start < points.size(); ++start) {
        if (reached[start] || around.of(start).empty()) continue;
        reached[start] = true;
        order.assign(1, start);
        for (std::size_t n = 0; n < order.size(); ++n) {
            const std::uint32_t p = order[n];
            for (const std::uint32_t other : around.of(p)) {
                if (!is_missing(other)) {
                    unknowns[p].conductance += conductance(p, other);
                    unknowns[p].flow += conductance(p, other) * points[other].radius;
                } else if (!reached[other]) {
                    reached[other] = true;
                    unknowns[other].up = p, unknowns[other].conductance_up = conductance(p, other);
                    order.push_back(other);
                }
            }
        }
        for (std::size_t n = order.size(); n-- > 1;) { // eliminate from the far ends
            const Unknown& far = unknowns[order[n]];
            const double share = far.conductance_up / (far.conductance + far.conductance_up);
            unknowns[far.up].conductance += share * far.conductance;
            unknowns[far.up].flow += share * far.flow;
        }
        if (unknowns[start].conductance <= 0.0) {
            filled.out_of_reach = start;
            return filled;
        }
        for (const std::uint32_t p : order) {
            const Unknown& one = unknowns[p];
            const double up = one.up == kNoPoint ? 0.0 : radii[one.up];
            radii[p] = (one.flow + one.conductance_up * up) / (one.conductance + one.conductance_up);
        }
        filled.points.insert(filled.points.end(), order.begin(), order.end());
    }
    std::ranges::sort(filled.points);
    for (const std::uint32_t p : filled.points) points[p].radius = radii[p];
    return filled;
}

} // namespace ramus::tree
