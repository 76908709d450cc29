// VTK's files of lines: PolyData (.vtp), unstructured grids (.vtu) and the legacy format (.vtk), as VMTK, SimVascular,
// ParaView and Slicer write centerlines. Read in all their encodings: text, base64, raw, compressed by zlib, either
// byte order, several pieces. Widths are an array of points or of cells; which one is decided in vtk_dataset.cpp.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

// Of field data: 3D Slicer's word about the axes, "LPS" or "RAS"; in legacy files it stands in the title, SPACE=LPS.
inline constexpr std::string_view kVtkSpace = "SPACE";
// Of field data: files that this program wrote have them.
inline constexpr std::string_view kVtkMark = "RamusUnits"; // "mm", "RAS"; either may be "unknown"
inline constexpr std::string_view kVtkRoots = "RamusRoots";
inline constexpr std::string_view kVtkSystemNames = "SystemNames";
inline constexpr std::string_view kVtkSystemColours = "SystemColours";
inline constexpr std::string_view kVtkSystemIds = "SystemId"; // of cells
inline constexpr std::string_view kVtkBranchIds = "GroupIds"; // of cells, as VMTK names them
inline constexpr std::string_view kVtkLabels = "Label";       // of points

[[nodiscard]] bool is_vtk_poly_data(std::string_view head);
[[nodiscard]] bool is_vtk_unstructured_grid(std::string_view head);
[[nodiscard]] bool is_vtk_legacy(std::string_view head);

[[nodiscard]] Result<ImportedTree> parse_vtk_xml(const TreeInput& input);
[[nodiscard]] Result<ImportedTree> parse_vtk_legacy(const TreeInput& input);

// An element of field data: characters by their numbers, each text with a 0 behind it.
[[nodiscard]] std::string vtk_text_array(std::string_view name, const std::vector<std::string>& texts);

// One polyline a branch, from the root outward, which share the points at their nodes. Arrays as VMTK names them:
// MaximumInscribedSphereRadius of points; of cells GroupIds (the branch), CenterlineIds (the way from a root to a leaf
// that it belongs to; of several the first), TractIds (its place on that way) and Blanking (0: no branch is the inside
// of a bifurcation). Beside them labels of points, systems with their names, the roots, and
// the axes as Slicer looks for them. Numbers are binary in
// base64, as they are in memory, so that nothing is lost.
[[nodiscard]] Result<void> write_vtp(const tree::VesselTree& tree, const std::filesystem::path& file,
                                     const std::vector<std::string>& comments = {});

} // namespace ramus::io
