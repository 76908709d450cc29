// What a VTK file holds, whichever of its formats it has (legacy .vtk, .vtp, .vtu), as far as a vessel tree needs it:
// points, lines, and the arrays that may give widths or systems. One function makes an ImportedTree of it.
#pragma once

#include "core/io/trees/tree_file.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

enum class VtkOf : std::uint8_t { kPoints, kCells, kWhole };

struct VtkArray {
    std::string name;
    VtkOf of = VtkOf::kPoints;
    std::size_t components = 1;
    std::vector<double> values; // empty: not read, as nothing needs it (vtk_needs())
    std::vector<std::string> texts;
};

// Whether the values of an array of this name are of use; others may be skipped.
[[nodiscard]] bool vtk_needs(std::string_view name, const ReadOptions& options);

struct VtkLine {
    std::size_t begin = 0, end = 0; // in `line_points`
    std::size_t cell = 0;           // its number among all cells
};

struct VtkDataset {
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> line_points;
    std::vector<VtkLine> lines;
    std::size_t cells = 0, vertex_cells = 0, surface_cells = 0, volume_cells = 0;
    std::vector<VtkArray> arrays; // as many values as there are points or cells, times components

    [[nodiscard]] const VtkArray* find(VtkOf of, std::string_view name) const; // in capitals or not

    // A cell of an unstructured grid or a kind of cells of poly data; its points are checked.
    enum class Cell : std::uint8_t { kLine, kQuadraticLine, kCubicLine, kVertex, kSurface, kVolume };
    [[nodiscard]] Result<void> add_cell(Cell kind, const std::vector<std::int64_t>& corners, std::size_t first_point,
                                        const std::string& where);
};

// The kind of an unstructured grid's cell, by VTK's number for it.
[[nodiscard]] VtkDataset::Cell vtk_cell(int type);

[[nodiscard]] Result<ImportedTree> tree_of_vtk(const VtkDataset& data, const TreeInput& input);

} // namespace ramus::io
