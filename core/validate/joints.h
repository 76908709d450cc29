// What a kernel makes of joints and ends, away from any tree: lengths in radii of vessels that are all equally thick.
#pragma once

#include "core/field/kernel.h"

namespace ramus::validate {

struct JointFigures {
    // Of two parallel vessels at which they merge: the distance of their axes over the sum of their radii.
    double merging = 0.0;
    // A fork whose three vessels lie in a plane, the daughters 60 degrees apart. Where they part: how far the crotch is
    // from each of their axes (1: where their tubes part); how far from the joint, along a daughter, the surface is
    // thicker than its tube by 1 %; and the most that it is thicker by anywhere, in % of the radius.
    double parting = 0.0, blend_reach = 0.0, bulge_percent = 0.0;
    // Where two segments of a straight vessel meet: the most that the surface is off its radius, in %.
    double straight_percent = 0.0;
    double beyond_end = 0.0; // how far the surface goes on beyond a free end; below 0: it ends before
};

[[nodiscard]] JointFigures joint_figures(const field::Kernel& kernel);

} // namespace ramus::validate
