// VTK's files of lines (core/io/vtk): PolyData (.vtp), unstructured grids (.vtu) and the legacy format (.vtk), as VMTK,
// SimVascular, ParaView and Slicer write centerlines. Read in all their encodings: text, base64, raw, compressed by
// zlib, either byte order, several pieces. Widths are an array of points or of cells; which one is decided in
// vtk_tree.cpp.
#pragma once

#include "core/io/trees/tree_file.h"
#include "core/io/vtk/vtk_dataset.h"

namespace ramus::io {

[[nodiscard]] Result<ImportedTree> parse_vtk_xml(const TreeInput& input);
[[nodiscard]] Result<ImportedTree> parse_vtk_legacy(const TreeInput& input);

// One polyline a branch, from the root outward, which share the points at their nodes. Arrays as VMTK names them:
// MaximumInscribedSphereRadius of points; of cells GroupIds (the branch), CenterlineIds (the way from a root to a leaf
// that it belongs to; of several the first), TractIds (its place on that way) and Blanking (0: no branch is the inside
// of a bifurcation). Beside them labels of points, systems with their names, the roots, the tree's own data, and the
// axes, RAS or LPS, as Slicer looks for them. Data of one of VMTK's names stands there instead of what this program
// computes. Numbers are binary in base64, as they are in memory, so that nothing is lost.
[[nodiscard]] Result<void> write_vtp(const tree::VesselTree& tree, const std::filesystem::path& file,
                                     const std::vector<std::string>& comments, const Orientation& axes);

} // namespace ramus::io
