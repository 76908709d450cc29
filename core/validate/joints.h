// Properties of a kernel at joints and ends, computed on ideal vessels of equal radius. Lengths are in radii.
#pragma once

#include "core/field/kernel.h"

namespace ramus::validate {

struct JointFigures {
    // The closeness at which two parallel vessels merge: the distance of their axes over the sum of their radii.
    double merging = 0.0;
    // A planar fork with an angle of 60 degrees between the daughters. `parting`: the distance of the crotch from the
    // axis of each daughter (1: where their tubes separate). `blend_reach`: the distance from the joint, along a
    // daughter, up to which the surface is more than 1 % thicker than the tube. `bulge_percent`: the largest excess, in
    // % of the radius.
    double parting = 0.0, blend_reach = 0.0, bulge_percent = 0.0;
    // Between two segments of a straight vessel: the largest error of the surface's radius, in %.
    double straight_percent = 0.0;
    double beyond_end = 0.0; // how far the surface extends beyond a free end; negative: it ends before
};

[[nodiscard]] JointFigures joint_figures(const field::Kernel& kernel);

} // namespace ramus::validate
