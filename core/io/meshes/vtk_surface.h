// Surfaces in VTK's files (core/io/vtk): polygons, triangle strips, and the cells of unstructured grids that are faces.
// Of curved faces the corners count. Lines and volume cells beside them are left out.
#pragma once

#include "core/io/meshes/mesh_file.h"

#include <optional>
#include <string_view>

namespace ramus::io {

// Fail with place and remedy on damaged files, and on those that have no faces.
[[nodiscard]] Result<PolygonSoup> parse_vtk_xml_surface(std::string_view text, const std::string& name);
[[nodiscard]] Result<PolygonSoup> parse_vtk_legacy_surface(std::string_view text, const std::string& name);

// Whether a file that can be read has no lines: then it can be no tree.
[[nodiscard]] bool is_vtk_surface(std::string_view text);

// The same from the first bytes of PolyData in XML, which count its first piece's lines and polygons; none: they do not
// say.
[[nodiscard]] std::optional<bool> vtk_surface_by_counts(std::string_view head);

} // namespace ramus::io
