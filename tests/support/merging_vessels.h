// Vessels that run side by side at the distance at which the plain sum of their kernels begins to merge them, with a
// joint or a bend nearby: where a surface is hardest to keep closed, and in the pieces and loops of its tree.
#pragma once

#include "core/tree/build_tree.h"

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::test {

inline constexpr double kMergingDistance = 3.0; // of the axes, mm

// Two long parallel vessels of this radius merge at kMergingDistance D: 2 exp(-w (D/2)^2 / r^2) = exp(-w), where w is
// the width times ln 2.
[[nodiscard]] inline double merging_radius(double width) {
    return 0.5 * kMergingDistance / std::sqrt(1.0 + 1.0 / width);
}

struct MergingShape {
    std::string_view name;
    std::vector<glm::dvec3> points;
    std::vector<tree::Edge> edges;

    [[nodiscard]] tree::VesselTree tree(double radius) const {
        std::vector<tree::Point> with_radius;
        for (const glm::dvec3& point : points) with_radius.push_back({point, radius});
        return tree::build_tree({std::move(with_radius), {}, edges, {0}, {}, {}}, tree::Repair::kNone,
                                [](std::uint32_t) { return std::string(); })
            .value();
    }
};

// All without a loop, and of one piece.
[[nodiscard]] inline std::vector<MergingShape> merging_shapes() {
    constexpr double kApart = kMergingDistance;
    return {
        {"S", // three runs of one branch
         {{0, 0, 2 * kApart}, {12, 0, 2 * kApart}, {12, 0, kApart}, {0, 0, kApart}, {0, 0, 0}, {12, 0, 0}},
         {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}}},
        {"U", // aslant to the lattice
         {{0, 0, 0},
          {9, 7, 2},
          {9 + 7 * kApart / std::hypot(7, 9), 7 - 9 * kApart / std::hypot(7, 9), 2},
          {7 * kApart / std::hypot(7, 9), -9 * kApart / std::hypot(7, 9), 0}},
         {{0, 1}, {1, 2}, {2, 3}}},
        {"fork", // whose daughters become parallel
         {{-6, 0, 0},
          {0, 0, 0},
          {3, 0.5 * kApart, 0},
          {14, 0.5 * kApart, 0},
          {3, -0.5 * kApart, 0},
          {14, -0.5 * kApart, 0}},
         {{0, 1}, {1, 2}, {2, 3}, {1, 4}, {4, 5}}},
    };
}

} // namespace ramus::test
