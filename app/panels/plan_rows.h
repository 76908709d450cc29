// Rows of the planning page.
#pragma once

#include "app/panels/interface.h"

#include <imgui.h>
#include <string>
#include <vector>

namespace ramus::app {

namespace plan_rows {

[[nodiscard]] std::string branch_name(const Document& document, int branch);

// A line that can be clicked, with a value and a cross at its right end. Returns 1 for the line, -1 for the cross, 0
// else.
[[nodiscard]] int removable_row(const std::string& text, const ImVec4& colour, const char* help,
                                const std::string& value = {});
// The same for an object of the scene, behind an eye that shows and hides it. Shown is the object's name, or `what`
// where it has none. Hiding, removing and, by a double click, naming are done here; returns whether the line was
// clicked.
struct RowWords {
    std::string what;
    std::string help;
    std::string value{};
    bool trouble = false; // there is something wrong with it
};
bool object_row(InterfaceContext& context, const std::string& kind, std::size_t index, bool visible,
                const RowWords& words);
template <SceneObject T>
bool object_row(InterfaceContext& context, const T& object, std::size_t index, RowWords words) {
    if (!object.name.empty()) words.what = object.name;
    return object_row(context, std::string(T::kNoun), index, object.visible, words);
}
// The eye alone.
void object_eye(InterfaceContext& context, const std::string& kind, std::size_t index, bool visible);

// A field for a number or several at the right edge, or where `before_right` points are left of it. Returns what was
// entered, else nothing.
[[nodiscard]] std::vector<std::string> number_field(InterfaceContext& context, const char* id,
                                                    const std::string& current, float width, float before_right = 0.0F);
void field_label(const InterfaceContext& context, const char* label);

void go_to(InterfaceContext& context, int branch); // selects it and looks at it

} // namespace plan_rows
} // namespace ramus::app
