#include "core/io/text_numbers.h"
#include "core/io/trees/vtk.h"
#include "core/io/trees/width_names.h"
#include "core/io/vtk/vtk_dataset.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace ramus::io {

namespace {

// Arrays of VMTK's centerlines; each centerline runs from the inlet to one outlet.
constexpr std::string_view kCenterlineNames[] = {"MaximumInscribedSphereRadius", "CenterlineIds", "GroupIds",
                                                 "TractIds", "Blanking"};

// Arrays that only SimVascular writes; its models are in cm.
constexpr std::string_view kSimVascularNames[] = {"BranchId",    "BifurcationId",         "CenterlineId",
                                                  "BranchIdTmp", "CenterlineSectionArea", "GlobalNodeId"};

bool has_values(const VtkArray& array) {
    return array.of != VtkOf::kWhole && array.components == 1 && !array.values.empty();
}

struct WidthArray {
    const VtkArray* array = nullptr;
    WidthName name{};
};

// The array of widths that a person chose, else the most reliable one. Null: none.
Result<WidthArray> find_widths(const VtkDataset& data, const TreeInput& input) {
    if (const auto asked = input.options.columns.find("radius"); asked != input.options.columns.end()) {
        for (const VtkOf of : {VtkOf::kPoints, VtkOf::kCells})
            if (const VtkArray* array = data.find(of, asked->second); array != nullptr && has_values(*array))
                return WidthArray{array,
                                  width_by_word(array->name).value_or(WidthName{array->name, RadiusIs::kRadius, true})};
        return fail("there is no array \"" + asked->second + "\" of one number for each point or cell", input.name,
                    "name another one");
    }
    for (const WidthName& known : kWidthNames)
        for (const VtkOf of : {VtkOf::kPoints, VtkOf::kCells})
            if (const VtkArray* array = data.find(of, known.name); array != nullptr && has_values(*array))
                return WidthArray{array, known};
    for (const VtkArray& array : data.arrays)
        if (const auto word = width_by_word(array.name); word && has_values(array)) return WidthArray{&array, *word};
    return WidthArray{};
}

std::string list_of_arrays(const VtkDataset& data) {
    std::string list;
    for (const VtkArray& array : data.arrays)
        if (array.of != VtkOf::kWhole)
            list += (list.empty() ? "" : ", ") + array.name + (array.of == VtkOf::kPoints ? " (points)" : " (cells)");
    return list.empty() ? "it has no arrays at all" : "it has " + list;
}

tl::unexpected<Error> no_lines(const VtkDataset& data, const std::string& name) {
    if (data.surface_cells > 0)
        return fail("this is a surface mesh of " + counted(data.surface_cells, "face") + ", not a tree", name,
                    "a tree needs centerlines; as a surface, --context of ramus render shows it");
    if (data.volume_cells > 0)
        return fail("this is a volume mesh of " + std::to_string(data.volume_cells) + " cells, not a tree", name,
                    "a tree needs centerlines: cells that are lines");
    return fail("there are points, but no lines that connect them", name,
                "a tree needs centerlines: cells that are lines or polylines");
}

bool has_any(const VtkDataset& data, std::span<const std::string_view> names) {
    return std::ranges::any_of(names, [&](std::string_view name) {
        return data.find(VtkOf::kPoints, name) != nullptr || data.find(VtkOf::kCells, name) != nullptr;
    });
}

// Evidence about the unit from arrays that only one program writes. Empty: none.
std::string hint_of_arrays(const VtkDataset& data) {
    std::vector<std::string_view> found;
    for (const std::string_view name : kSimVascularNames)
        if (found.size() < 3 && has_any(data, std::span(&name, 1))) found.push_back(name);
    if (found.empty()) return {};
    std::string names;
    for (const std::string_view name : found) names += (names.empty() ? "" : ", ") + std::string(name);
    return "its arrays (" + names + ") are those of SimVascular, whose models are in cm as a rule";
}

// Whether several lines begin where no other line ends. Lines that share points begin at one root.
bool begins_several_times(const tree::Graph& graph) {
    std::vector<bool> in(graph.points.size(), false), out(graph.points.size(), false);
    for (const auto& [a, b] : graph.edges) out[a] = true, in[b] = true;
    std::size_t beginnings = 0;
    for (std::size_t p = 0; p < in.size(); ++p) beginnings += out[p] && !in[p] ? 1 : 0;
    return beginnings > 1;
}

void set_widths(const VtkDataset& data, const WidthArray& widths, ImportedTree& imported) {
    imported.radius_is = widths.name.is;
    if (widths.name.open) imported.radius_name = widths.array->name;
    const std::vector<double>& values = widths.array->values;
    if (widths.array->of == VtkOf::kPoints) {
        for (std::size_t p = 0; p < values.size(); ++p) imported.graph.points[p].radius = values[p];
        return;
    }
    for (const VtkLine& line : data.lines)
        for (std::size_t i = line.begin + 1; i < line.end; ++i) imported.edge_radii.push_back(values[line.cell]);
}

// Arrays without another meaning. For files written by ramus: the arrays that the file lists as the tree's own.
void keep_data(const VtkDataset& data, const VtkArray* widths, ImportedTree& imported) {
    const bool own = data.find(VtkOf::kWhole, kVtkMark) != nullptr;
    const VtkArray* listed = data.find(VtkOf::kWhole, kVtkData);
    const auto is_data = [&](const VtkArray& array) {
        if (&array == widths || !has_values(array)) return false;
        return !own || (listed != nullptr && std::ranges::find(listed->texts, array.name) != listed->texts.end());
    };
    std::vector<std::size_t> edge_cells;
    for (const VtkLine& line : data.lines)
        for (std::size_t i = line.begin + 1; i < line.end; ++i) edge_cells.push_back(line.cell);
    for (const VtkArray& array : data.arrays) {
        if (!is_data(array)) continue;
        if (array.of == VtkOf::kPoints)
            imported.graph.point_data.push_back({array.name, array.values});
        else
            imported.graph.edge_data.push_back(
                std::move(tree::picked({{array.name, array.values}}, edge_cells).front()));
    }
    if (!own) imported.left_out = data.left_out;
}

// Reads arrays that only files written by ramus have.
Result<void> read_own_arrays(const VtkDataset& data, const std::string& name, ImportedTree& imported) {
    const VtkArray* marks = data.find(VtkOf::kWhole, kVtkMark);
    if (marks == nullptr) return {};
    if (marks->texts.size() == 2)
        imported.take_as_written(marks->texts[0], marks->texts[1]);
    else
        imported.take_as_written();
    imported.joining = Joining::kByIndex;
    imported.may_repeat_trunks = false;
    imported.unit_hint.clear();
    if (const VtkArray* roots = data.find(VtkOf::kWhole, kVtkRoots))
        for (const double root : roots->values)
            if (root >= 0.0 && root < static_cast<double>(data.points.size()))
                imported.graph.roots.push_back(static_cast<std::uint32_t>(root));
    if (const VtkArray* labels = data.find(VtkOf::kPoints, kVtkLabels); labels != nullptr && has_values(*labels))
        for (const double label : labels->values)
            imported.graph.labels.push_back(std::abs(label) < 2147483648.0 ? static_cast<int>(label) : 0);
    const VtkArray *names = data.find(VtkOf::kWhole, kVtkSystemNames), *ids = data.find(VtkOf::kCells, kVtkSystemIds),
                   *colours = data.find(VtkOf::kWhole, kVtkSystemColours);
    if (names == nullptr || ids == nullptr || names->texts.empty()) return {};
    for (std::size_t s = 0; s < names->texts.size(); ++s) {
        tree::System system{names->texts[s], {}};
        if (colours != nullptr && colours->values.size() == 3 * names->texts.size())
            for (std::size_t c = 0; c < 3; ++c)
                if (const double value = colours->values[3 * s + c]; value >= 0.0 && value <= 255.0)
                    system.colour[c] = static_cast<std::uint8_t>(value);
        imported.graph.systems.push_back(std::move(system));
    }
    imported.graph.point_systems.assign(data.points.size(), 0);
    for (const VtkLine& line : data.lines) {
        const double id = line.cell < ids->values.size() ? ids->values[line.cell] : -1.0;
        if (!(id >= 0.0 && id < static_cast<double>(names->texts.size())))
            return fail("cell " + std::to_string(line.cell) + " is of a system that has no name", name,
                        "correct the array " + std::string(kVtkSystemIds));
        for (std::size_t i = line.begin; i < line.end; ++i)
            imported.graph.point_systems[data.line_points[i]] = static_cast<int>(id);
    }
    return {};
}

} // namespace

