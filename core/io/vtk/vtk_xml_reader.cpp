#include "core/io/text_numbers.h"
#include "core/io/vtk/vtk_dataset.h"
#include "core/io/vtk/vtk_xml_data.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>

namespace ramus::io {

namespace {

constexpr std::size_t kMostVtkCells = std::size_t{1} << 40; // so that sums of declared counts do not overflow

bool head_has_vtk_type(std::string_view head, std::string_view type) {
    const std::size_t tag = head.find("<VTKFile");
    if (tag == std::string_view::npos) return false;
    const std::string_view attributes = head.substr(tag, head.find('>', tag) - tag);
    for (const char quote : {'"', '\''})
        if (attributes.find("type=" + (quote + std::string(type)) + quote) != std::string_view::npos) return true;
    return false;
}

class VtkXmlReader {
public:
    VtkXmlReader(const VtkInput& input, const VtkXmlData& xml) : input_(input), xml_(xml) {}

    Result<VtkDataset> read() {
        const pugi::xml_node root = xml_.document().child("VTKFile");
        const std::string type = root.attribute("type").value();
        if (type != "PolyData" && type != "UnstructuredGrid")
            return fail("VTK data of type " + shown(type) + " hold neither lines nor faces", xml_.place(root),
                        "they stand in PolyData (.vtp) or UnstructuredGrid (.vtu)");
        const pugi::xml_node body = root.child(type.c_str());
        if (!body) return fail("the element " + type + " is missing", xml_.place(root), "get the file again");
        if (auto good = read_fields(body.child("FieldData")); !good) return tl::unexpected(good.error());
        for (const pugi::xml_node& piece : body.children("Piece"))
            if (auto good = read_piece(piece, type == "PolyData"); !good) return tl::unexpected(good.error());
        // An array that some pieces lack is left out.
        for (VtkArray& array : data_.arrays) {
            const std::size_t things = array.of == VtkOf::kPoints ? data_.points.size() : data_.cells;
            if (array.of != VtkOf::kWhole && array.values.size() != things * array.components) array.values.clear();
        }
        return std::move(data_);
    }

private:
    Result<void> read_piece(const pugi::xml_node& piece, bool poly_data) {
        const std::size_t first_point = data_.points.size(), first_cell = data_.cells;
        const pugi::xml_node array = piece.child("Points").child("DataArray");
        RAMUS_TRY(claimed, claim(piece, "NumberOfPoints"));
        if (array) {
            RAMUS_TRY(values, xml_.numbers(array, 3 * std::uint64_t{claimed}));
            if (values.size() != 3 * claimed)
                return fail("the file declares " + counted(claimed, "point") + ", but lists " +
                                std::to_string(values.size() / 3),
                            xml_.place(array), "the file is incomplete or damaged; get it again");
            if (data_.points.size() + claimed >= std::numeric_limits<std::uint32_t>::max())
                return fail("the file has more points than can be counted", xml_.place(array), "split it");
            for (std::size_t p = 0; p < claimed; ++p)
                data_.points.emplace_back(values[3 * p], values[3 * p + 1], values[3 * p + 2]);
        } else if (claimed > 0) {
            return fail("the coordinates of the points are missing", xml_.place(piece), "get the file again");
        }
        if (auto good = poly_data ? read_poly_data(piece, first_point) : read_grid(piece, first_point); !good)
            return good;
        if (auto good = read_arrays(piece.child("PointData"), VtkOf::kPoints, claimed); !good) return good;
        return read_arrays(piece.child("CellData"), VtkOf::kCells, data_.cells - first_cell);
    }

    Result<std::size_t> claim(const pugi::xml_node& piece, const char* name) const {
        const std::string_view text = piece.attribute(name).as_string("0");
        const auto number = to_whole(trimmed(text));
        if (!number || *number < 0 || static_cast<std::uint64_t>(*number) > kMostVtkCells)
            return fail(std::string(name) + " " + shown(text) + " is not a possible number", xml_.place(piece),
                        "correct the file");
        return static_cast<std::size_t>(*number);
    }

    // Reads connectivity and offsets, the points of every cell. `cell_of(n)`: the kind of cell n.
    template <class KindOf>
    Result<void> read_cells(const pugi::xml_node& cells, std::size_t count, std::size_t first_point,
                            const KindOf& kind_of) {
        if (count == 0) return {};
        const pugi::xml_node points = cells.find_child_by_attribute("DataArray", "Name", "connectivity"),
                             ends = cells.find_child_by_attribute("DataArray", "Name", "offsets");
        if (!points || !ends)
            return fail("connectivity or offsets are missing", xml_.place(cells ? cells : xml_.document().root()),
                        "the file is incomplete; get it again");
        RAMUS_TRY(offsets, xml_.whole_numbers(ends, count));
        if (offsets.size() != count)
            return fail("the file declares " + counted(count, "cell") + ", but lists " + std::to_string(offsets.size()),
                        xml_.place(ends), "the file is incomplete or damaged; get it again");
        const auto last = static_cast<std::uint64_t>(std::max<std::int64_t>(offsets.back(), 0));
        RAMUS_TRY(corners, xml_.whole_numbers(points, last));
        std::vector<std::int64_t> cell;
        std::int64_t begin = 0;
        const std::string where = xml_.place(points);
        for (std::size_t c = 0; c < count; ++c) {
            if (offsets[c] < begin || static_cast<std::uint64_t>(offsets[c]) > corners.size())
                return fail("the offsets of the cells do not fit their connectivity", xml_.place(ends),
                            "the file is damaged; get it again");
            cell.assign(corners.begin() + begin, corners.begin() + offsets[c]);
            begin = offsets[c];
            if (auto good = data_.add_cell(kind_of(c), cell, first_point, input_.faces, where); !good) return good;
        }
        return {};
    }

