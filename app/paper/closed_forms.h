// What equations 7 to 10 of the paper say of simple cases in closed form (docs/PAPER.md derives them). `width`: the
// width coefficient.
#pragma once

#include <cmath>

namespace ramus::app::paper {

// Over the joint of so many equal branches in a plane, in radii.
[[nodiscard]] inline double joint_height(int branches, double width) {
    return std::sqrt(1.0 + std::log2(0.5 * branches) / width);
}
// The radius at which two long parallel vessels merge whose axes are `distance` apart.
[[nodiscard]] inline double merging_radius(double distance, double width) {
    return 0.5 * distance / std::sqrt(1.0 + 1.0 / width);
}
// The gap between them at this moment, as a share of the distance.
[[nodiscard]] inline double merging_gap(double width) { return 1.0 - 1.0 / std::sqrt(1.0 + 1.0 / width); }

} // namespace ramus::app::paper
