// Rows of the planning page of the side panel.
#pragma once

#include "app/panels/interface.h"
#include "app/picture/scene_objects.h"

#include <cstddef>
#include <imgui.h>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace ramus::app {

namespace plan_rows {

[[nodiscard]] std::string branch_name(const Document& document, int branch);

// A clickable line with a value and a cross at its right end. Returns 1 for the line, -1 for the cross, otherwise 0.
[[nodiscard]] int removable_row(const std::string& text, const ImVec4& colour, const char* help,
                                const std::string& value = {});
// What a row shows of an object of the scene, whatever its kind.
struct ObjectRow {
    std::string_view kind;
    std::size_t index;
    bool visible;
    Rgb colour;
    std::optional<double> opacity; // of surfaces
    ObjectWords words;
    bool has_colour = true; // false: a scan in grey
};
template <SceneObject T> ObjectRow row_of(InterfaceContext& context, const T& object, std::size_t index) {
    ObjectRow row{T::kNoun,
                  index,
                  object.visible,
                  object.colour,
                  {},
                  words_of(object, index, context.workspace.current_assets(), context.workspace.document().lengths())};
    if constexpr (SurfaceObject<T>) row.opacity = object.opacity;
    if constexpr (std::is_same_v<T, Scan>) row.has_colour = object.labels;
    return row;
}
// The left of a row: an eye that shows and hides the object, and a swatch for its colour.
void object_controls(InterfaceContext& context, const ObjectRow& row);
// A whole row: controls, title, value, cross. A click brings the object into the middle of the picture, a double click
// names it.
void object_row(InterfaceContext& context, const ObjectRow& row);
// A line with a slider for the opacity of a surface.
void object_opacity(InterfaceContext& context, const ObjectRow& row);

// A field for one or several numbers at the right edge, or `before_right` points left of it. Returns the input once it
// was entered, otherwise nothing.
[[nodiscard]] std::vector<std::string> number_field(InterfaceContext& context, const char* id,
                                                    const std::string& current, float width, float before_right = 0.0F);
void field_label(const InterfaceContext& context, const char* label);

void go_to(InterfaceContext& context, int branch); // selects the branch and moves the camera to it

} // namespace plan_rows
} // namespace ramus::app
