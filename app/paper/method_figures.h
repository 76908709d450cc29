// Figures 5 to 7 of the paper: the three methods on one tree; smoothing and pruning of a skeleton that was made of
// voxels.
#pragma once

#include "app/paper/figure.h"
#include "app/paper/workbench.h"
#include "app/picture/close_ups.h"

namespace ramus::app::paper {

[[nodiscard]] Result<Figure> methods(Workbench& bench, Job& job);   // 5
[[nodiscard]] Result<Figure> smoothing(Workbench& bench, Job& job); // 6
[[nodiscard]] Result<Figure> pruning(Workbench& bench, Job& job);   // 7

// The place of close-ups: the second-widest branching, since the widest one is often at the border of what is there.
[[nodiscard]] CloseUp branching_of(const tree::VesselTree& tree);

// The three surfaces of a tree in the order in which the paper's study shows them, with what they are called.
struct NamedSurface {
    std::string title;
    Paged paged;
};
[[nodiscard]] std::vector<NamedSurface> surfaces_of(const ComparedTree& tree);
// "the isosurface is that of liver.nii.gz", or of voxels that were made.
[[nodiscard]] std::string isosurface_text(const ComparedTree& tree);

} // namespace ramus::app::paper
