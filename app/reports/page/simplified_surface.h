// Simplifies a surface that is divided by branch, a branch at a time: fewer triangles where it is nearly flat, as along
// straight vessels. Borders between branches stay as they are, so that no gap opens. By meshoptimizer: M. Garland and
// P. Heckbert, "Surface simplification using quadric error metrics" (SIGGRAPH 1997).
#pragma once

#include "app/reports/page/branch_surface.h"

namespace ramus::app {

struct Simplification {
    double share_of_radius = 0.0; // the error that the simplifier may make, of the thinnest radius of the branch
    double most_mm = 0.0;         // and in mm; for parts without a radius
    bool moves_borders = false;   // along themselves; then small gaps open between branches
    double triangles = 0.0;       // the share of the triangles that is wanted, while the error allows it
};

// The same vertices; the triangles of each branch in an order in which they share edges.
[[nodiscard]] BranchSurface simplified(const BranchSurface& surface, const Simplification& wanted);
// Simplifies all branches together, borders too, to about this share of the triangles: where it costs least, whatever
// the radius. Branches stay connected: vertices of both sides of a border move together.
[[nodiscard]] BranchSurface simplified_together(const BranchSurface& surface, double triangles);
// Without simplifying: only the order.
[[nodiscard]] BranchSurface ordered(const BranchSurface& surface);

} // namespace ramus::app
