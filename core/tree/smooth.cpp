#include "core/tree/smooth.h"

namespace ramus::tree {

VesselTree smooth(VesselTree tree, int passes) {
    const std::size_t count = tree.points.size();
    std::vector<int> degree(count, 0);
    for (const Branch& branch : tree.branches) {
        for (std::size_t i = 1; i < branch.points.size(); ++i)
            ++degree[branch.points[i - 1]], ++degree[branch.points[i]];
    }
    // Sums over the neighbours of each point, plain and weighted with their radii.
    struct Sums {
        glm::dvec3 position{0.0}, weighted_position{0.0};
        double radius = 0.0, squared_radius = 0.0;
    };
    for (int pass = 0; pass < passes; ++pass) {
        std::vector<Sums> sums(count);
        const auto add = [&](std::uint32_t to, const Point& from) {
            sums[to].position += from.position;
            sums[to].weighted_position += from.radius * from.position;
            sums[to].radius += from.radius;
            sums[to].squared_radius += from.radius * from.radius;
        };
        for (const Branch& branch : tree.branches) {
            for (std::size_t i = 1; i < branch.points.size(); ++i) {
                add(branch.points[i], tree.points[branch.points[i - 1]]);
                add(branch.points[i - 1], tree.points[branch.points[i]]);
            }
        }
        for (std::size_t p = 0; p < count; ++p) {
            Point& point = tree.points[p];
            if (degree[p] == 2) {
                point.position = 0.25 * sums[p].position + 0.5 * point.position;
                point.radius = 0.25 * sums[p].radius + 0.5 * point.radius;
            } else if (degree[p] > 2) {
                point.position = 0.5 * point.position + 0.5 * sums[p].weighted_position / sums[p].radius;
                point.radius = 0.5 * point.radius + 0.5 * sums[p].squared_radius / sums[p].radius;
            }
        }
    }
    return tree;
}

} // namespace ramus::tree
