// Reads surfaces from VTK's files (core/io/vtk): polygons, triangle strips, and faces of unstructured grids. A curved
// face becomes the polygon of its corners. Lines and volume cells are left out.
#pragma once

#include "core/io/meshes/mesh_file.h"

#include <optional>
#include <string_view>

namespace ramus::io {

// Fail with place and remedy on damaged files, and on files without faces.
[[nodiscard]] Result<PolygonSoup> parse_vtk_xml_surface(std::string_view text, const std::string& name);
[[nodiscard]] Result<PolygonSoup> parse_vtk_legacy_surface(std::string_view text, const std::string& name);

// Whether the file can be read and has no lines, so that it cannot be a tree.
[[nodiscard]] bool is_vtk_surface(std::string_view text);

// The same from the first bytes of PolyData in XML, by the counts of lines and polygons of its first piece. None: the
// counts do not tell.
[[nodiscard]] std::optional<bool> vtk_surface_by_counts(std::string_view head);

} // namespace ramus::io
