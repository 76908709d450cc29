// What a VTK file holds, whichever of its formats it has: PolyData (.vtp), unstructured grids (.vtu) and the legacy
// format (.vtk), in all their encodings: text, base64, raw, compressed by zlib, either byte order, several pieces.
// Files of trees and of surfaces are read through it. It has points, lines, faces where they are wanted, and the arrays
// that are of use.
#pragma once

#include "core/base/error.h"
#include "core/io/orientation.h"

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
inline constexpr std::string_view kVtkData = "RamusData";     // names of the arrays that are data of the tree

[[nodiscard]] bool is_vtk_poly_data(std::string_view head);
[[nodiscard]] bool is_vtk_unstructured_grid(std::string_view head);
[[nodiscard]] bool is_vtk_legacy(std::string_view head);

enum class VtkOf : std::uint8_t { kPoints, kCells, kWhole };

struct VtkArray {
    std::string name;
    VtkOf of = VtkOf::kPoints;
    std::size_t components = 1;
    std::vector<double> values; // empty: not read, as nothing needs it
    std::vector<std::string> texts;
};

struct VtkLine {
    std::size_t begin = 0, end = 0; // in `line_points`
    std::size_t cell = 0;           // its number among all cells
};

struct VtkDataset {
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> line_points;
    std::vector<VtkLine> lines;
    std::vector<std::vector<std::uint32_t>>
        faces; // where they are wanted: the corners of each, strips cut into triangles
    std::size_t cells = 0, vertex_cells = 0, surface_cells = 0, volume_cells = 0;
    std::vector<std::string> left_out; // names of arrays that are no single numbers
    std::vector<VtkArray> arrays;      // as many values as there are points or cells, times components

    [[nodiscard]] const VtkArray* find(VtkOf of, std::string_view name) const; // in capitals or not
    [[nodiscard]] std::optional<Orientation> space() const;                    // what kVtkSpace says

    // A cell of an unstructured grid or a kind of cells of poly data. The corners of curved faces come before the
    // points on their sides, of which kCurvedFace has as many.
    enum class Cell : std::uint8_t {
        kLine,
        kQuadraticLine,
        kCubicLine,
        kVertex,
        kFace,
        kStrip,
        kPixel,
        kCurvedTriangle,
        kCurvedQuad,
        kCurvedFace,
        kVolume
    };
    // `keeps_faces`: else they are counted. The points of what is kept are checked.
    [[nodiscard]] Result<void> add_cell(Cell kind, const std::vector<std::int64_t>& corners, std::size_t first_point,
                                        bool keeps_faces, const std::string& where);

private:
    void add_face(Cell kind, const std::vector<std::uint32_t>& corners);
};

// The kind of an unstructured grid's cell, by VTK's number for it.
[[nodiscard]] VtkDataset::Cell vtk_cell(int type);

struct VtkInput {
    std::string_view text;
    const std::string& name; // of the file, for messages
    // Whether an array of this name may have a meaning of its own; others are data, which may be left out.
    std::function<bool(std::string_view)> needs;
    bool faces = false;          // whether faces are wanted
    std::size_t most_arrays = 0; // so many are read, of those that are but data
    [[nodiscard]] bool has_room(const VtkDataset& data) const { return data.arrays.size() < most_arrays; }
};

// Fail with place and remedy on files that are damaged, or hold other data than points and cells.
[[nodiscard]] Result<VtkDataset> read_vtk_xml(const VtkInput& input);
[[nodiscard]] Result<VtkDataset> read_vtk_legacy(const VtkInput& input);

// An element of field data: characters by their numbers, each text with a 0 behind it.
[[nodiscard]] std::string vtk_text_array(std::string_view name, const std::vector<std::string>& texts);

} // namespace ramus::io