static Result<ImportedTree> tree_of_vtk(const VtkDataset& data, const TreeInput& input) {
    const std::string& name = input.name;
    if (data.lines.empty()) return no_lines(data, name);
    RAMUS_TRY(widths, find_widths(data, input));
    if (widths.array == nullptr && !input.options.radius_mm)
        return fail("no array of points or lines gives the radius: " + list_of_arrays(data), name,
                    "name the array \"Radius\" (VMTK calls it MaximumInscribedSphereRadius), or give all points the "
                    "same radius with --radius MM");
    ImportedTree imported;
    for (const glm::dvec3& position : data.points) imported.graph.points.push_back({position, 0.0});
    for (const VtkLine& line : data.lines)
        for (std::size_t i = line.begin + 1; i < line.end; ++i)
            imported.graph.edges.emplace_back(data.line_points[i - 1], data.line_points[i]);
    if (widths.array != nullptr) set_widths(data, widths, imported);
    keep_data(data, widths.array, imported);
    imported.joining = Joining::kAtAnyPoint;
    imported.may_repeat_trunks = has_any(data, kCenterlineNames) && begins_several_times(imported.graph);
    imported.unit_hint = hint_of_arrays(data);
    imported.orientation = data.space();
    imported.place_of = [name](std::uint32_t point) { return name + ": point " + std::to_string(point); };
    if (auto own = read_own_arrays(data, name, imported); !own) return tl::unexpected(own.error());
    if (data.surface_cells > 0)
        imported.assume("lines", counted(data.surface_cells, "face") + " beside the lines were left out");
    return imported;
}

// The arrays that a tree needs.
static VtkInput vtk_input(const TreeInput& input) {
    const auto asked = input.options.columns.find("radius");
    const std::string column = asked == input.options.columns.end() ? std::string() : asked->second;
    const auto needs = [column](std::string_view name) {
        return (!column.empty() && name == column) || width_by_word(name).has_value() || name == kVtkMark ||
               name == kVtkRoots || name == kVtkSystemNames || name == kVtkSystemIds || name == kVtkSystemColours ||
               name == kVtkLabels || name == kVtkSpace || name == kVtkData;
    };
    return {
        .text = input.text, .name = input.name, .needs = needs, .faces = false, .most_arrays = 2 * tree::kMostArrays};
}

Result<ImportedTree> parse_vtk_xml(const TreeInput& input) {
    RAMUS_TRY(data, read_vtk_xml(vtk_input(input)));
    return tree_of_vtk(data, input);
}

Result<ImportedTree> parse_vtk_legacy(const TreeInput& input) {
    RAMUS_TRY(data, read_vtk_legacy(vtk_input(input)));
    return tree_of_vtk(data, input);
}

} // namespace ramus::io
