#include "core/io/meshes/vtk_surface.h"

#include "core/io/text_numbers.h"
#include "core/io/vtk/vtk_dataset.h"

#include <utility>

namespace ramus::io {

namespace {

tl::unexpected<Error> no_faces(const VtkDataset& data, const std::string& name) {
    if (!data.lines.empty())
        return fail("it has " + counted(data.lines.size(), "line") + " and no faces: this is a tree, not a surface",
                    name, "a surface has triangles or other polygons");
    if (data.volume_cells > 0)
        return fail("this is a volume mesh of " + counted(data.volume_cells, "cell") + ", not a surface", name,
                    "extract its surface, as ParaView does with Extract Surface");
    return fail("it has no faces", name, "a surface has triangles or other polygons");
}

Result<PolygonSoup> vtk_soup(VtkDataset data, const std::string& name) {
    if (data.faces.empty()) return no_faces(data, name);
    PolygonSoup soup;
    soup.orientation = data.space();
    soup.positions = std::move(data.points);
    soup.polygons = std::move(data.faces);
    return soup;
}

VtkInput surface_input(std::string_view text, const std::string& name, bool faces) {
    return {.text = text,
            .name = name,
            .needs = [](std::string_view array) { return array == kVtkSpace; },
            .faces = faces,
            .most_arrays = 0};
}

} // namespace

Result<PolygonSoup> parse_vtk_xml_surface(std::string_view text, const std::string& name) {
    RAMUS_TRY(data, read_vtk_xml(surface_input(text, name, true)));
    return vtk_soup(std::move(data), name);
}

Result<PolygonSoup> parse_vtk_legacy_surface(std::string_view text, const std::string& name) {
    RAMUS_TRY(data, read_vtk_legacy(surface_input(text, name, true)));
    return vtk_soup(std::move(data), name);
}

bool is_vtk_surface(std::string_view text) {
    const std::string no_name;
    const VtkInput input = surface_input(text, no_name, false);
    const auto data = is_vtk_legacy(text) ? read_vtk_legacy(input) : read_vtk_xml(input);
    return data && data->lines.empty();
}

std::optional<bool> vtk_surface_by_counts(std::string_view head) {
    const std::size_t at = head.find("<Piece"), end = head.find('>', at);
    if (end == std::string_view::npos || head.substr(0, at).find("PolyData") == std::string_view::npos)
        return std::nullopt;
    const auto count = [piece = head.substr(at, end - at)](std::string_view of) {
        const std::size_t begin = piece.find(of);
        if (begin == std::string_view::npos) return std::optional<std::int64_t>();
        const std::string_view value = piece.substr(begin + of.size());
        return to_whole(value.substr(0, value.find('"')));
    };
    const auto lines = count("NumberOfLines=\""), polygons = count("NumberOfPolys=\""),
               strips = count("NumberOfStrips=\"");
    if (lines && *lines > 0) return false;
    return lines && polygons.value_or(0) + strips.value_or(0) > 0 ? std::optional(true) : std::nullopt;
}

} // namespace ramus::io
