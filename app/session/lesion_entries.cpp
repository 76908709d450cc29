#include "app/session/lesion_entries.h"

#include "app/session/json_values.h"
#include "app/session/marks_json.h"

#include <limits>
#include <utility>

namespace ramus::app::session_json {

namespace fs = std::filesystem;

namespace {

void write_part(json& value, const Lesion& lesion) {
    value["part"] = lesion.part;
    for (const volume::LabelChoice& label : lesion.labels) value["labels"].push_back(label_json(label));
    if (!lesion.units.empty()) value["units"] = lesion.units;
}

void read_part(const json& value, Lesion& lesion) {
    lesion.labels = labels_in(value, "labels");
    if (value.contains("units")) lesion.units = units_in(value["units"]);
    if (value.contains("part")) lesion.part = integer(value["part"], "part", 1, std::numeric_limits<int>::max());
    if (!lesion.of_mask() && (value.contains("labels") || value.contains("units")))
        throw Refusal{"labels and units are of a lesion that is a part of a mask"};
    if (lesion.of_mask() && !lesion.axes.empty()) throw Refusal{"a mask states its axes itself"};
}

} // namespace

MarksEntry spheres_entry() {
    return {"lesions",
            [](const Marks& marks, const fs::path&) {
                json list = json::array();
                for (const Lesion& lesion : marks.lesions)
                    if (!lesion.is_mesh()) list.push_back(with_object_keys(json(lesion.sphere), "sphere", lesion));
                return list;
            },
            [](const json& value, const fs::path&, Marks& marks) {
                if (!value.is_array()) throw Refusal{"lesions is not a list"};
                for (const json& element : value) {
                    Lesion lesion;
                    if (element.is_object()) read_object(element, lesion, {"sphere"});
                    const json& sphere =
                        element.is_object() && element.contains("sphere") ? element["sphere"] : element;
                    if (!sphere.is_array() || sphere.size() != 4) throw Refusal{"a lesion is not [x, y, z, radius]"};
                    for (std::size_t i = 0; i < 4; ++i)
                        lesion.sphere[i] = session_json::number(sphere[i], "lesion", i == 3 ? 0.0 : -1e9, 1e9);
                    add_lesion(marks, std::move(lesion));
                }
                number_objects(marks); // measurements refer to lesions by id
            }};
}

MarksEntry lesion_meshes_entry() {
    return {"lesion_meshes",
            [](const Marks& marks, const fs::path& folder) {
                json list = json::array();
                for (const Lesion& lesion : marks.lesions) {
                    if (!lesion.is_mesh()) continue;
                    json mesh = with_object_keys(json(written_path(lesion.file, folder).string()), "path", lesion);
                    if (mesh.is_string() && (!lesion.axes.empty() || lesion.of_mask())) mesh = {{"path", mesh}};
                    if (!lesion.axes.empty()) mesh["axes"] = lesion.axes;
                    if (lesion.of_mask()) write_part(mesh, lesion);
                    list.push_back(std::move(mesh));
                }
                return list;
            },
            [](const json& value, const fs::path& folder, Marks& marks) {
                if (!value.is_array()) throw Refusal{"lesion_meshes is not a list"};
                for (const json& element : value) {
                    Lesion lesion;
                    if (element.is_object()) read_object(element, lesion, {"path", "axes", "labels", "units", "part"});
                    const json& path = element.is_object() && element.contains("path") ? element["path"] : element;
                    lesion.file = (folder / text(path, "path of a lesion")).lexically_normal().string();
                    if (element.is_object() && element.contains("axes")) lesion.axes = mesh_axes_in(element["axes"]);
                    if (element.is_object()) read_part(element, lesion);
                    add_lesion(marks, std::move(lesion));
                }
                number_objects(marks);
            }};
}

} // namespace ramus::app::session_json
