// Reads VTK files into a VtkDataset: points, lines, optionally faces, and arrays. Formats: PolyData (.vtp),
// unstructured grids (.vtu) and the legacy format (.vtk), in all their encodings: text, base64, raw, compressed, either
// byte order, several pieces. Trees (trees/vtk.h) and surfaces (meshes/vtk_surface.h) are read through it.
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

// Field data: 3D Slicer's word for the axes, "LPS" or "RAS". In legacy files it is in the title: SPACE=LPS.
inline constexpr std::string_view kVtkSpace = "SPACE";
// Field data and arrays of files written by ramus.
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
    std::vector<double> values; // empty: not read, because nothing needs it
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
    std::vector<std::vector<std::uint32_t>> faces; // if wanted: the corners of each; strips are cut into triangles
    std::size_t cells = 0, vertex_cells = 0, surface_cells = 0, volume_cells = 0;
    std::vector<std::string> left_out; // names of arrays that are not one number each
    std::vector<VtkArray> arrays;      // with one value for each point or cell and component

    [[nodiscard]] const VtkArray* find(VtkOf of, std::string_view name) const; // case-insensitive; null: none
    [[nodiscard]] std::optional<Orientation> space() const;                    // stated by kVtkSpace

    // The kind of a cell. The corners of curved faces come before the points on their sides; kCurvedFace has as many
    // side points as corners.
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
    // Adds a cell of points `corners`. `keeps_faces`: false to only count faces. Fails if a cell that is kept refers to
    // a missing point.
    [[nodiscard]] Result<void> add_cell(Cell kind, const std::vector<std::int64_t>& corners, std::size_t first_point,
                                        bool keeps_faces, const std::string& where);

private:
    void add_face(Cell kind, const std::vector<std::uint32_t>& corners);
};

// The kind of a cell of an unstructured grid, from VTK's cell type number.
[[nodiscard]] VtkDataset::Cell vtk_cell(int type);

struct VtkInput {
    std::string_view text;
    const std::string& name; // of the file, for messages
    // Whether an array of this name may have a meaning. Other arrays are data, which may be left out.
    std::function<bool(std::string_view)> needs;
    bool faces = false;          // whether faces are wanted
    std::size_t most_arrays = 0; // no further data arrays are read when there are so many arrays
    [[nodiscard]] bool has_room(const VtkDataset& data) const { return data.arrays.size() < most_arrays; }
};

// Fail with place and remedy on damaged files, and on datasets that are not points and cells.
[[nodiscard]] Result<VtkDataset> read_vtk_xml(const VtkInput& input);
[[nodiscard]] Result<VtkDataset> read_vtk_legacy(const VtkInput& input);

// An XML element of field data with texts: the code of each character, and a 0 after each text.
[[nodiscard]] std::string vtk_text_array(std::string_view name, const std::vector<std::string>& texts);

} // namespace ramus::io
