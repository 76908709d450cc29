// Rows of the planning page of the side panel.
#pragma once

#include "app/panels/interface.h"

#include <imgui.h>
#include <string>
#include <vector>

namespace ramus::app {

namespace plan_rows {

[[nodiscard]] std::string branch_name(const Document& document, int branch);

// A clickable line with a value and a cross at its right end. Returns 1 for the line, -1 for the cross, otherwise 0.
[[nodiscard]] int removable_row(const std::string& text, const ImVec4& colour, const char* help,
                                const std::string& value = {});
// The same for an object of the scene, with an eye that toggles visibility. Shows the object's name, or `what`. Handles
// hiding, removing and renaming (double click); returns whether the line was clicked.
struct RowWords {
    std::string what;
    std::string help;
    std::string value{};
    bool trouble = false; // shown as an error
};
bool object_row(InterfaceContext& context, const std::string& kind, std::size_t index, bool visible,
                const RowWords& words);
template <SceneObject T>
bool object_row(InterfaceContext& context, const T& object, std::size_t index, RowWords words) {
    if (!object.name.empty()) words.what = object.name;
    return object_row(context, std::string(T::kNoun), index, object.visible, words);
}
// Only the eye.
void object_eye(InterfaceContext& context, const std::string& kind, std::size_t index, bool visible);

// A field for one or several numbers at the right edge, or `before_right` points left of it. Returns the input once it
// was entered, otherwise nothing.
[[nodiscard]] std::vector<std::string> number_field(InterfaceContext& context, const char* id,
                                                    const std::string& current, float width, float before_right = 0.0F);
void field_label(const InterfaceContext& context, const char* label);

void go_to(InterfaceContext& context, int branch); // selects the branch and moves the camera to it

} // namespace plan_rows
} // namespace ramus::app
