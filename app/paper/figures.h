// The functions that make the paper's figures and tables, one row of figure_rows.cpp each, and what they share.
#pragma once

#include "app/paper/figure.h"
#include "app/paper/workbench.h"
#include "app/picture/close_ups.h"

#include <string>
#include <vector>

namespace ramus::app::paper {

// artificial_figures.cpp, bounding_figure.cpp: artificial trees.
[[nodiscard]] Result<Figure> bulging(Workbench& bench, Job& job);           // 1
[[nodiscard]] Result<Figure> unwanted_blending(Workbench& bench, Job& job); // 2
[[nodiscard]] Result<Figure> merging(Workbench& bench, Job& job);           // 3
[[nodiscard]] Result<Figure> bounding_volumes(Workbench& bench, Job& job);  // 4
// method_figures.cpp: the three methods, smoothing and pruning of a skeleton that was made of voxels.
[[nodiscard]] Result<Figure> methods(Workbench& bench, Job& job);   // 5
[[nodiscard]] Result<Figure> smoothing(Workbench& bench, Job& job); // 6
[[nodiscard]] Result<Figure> pruning(Workbench& bench, Job& job);   // 7
// distance_figures.cpp: distances between the surfaces of the three methods, and times.
[[nodiscard]] Result<Figure> deviation_from_cones(Workbench& bench, Job& job);      // 8
[[nodiscard]] Result<Figure> deviation_from_isosurface(Workbench& bench, Job& job); // 9
[[nodiscard]] Result<Figure> box_plots_of_trees(Workbench& bench, Job& job);        // 10
[[nodiscard]] Result<Figure> table_of_distances(Workbench& bench, Job& job);        // Table I
[[nodiscard]] Result<Figure> table_of_times(Workbench& bench, Job& job);            // Table III
// clinical_figures.cpp: the study's pictures and criteria, and pictures as for planning.
[[nodiscard]] Result<Figure> study_pictures(Workbench& bench, Job& job);    // 11
[[nodiscard]] Result<Figure> lesion_in_liver(Workbench& bench, Job& job);   // 12
[[nodiscard]] Result<Figure> branches_in_focus(Workbench& bench, Job& job); // 13
[[nodiscard]] Result<Figure> table_of_criteria(Workbench& bench, Job& job); // Table II

// mm above the joint at the origin at which the surface ends, along y.
[[nodiscard]] double height_over_joint(const mesh::TriangleMesh& mesh);
// The radius from which on two straight vessels, `distance_mm` apart, have one surface: found by making surfaces.
[[nodiscard]] Result<double> found_merging_radius(double distance_mm, double width, Job& job);

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
