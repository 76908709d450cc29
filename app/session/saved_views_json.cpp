#include "app/session/saved_views_json.h"

#include "app/session/json_values.h"

namespace ramus::app::session_json {

namespace fs = std::filesystem;

namespace {

SavedView saved_view_in(const json& value) {
    expect_only(value, "a saved view", {"name", "camera"});
    if (!value.contains("name")) throw Refusal{"a saved view has no name"};
    SavedView view{text(value["name"], "name of a saved view"), {}};
    if (const auto good = check_view_name(view.name); !good) throw Refusal{good.error().what};
    if (!value.contains("camera")) throw Refusal{"the saved view \"" + view.name + "\" has no camera"};
    const auto camera = render::camera_from_json(value["camera"], {});
    if (!camera) throw Refusal{"saved view \"" + view.name + "\": " + camera.error().what};
    view.camera = *camera;
    return view;
}

} // namespace

MarksEntry saved_views_entry() {
    return {"views",
            [](const Marks& marks, const fs::path&) {
                json list; // null without views: older programs know nothing of them
                for (const SavedView& view : marks.views)
                    list.push_back({{"name", view.name}, {"camera", render::to_json(view.camera)}});
                return list;
            },
            [](const json& value, const fs::path&, Marks& marks) {
                if (!value.is_array()) throw Refusal{"views is not a list"};
                for (const json& element : value) {
                    SavedView view = saved_view_in(element);
                    if (has_view(marks.views, view.name))
                        throw Refusal{"two saved views have the name \"" + view.name + "\""};
                    marks.views.push_back(std::move(view));
                }
            }};
}

} // namespace ramus::app::session_json
