#include "core/mesh/loops/axes.h"

#include "core/mesh/line_box.h"
#include "core/mesh/line_triangle.h"
#include "core/mesh/loops/spanning_triangles.h"

#include <algorithm>
#include <cmath>
#include <glm/vector_relational.hpp>
#include <limits>
#include <utility>

namespace ramus::mesh {

namespace {

using ExactBox = Bounds<glm::dvec3>;

bool meet(const ExactBox& a, const ExactBox& b) {
    return glm::all(glm::lessThanEqual(a.least, b.most)) && glm::all(glm::lessThanEqual(b.least, a.most));
}

// A box in single precision, rounded outward.
BoxTree::Box box_around(const ExactBox& exact) {
    constexpr float kFar = std::numeric_limits<float>::max();
    BoxTree::Box box{glm::vec3(exact.least), glm::vec3(exact.most)};
    for (int axis = 0; axis < 3; ++axis) {
        box.least[axis] = std::nextafter(box.least[axis], -kFar);
        box.most[axis] = std::nextafter(box.most[axis], kFar);
    }
    return box;
}

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

BoxTree boxes_of_segments(const tree::VesselTree& tree, std::span<const std::array<std::uint32_t, 2>> segments) {
    constexpr std::size_t kEight = EightBoxes::kCount;
    BoxTree::Level level((segments.size() + kEight - 1) / kEight, EightBoxes());
    for (std::size_t n = 0; n < segments.size(); ++n)
        level[n / kEight].set(n % kEight, box_around(box_of_segment(tree, segments[n])));
    return BoxTree(std::move(level));
}

} // namespace

Axes::Axes(const tree::VesselTree& tree)
    : tree_(tree), segments_(segments_of(tree)), boxes_(boxes_of_segments(tree, segments_)) {}

bool Axes::reach(const Bounds<glm::dvec3>& box) const {
    bool any = false;
    boxes_.for_each_meeting(box_around(box), [&](std::size_t n) {
        const auto& [from, to] = segments_[n];
        any = any || line_meets_box(tree_.points[from].position, tree_.points[to].position, box);
    });
    return any;
}

bool Axes::go_through(std::span<const glm::dvec3> line) const {
    ExactBox around;
    for (const glm::dvec3& p : line) around.hold(p);
    std::vector<std::size_t> near;
    boxes_.for_each_meeting(box_around(around), [&](std::size_t n) {
        if (meet(box_of_segment(tree_, segments_[n]), around)) near.push_back(n);
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
