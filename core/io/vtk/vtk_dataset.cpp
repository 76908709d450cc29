#include "core/io/vtk/vtk_dataset.h"

#include "core/io/text_numbers.h"

#include <algorithm>

namespace ramus::io {

const VtkArray* VtkDataset::find(VtkOf of, std::string_view name) const {
    const std::string lower = lower_case(name);
    for (const VtkArray& array : arrays)
        if (array.of == of && array.name == name) return &array;
    for (const VtkArray& array : arrays)
        if (array.of == of && lower_case(array.name) == lower) return &array;
    return nullptr;
}

std::optional<Orientation> VtkDataset::space() const {
    const VtkArray* space = find(VtkOf::kWhole, kVtkSpace);
    return space != nullptr && space->texts.size() == 1 ? slicer_space(space->texts[0]) : std::nullopt;
}

VtkDataset::Cell vtk_cell(int type) {
    using Cell = VtkDataset::Cell;
    switch (type) {
    case 0: // empty
    case 1:
    case 2:
        return Cell::kVertex;
    case 3:
    case 4:
        return Cell::kLine;
    case 21:
        return Cell::kQuadraticLine;
    case 35:
        return Cell::kCubicLine;
    case 5: // triangle, polygon, quad
    case 7:
    case 9:
        return Cell::kFace;
    case 6:
        return Cell::kStrip;
    case 8:
        return Cell::kPixel;
    case 22:
    case 34:
        return Cell::kCurvedTriangle;
    case 23:
    case 28:
    case 30:
        return Cell::kCurvedQuad;
    case 36:
        return Cell::kCurvedFace;
    default:
        return Cell::kVolume;
    }
}

void VtkDataset::add_face(Cell kind, const std::vector<std::uint32_t>& corners) {
    const std::size_t count = corners.size();
    const auto keep = [&](std::size_t most) {
        faces.emplace_back(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(std::min(count, most)));
    };
    switch (kind) {
    case Cell::kStrip: // every other triangle is turned
        for (std::size_t i = 2; i < count; ++i)
            faces.push_back({corners[i - 2 + i % 2], corners[i - 1 - i % 2], corners[i]});
        break;
    case Cell::kPixel:
        keep(4);
        if (count >= 4) std::swap(faces.back()[2], faces.back()[3]);
        break;
    case Cell::kCurvedTriangle:
        keep(3);
        break;
    case Cell::kCurvedQuad:
        keep(4);
        break;
    case Cell::kCurvedFace:
        keep(count / 2);
        break;
    default:
        keep(count);
    }
}

Result<void> VtkDataset::add_cell(Cell kind, const std::vector<std::int64_t>& corners, std::size_t first_point,
                                  bool keeps_faces, const std::string& where) {
    const std::size_t cell = cells++;
    const bool is_line = kind == Cell::kLine || kind == Cell::kQuadraticLine || kind == Cell::kCubicLine;
    const bool is_face = !is_line && kind != Cell::kVertex && kind != Cell::kVolume;
    if (kind == Cell::kVertex) ++vertex_cells;
    if (kind == Cell::kVolume) ++volume_cells;
    if (is_face) ++surface_cells;
    if (!is_line && !(is_face && keeps_faces)) return {};
    std::vector<std::uint32_t> along;
    for (const std::int64_t corner : corners) {
        if (corner < 0 || static_cast<std::uint64_t>(corner) >= points.size() - first_point)
            return fail("cell " + std::to_string(cell) + " names point " + std::to_string(corner) +
                            ", but there are only " + std::to_string(points.size() - first_point),
                        where, "the file is damaged; get it again");
        along.push_back(static_cast<std::uint32_t>(first_point + static_cast<std::size_t>(corner)));
    }
    if (is_face) {
        add_face(kind, along);
        return {};
    }
    // Curved lines have their two ends first.
    if (kind != Cell::kLine && along.size() > 2) std::rotate(along.begin() + 1, along.begin() + 2, along.end());
    lines.push_back({line_points.size(), line_points.size() + along.size(), cell});
    line_points.insert(line_points.end(), along.begin(), along.end());
    return {};
}

std::string vtk_text_array(std::string_view name, const std::vector<std::string>& texts) {
    std::string array = "<Array type=\"String\" Name=\"" + std::string(name) + "\" NumberOfTuples=\"" +
                        std::to_string(texts.size()) + "\" format=\"ascii\">";
    for (const std::string& text : texts) {
        for (const char c : text) array += std::to_string(static_cast<unsigned char>(c)) + " ";
        array += "0 ";
    }
    return array + "</Array>\n";
}

} // namespace ramus::io
