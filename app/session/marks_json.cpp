#include "app/session/marks_json.h"

#include "app/session/colour_by.h"
#include "app/session/json_values.h"
#include "core/base/sort_unique.h"
#include "core/base/words.h"
#include "core/io/trees/imported_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace ramus::app::session_json {

namespace {

constexpr std::array<std::pair<std::string_view, Measurement::Kind>, 4> kMeasurementNames{
    {{"distance", Measurement::Kind::kDistance},
     {"path", Measurement::Kind::kPath},
     {"diameter", Measurement::Kind::kDiameter},
     {"angle", Measurement::Kind::kAngle}}};

} // namespace

// "sphere 2", "mesh 1": counted from 1 among the lesions of the same shape; empty: none.
std::string lesion_json(int id, const Marks& marks) {
    if (id == kNoObject) return {};
    const auto index = lesion_index(marks, id);
    const std::size_t spheres = spheres_of(marks).size();
    if (!index) return "sphere " + std::to_string(spheres + 1); // stays a reference to a missing lesion
    return *index < spheres ? "sphere " + std::to_string(*index + 1) : "mesh " + std::to_string(*index + 1 - spheres);
}

int lesion_in(const json& value, const Marks& marks) {
    const std::string wanted = text(value, "lesion");
    if (wanted.empty()) return kNoObject;
    const std::size_t blank = wanted.find(' ');
    const int number = blank == std::string::npos ? 0 : parsed<int>(wanted.substr(blank + 1)).value_or(0);
    const std::string shape = wanted.substr(0, blank);
    if (number < 1 || (shape != "sphere" && shape != "mesh"))
        throw Refusal{"\"" + wanted + "\" is not a lesion, \"sphere 1\" or \"mesh 1\""};
    int left = number;
    for (const Lesion& lesion : marks.lesions)
        if (lesion.is_mesh() == (shape == "mesh") && --left == 0) return lesion.id;
    return kLostObject;
}

static void read_lesions_of(const json& value, const Marks& marks, Measurement& found) {
    if (value.contains("shortest")) found.shortest = truth(value["shortest"], "shortest");
    const json lesions = value.value("lesions", json::array());
    if (!lesions.is_array() || (!lesions.empty() && lesions.size() != found.lesions.size()))
        throw Refusal{"lesions of a measurement are not two"};
    for (std::size_t i = 0; i < lesions.size(); ++i) found.lesions[i] = lesion_in(lesions[i], marks);
    if (found.kind != Measurement::Kind::kDistance && (found.shortest || names_lesion(found)))
        throw Refusal{"only distances are measured from lesions"};
    if (found.shortest && (found.lesions[0] == kNoObject || found.lesions[1] != kNoObject))
        throw Refusal{"a shortest distance is from one lesion, the first"};
}

json measurement_json(const Measurement& m, const Marks& marks) {
    json value;
    for (const auto& [name, kind] : kMeasurementNames)
        if (kind == m.kind) value["kind"] = std::string(name);
    for (const glm::dvec3& p : std::span(m.points).first(point_count(m))) value["points"].push_back({p.x, p.y, p.z});
    if (names_lesion(m))
        for (const int lesion : m.lesions) value["lesions"].push_back(lesion_json(lesion, marks));
    if (m.shortest) value["shortest"] = true;
    const auto places = std::span(m.places).first(place_count(m));
    for (const measure::BranchPlace& place : places) value["branches"].push_back(place.branch);
    if (m.kind == Measurement::Kind::kDiameter)
        value["fraction"] = places[0].fraction;
    else if (!of_branching(m) && m.kind != Measurement::Kind::kDistance)
        for (const measure::BranchPlace& place : places) value["fractions"].push_back(place.fraction);
    write_object(value, m);
    return value;
}

