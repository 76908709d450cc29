#include "app/session/beside_json.h"

#include "app/session/colour_text.h"
#include "app/session/json_values.h"

#include <limits>

namespace ramus::app::session_json {

namespace fs = std::filesystem;

fs::path written_path(const fs::path& tree, const fs::path& folder) {
    if (tree.empty()) return {};
    const fs::path relative =
        fs::absolute(tree).lexically_normal().lexically_relative(fs::absolute(folder).lexically_normal());
    return relative.empty() || *relative.begin() == ".." ? fs::absolute(tree).lexically_normal() : relative;
}

json comparison_json(const Comparison& comparison, const fs::path& folder) {
    json surfaces = json::array();
    for (const mesh::Method kind : comparison.surfaces) surfaces.push_back(std::string(name_of(kind)));
    json value{{"mode", std::string(name_of(comparison.mode))}, {"surfaces", surfaces}, {"blend", comparison.blend}};
    if (!comparison.mask.empty()) value["mask"] = written_path(comparison.mask, folder).string();
    if (!comparison.labels.empty()) value["labels"] = comparison.labels;
    return value;
}

Comparison comparison_in(const json& value, const fs::path& folder) {
    expect_only(value, "comparison", {"mode", "surfaces", "mask", "labels", "blend"});
    Comparison comparison;
    if (value.contains("mode")) {
        const std::string wanted = text(value["mode"], "mode of the comparison");
        const auto mode = comparison_mode_named(wanted);
        if (!mode) throw Refusal{"unknown comparison \"" + wanted + "\""};
        comparison.mode = *mode;
    }
    if (value.contains("surfaces")) {
        std::string list;
        for (const json& name : list_in(value, "surfaces"))
            list.append(list.empty() ? "" : ",").append(text(name, "surface of the comparison"));
        const auto surfaces = surface_list(list);
        if (!surfaces) throw Refusal{"surfaces is not a list of two or three of cs, cones, iso"};
        comparison.surfaces = *surfaces;
    }
    if (value.contains("mask"))
        comparison.mask = (folder / text(value["mask"], "path of the mask")).lexically_normal().string();
    std::string labels;
    for (const json& label : list_in(value, "labels")) labels.append(labels.empty() ? "" : ",").append(label.dump());
    if (!labels.empty()) {
        const auto found = label_list(labels);
        if (!found) throw Refusal{"labels is not a list of whole numbers other than 0"};
        comparison.labels = *found;
    }
    if (value.contains("blend")) comparison.blend = number(value["blend"], "blend", 0.0, 1.0);
    return comparison;
}

json context_json(const ContextItem& item, const fs::path& folder) {
    json value{{"path", written_path(item.file, folder).string()},
               {"colour", colour_text(item.colour)},
               {"opacity", item.opacity},
               {"wireframe", item.wireframe},
               {"visible", item.visible}};
    if (item.label != 0) value["label"] = item.label;
    if (item.exact) value["exact"] = true;
    return value;
}

ContextItem context_item(const json& value, const fs::path& folder) {
    expect_only(value, "context", {"path", "label", "colour", "opacity", "wireframe", "visible", "exact"});
    ContextItem item;
    if (!value.contains("path")) throw Refusal{"a context mesh has no path"};
    item.file = (folder / text(value["path"], "path of a context mesh")).lexically_normal().string();
    if (value.contains("label"))
        item.label = integer(value["label"], "label", std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
    if (value.contains("opacity")) item.opacity = number(value["opacity"], "opacity", 0.0, 1.0);
    if (value.contains("wireframe")) item.wireframe = truth(value["wireframe"], "wireframe");
    if (value.contains("exact")) item.exact = truth(value["exact"], "exact");
    if (value.contains("visible")) item.visible = truth(value["visible"], "visible");
    if (value.contains("colour")) {
        const auto colour = colour_in(text(value["colour"], "colour"));
        if (!colour) throw Refusal{"\"" + value["colour"].get<std::string>() + "\" is not a colour: #RRGGBB"};
        item.colour = *colour;
    }
    return item;
}

} // namespace ramus::app::session_json
