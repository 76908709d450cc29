// Reads and writes trees as lines in VTK's files (core/io/vtk): PolyData (.vtp), unstructured grids (.vtu) and the
// legacy format (.vtk), as VMTK, SimVascular, ParaView and Slicer write centerlines. Widths are an array of points or
// of cells; vtk_tree.cpp decides which.
#pragma once

#include "core/io/trees/tree_file.h"
#include "core/io/vtk/vtk_dataset.h"

namespace ramus::io {

[[nodiscard]] Result<ImportedTree> parse_vtk_xml(const TreeInput& input);
[[nodiscard]] Result<ImportedTree> parse_vtk_legacy(const TreeInput& input);

// Writes PolyData with a polyline for each branch, from the root outward; polylines share the points at nodes. Arrays
// have VMTK's names. Of points: MaximumInscribedSphereRadius. Of cells: GroupIds (branch id), CenterlineIds (the first
// path from a root to a leaf through the branch), TractIds (position of the branch on that path), Blanking (always 0:
// no branch is the inside of a bifurcation). In addition: labels of points, systems with their names, roots, the tree's
// own data, and the axes, RAS or LPS, in the form that Slicer reads. Data of the tree with one of VMTK's names replaces
// the computed array. Numbers are base64, in full precision.
[[nodiscard]] Result<void> write_vtp(const tree::VesselTree& tree, const std::filesystem::path& file,
                                     const std::vector<std::string>& comments, const Orientation& axes);

} // namespace ramus::io