Measurement measurement_in(const json& value, const Marks& marks) {
    Measurement found;
    read_object(value, found, {"kind", "points", "branches", "fraction", "fractions", "lesions", "shortest"});
    const std::string wanted = text(value.value("kind", json()), "kind of a measurement");
    const auto kind = paired(kMeasurementNames, wanted);
    if (!kind) throw Refusal{"unknown measurement \"" + wanted + "\""};
    found.kind = *kind;
    read_lesions_of(value, marks, found);
    const json points = value.value("points", json::array());
    const json branches = value.value("branches", json::array());
    // An angle of one branch is at its start; an angle of three is between places on them.
    if (found.kind == Measurement::Kind::kAngle && branches.is_array() && branches.size() == 3)
        found.places[1].branch = found.places[2].branch = 0;
    const std::size_t wants_points = point_count(found), wants_branches = place_count(found);
    if (!points.is_array() || points.size() != wants_points || !branches.is_array() ||
        branches.size() != wants_branches)
        throw Refusal{"a measurement of kind " + wanted + " has " + std::to_string(wants_points) + " points and " +
                      std::to_string(wants_branches) + " branches"};
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!points[i].is_array() || points[i].size() != 3) throw Refusal{"a point is not [x, y, z]"};
        for (int k = 0; k < 3; ++k)
            found.points[i][k] = number(points[i][static_cast<std::size_t>(k)], "coordinate of a point", -1e9, 1e9);
    }
    for (std::size_t i = 0; i < branches.size(); ++i)
        found.places[i].branch = integer(branches[i], "branch id of a measurement", 0, kMostBranches);
    if (value.contains("fraction")) found.places[0].fraction = number(value["fraction"], "fraction", 0.0, 1.0);
    if (!value.contains("fractions")) return found; // older files: between the middles of the branches
    const json& fractions = value["fractions"];
    if (!fractions.is_array() || fractions.size() != wants_branches)
        throw Refusal{"a measurement of kind " + wanted + " has as many fractions as branches"};
    for (std::size_t i = 0; i < fractions.size(); ++i)
        found.places[i].fraction = number(fractions[i], "fraction", 0.0, 1.0);
    return found;
}

namespace fs = std::filesystem;

fs::path written_path(const fs::path& tree, const fs::path& folder) {
    if (tree.empty()) return {};
    const fs::path relative =
        fs::absolute(tree).lexically_normal().lexically_relative(fs::absolute(folder).lexically_normal());
    return relative.empty() || *relative.begin() == ".." ? fs::absolute(tree).lexically_normal() : relative;
}

std::string units_in(const json& value) {
    std::string units = text(value, "units");
    if (!io::length_unit(units)) throw Refusal{"\"" + units + "\" is no unit of length"};
    return units;
}

std::string mesh_axes_in(const json& value) {
    std::string axes = text(value, "axes");
    if (!io::slicer_space(axes)) throw Refusal{"axes \"" + axes + "\" are neither LPS nor RAS"};
    return axes;
}

json label_json(const volume::LabelChoice& label) { return label.name.empty() ? json(label.number) : json(label.name); }

