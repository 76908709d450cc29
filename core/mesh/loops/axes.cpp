#include "core/mesh/loops/axes.h"

#include "core/mesh/line_box.h"
#include "core/mesh/line_triangle.h"
#include "core/mesh/loops/spanning_triangles.h"

#include <algorithm>

namespace ramus::mesh {

namespace {

using ExactBox = Bounds<glm::dvec3>;

std::vector<std::array<std::uint32_t, 2>> segments_of(const tree::VesselTree& tree) {
    std::vector<std::array<std::uint32_t, 2>> segments;
    for (const tree::Branch& branch : tree.branches)
        for (std::size_t n = 1; n < branch.points.size(); ++n)
            segments.push_back({branch.points[n - 1], branch.points[n]});
    return segments;
}

ExactBox box_of_segment(const tree::VesselTree& tree, const std::array<std::uint32_t, 2>& segment) {
    ExactBox box;
    for (const std::uint32_t point : segment) box.hold(tree.points[point].position);
    return box;
}

} // namespace

Axes::Axes(const tree::VesselTree& tree)
    : tree_(tree), segments_(segments_of(tree)), boxes_(BoxTree::level_of(segments_.size(), [this](std::size_t n) {
          return rounded_outward(box_of_segment(tree_, segments_[n]));
      })) {}

bool Axes::reach(const Bounds<glm::dvec3>& box) const {
    bool any = false;
    boxes_.for_each_meeting(rounded_outward(box), [&](std::size_t n) {
        const auto& [from, to] = segments_[n];
        any = any || line_meets_box(tree_.points[from].position, tree_.points[to].position, box);
    });
    return any;
}

bool Axes::go_through(std::span<const glm::dvec3> line) const {
    const ExactBox around = box_of_points(line);
    std::vector<std::size_t> near;
    boxes_.for_each_meeting(rounded_outward(around), [&](std::size_t n) {
        if (box_of_segment(tree_, segments_[n]).meets(around)) near.push_back(n);
    });
    if (near.empty()) return false; // the triangles take time as the cube of the line's corners
    const std::vector<glm::uvec3> cap = spanning_triangles(line);
    return std::ranges::any_of(near, [&](std::size_t n) {
        const glm::dvec3 p = tree_.points[segments_[n][0]].position, q = tree_.points[segments_[n][1]].position;
        return std::ranges::any_of(cap, [&](const glm::uvec3& t) {
            return line_meets(p, q, {line[t.x], line[t.y], line[t.z]});
        });
    });
}

} // namespace ramus::mesh