    Result<void> read_poly_data(const pugi::xml_node& piece, std::size_t first_point) {
        RAMUS_TRY(vertices, claim(piece, "NumberOfVerts"));
        RAMUS_TRY(lines, claim(piece, "NumberOfLines"));
        RAMUS_TRY(faces, claim(piece, "NumberOfPolys"));
        RAMUS_TRY(strips, claim(piece, "NumberOfStrips"));
        data_.cells += vertices;
        data_.vertex_cells += vertices;
        using Cell = VtkDataset::Cell;
        const auto line = [](std::size_t) { return Cell::kLine; };
        if (auto good = read_cells(piece.child("Lines"), lines, first_point, line); !good) return good;
        if (!input_.faces) {
            data_.cells += faces + strips;
            data_.surface_cells += faces + strips;
            return {};
        }
        const auto face = [](std::size_t) { return Cell::kFace; };
        if (auto good = read_cells(piece.child("Polys"), faces, first_point, face); !good) return good;
        const auto strip = [](std::size_t) { return Cell::kStrip; };
        return read_cells(piece.child("Strips"), strips, first_point, strip);
    }

    Result<void> read_grid(const pugi::xml_node& piece, std::size_t first_point) {
        RAMUS_TRY(count, claim(piece, "NumberOfCells"));
        if (count == 0) return {};
        const pugi::xml_node cells = piece.child("Cells");
        const pugi::xml_node array = cells.find_child_by_attribute("DataArray", "Name", "types");
        if (!array)
            return fail("the types of the cells are missing", xml_.place(piece),
                        "the file is incomplete; get it again");
        RAMUS_TRY(types, xml_.whole_numbers(array, count));
        if (types.size() != count)
            return fail("the file declares " + counted(count, "cell") + ", but lists the types of " +
                            std::to_string(types.size()),
                        xml_.place(array), "the file is incomplete or damaged; get it again");
        return read_cells(cells, count, first_point,
                          [&](std::size_t c) { return vtk_cell(static_cast<int>(types[c] & 0xFF)); });
    }

    Result<void> read_arrays(const pugi::xml_node& arrays, VtkOf of, std::size_t things) {
        for (const pugi::xml_node& array : arrays.children()) {
            const std::string name = array.attribute("Name").value();
            if (std::string_view(array.name()) != "DataArray") {
                if (std::string_view(array.name()) == "Array") leave_out(name);
                continue;
            }
            const bool is_needed = input_.needs(name);
            const auto [at, is_new] = known_.try_emplace({of, name}, data_.arrays.size());
            if (is_new) {
                if (!is_needed && !input_.has_room(data_)) continue;
                const std::size_t components = array.attribute("NumberOfComponents").as_uint(1);
                data_.arrays.push_back({name, of, std::max<std::size_t>(components, 1), {}, {}});
            }
            VtkArray& known = data_.arrays[at->second];
            if (known.components != 1) {
                leave_out(name);
                continue;
            }
            auto read = xml_.numbers(array, things);
            if (!is_needed && (!read || read->size() != things)) { // not needed, so no reason to fail
                leave_out(name);
                continue;
            }
            RAMUS_TRY(values, std::move(read));
            if (values.size() != things)
                return fail("the array " + shown(name) + " has " + counted(values.size(), "value") + " for " +
                                counted(things, of == VtkOf::kPoints ? "point" : "cell"),
                            xml_.place(array), "the file is incomplete or damaged; get it again");
            known.values.insert(known.values.end(), values.begin(), values.end());
        }
        return {};
    }

    void leave_out(const std::string& name) {
        if (std::ranges::find(data_.left_out, name) == data_.left_out.end() && input_.has_room(data_))
            data_.left_out.push_back(name);
    }

    Result<void> read_fields(const pugi::xml_node& fields) {
        for (const pugi::xml_node& array : fields.children()) {
            const std::string name = array.attribute("Name").value();
            if (!input_.needs(name)) continue;
            VtkArray field{name, VtkOf::kWhole, 1, {}, {}};
            const bool is_text = std::string_view(array.attribute("type").value()) == "String";
            RAMUS_TRY(values, xml_.numbers(array));
            if (!is_text) {
                field.values = std::move(values);
            } else { // codes of characters, with a 0 after each text
                std::string text;
                for (const double value : values) {
                    if (value != 0.0)
                        text += static_cast<char>(static_cast<int>(value > -129.0 && value < 256.0 ? value : '?'));
                    if (value == 0.0) field.texts.push_back(std::exchange(text, {}));
                }
            }
            data_.arrays.push_back(std::move(field));
        }
        return {};
    }

    const VtkInput& input_;
    const VtkXmlData& xml_;
    VtkDataset data_;
    std::map<std::pair<VtkOf, std::string>, std::size_t> known_; // arrays of points and cells
};

} // namespace

bool is_vtk_poly_data(std::string_view head) { return head_has_vtk_type(head, "PolyData"); }
bool is_vtk_unstructured_grid(std::string_view head) { return head_has_vtk_type(head, "UnstructuredGrid"); }

Result<VtkDataset> read_vtk_xml(const VtkInput& input) {
    RAMUS_TRY(xml, VtkXmlData::parse(input.text, input.name));
    return VtkXmlReader(input, xml).read();
}

} // namespace ramus::io