volume::LabelChoice label_in(const json& value) {
    if (value.is_string() && !value.get<std::string>().empty()) return volume::LabelChoice(value.get<std::string>());
    if (value.is_string()) throw Refusal{"a label has an empty name"};
    return integer(value, "label", std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
}

std::vector<volume::LabelChoice> labels_in(const json& object, const std::string& key) {
    std::vector<volume::LabelChoice> labels;
    for (const json& label : list_in(object, key)) labels.push_back(label_in(label));
    if (std::ranges::any_of(labels, &volume::LabelChoice::none))
        throw Refusal{key + " is not a list of names and whole numbers other than 0"};
    sort_unique(labels);
    return labels;
}

json comparison_json(const Comparison& comparison, const fs::path& folder) {
    json surfaces = json::array();
    for (const Compared kind : comparison.surfaces) surfaces.push_back(std::string(name_of(kind)));
    json value{{"mode", std::string(name_of(comparison.mode))}, {"surfaces", surfaces}, {"blend", comparison.blend}};
    if (comparison.wipe != Comparison{}.wipe) value["wipe"] = comparison.wipe;
    if (!comparison.mask.empty()) value["mask"] = written_path(comparison.mask, folder).string();
    if (!comparison.mask_units.empty()) value["mask_units"] = comparison.mask_units;
    for (const volume::LabelChoice& label : comparison.labels) value["labels"].push_back(label_json(label));
    return value;
}

Comparison comparison_in(const json& value, const fs::path& folder) {
    expect_only(value, "comparison", {"mode", "surfaces", "mask", "mask_units", "labels", "blend", "wipe"});
    Comparison comparison;
    if (value.contains("mode"))
        comparison.mode = word(value["mode"], "mode of the comparison", "comparison", comparison_mode_named);
    if (value.contains("surfaces")) {
        const auto surfaces = surface_list(joined(
            list_in(value, "surfaces"), ",", [](const json& name) { return text(name, "surface of the comparison"); }));
        if (!surfaces) throw Refusal{"surfaces is not a list of two or three of " + compared_names()};
        comparison.surfaces = *surfaces;
    }
    if (value.contains("mask"))
        comparison.mask = (folder / text(value["mask"], "path of the mask")).lexically_normal().string();
    if (value.contains("mask_units")) comparison.mask_units = units_in(value["mask_units"]);
    comparison.labels = labels_in(value, "labels");
    if (value.contains("blend")) comparison.blend = number(value["blend"], "blend", 0.0, 1.0);
    if (value.contains("wipe")) comparison.wipe = number(value["wipe"], "wipe", 0.0, 1.0);
    return comparison;
}

json deviation_json(const DeviationChoice& choice, const fs::path& folder) {
    using From = DeviationChoice::From;
    json value;
    if (choice.from == From::kFile)
        value["mesh"] = written_path(choice.file, folder).string();
    else
        value["from"] =
            std::string(name_of(choice.from == From::kCones ? Compared::kTruncatedCones : Compared::kIsosurface));
    if (choice.unit != DeviationChoice{}.unit) value["unit"] = std::string(name_of(choice.unit));
    if (choice.most > 0.0) value["most"] = choice.most;
    if (!choice.axes.empty()) value["axes"] = choice.axes;
    return value;
}

DeviationChoice deviation_in(const json& value, const fs::path& folder) {
    using From = DeviationChoice::From;
    expect_only(value, "deviation", {"from", "mesh", "unit", "most", "axes"});
    DeviationChoice choice;
    if (value.contains("mesh")) {
        choice.from = From::kFile;
        choice.file = (folder / text(value["mesh"], "mesh of the deviation")).lexically_normal().string();
    } else if (value.contains("from")) {
        choice.from = word(value["from"], "from", "surface", [](const std::string& name) -> std::optional<From> {
            if (name == name_of(Compared::kTruncatedCones)) return From::kCones;
            return name == name_of(Compared::kIsosurface) ? std::optional(From::kIsosurface) : std::nullopt;
        });
    }
    if (value.contains("unit")) choice.unit = word(value["unit"], "unit", "unit", deviation_unit_named);
    if (choice.unit == DeviationChoice::Unit::kVoxels && !may_count_voxels(choice.from))
        throw Refusal{"voxels are of an isosurface"};
    if (value.contains("most")) choice.most = number(value["most"], "most", kLeastDeviation, kMostDeviation);
    if (value.contains("axes")) choice.axes = mesh_axes_in(value["axes"]);
    return choice;
}

tree::System system_in(const json& value) {
    expect_only(value, "systems", {"name", "colour"});
    return {text(value.value("name", json()), "name of a system"),
            colour_from(value.value("colour", json()), "colour of a system")};
}

json context_json(const ContextItem& item, const fs::path& folder) {
    json value{{"path", written_path(item.file, folder).string()},
               {"colour", colour_text(item.colour)}, // these also where they are usual
               {"opacity", item.opacity},
               {"wireframe", item.wireframe},
               {"visible", item.visible}};
    if (!item.label.none()) value["label"] = label_json(item.label);
    if (item.isovalue) value["isovalue"] = *item.isovalue;
    if (item.exact) value["exact"] = true;
    if (!item.units.empty()) value["units"] = item.units;
    if (!item.axes.empty()) value["axes"] = item.axes;
    write_object(value, item);
    return value;
}

ContextItem context_in(const json& value, const fs::path& folder) {
    ContextItem item;
    read_object(value, item, {"path", "label", "isovalue", "wireframe", "exact", "units", "axes"});
    if (!value.contains("path")) throw Refusal{"a context mesh has no path"};
    item.file = (folder / text(value["path"], "path of a context mesh")).lexically_normal().string();
    if (value.contains("label")) item.label = label_in(value["label"]);
    if (value.contains("isovalue")) item.isovalue = number(value["isovalue"], "isovalue", -HUGE_VAL, HUGE_VAL);
    if (value.contains("wireframe")) item.wireframe = truth(value["wireframe"], "wireframe");
    if (value.contains("exact")) item.exact = truth(value["exact"], "exact");
    if (value.contains("units")) item.units = units_in(value["units"]);
    if (value.contains("axes")) item.axes = mesh_axes_in(value["axes"]);
    return item;
}

} // namespace ramus::app::session_json
