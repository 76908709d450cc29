// Widgets shared by the panels, so that they align and look alike.
#pragma once

#include "app/panels/theme.h"

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <imgui.h>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ramus::app::widgets {

// Begins a window at a fixed position without title and border. End with ImGui::End().
void begin_fixed(const char* name, float x, float y, float width, float height, ImGuiWindowFlags flags = 0);
// Begins a modal dialog in the middle of the window. False: ImGui does not show it yet, or another dialog was begun in
// this frame; of several open dialogs the first one drawn is shown.
[[nodiscard]] bool begin_dialog(const char* name, float width, float height);
void end_dialog();

void heading(const char* text);
void rule();                     // a horizontal line between parts of a panel
void section(const char* title); // a rule with the title of the next part
bool small_button(const char* text, const char* help);
bool button(const char* text, const ImVec2& size, const ImVec4& ground, const ImVec4& words = theme::kText);
struct TitleButton {
    const char *text, *help, *command;
    std::vector<std::string> words{}; // arguments of the command
};
// Like section(), with buttons at the right end. Returns the button that was pressed. `closed`: a click on the title
// changes it; null: the section is always open.
std::optional<TitleButton> title_row(const char* title, std::initializer_list<TitleButton> buttons,
                                     bool* closed = nullptr);
// A label and a right-aligned value.
void fact(const char* label, const std::string& value);
void quiet(const char* text);              // one line in the label colour
void quiet_right(const std::string& text); // the same, right-aligned
void text_right(const std::string& text);  // right-aligned, in the value colour
// A label and a value that can be pressed for details.
bool fact_button(const char* label, const std::string& found, const ImVec4& colour, const char* help, const char* key);
// A list of facts; two consecutive short ones share a line. `draw` draws the fact in the given width; empty: fact().
struct Fact {
    const char* label;
    std::string value;
    std::function<void()> draw{};
};
void facts(const std::vector<Fact>& all);
[[nodiscard]] std::string percent_text(float share);
void quiet_wrapped(const char* text); // several lines
void trouble(const char* text);       // several lines in the error colour
// A label and a drop-down list, `width` points wide; returns the index of the chosen entry. `help`: of the list.
struct ListEntry {
    std::string label, help;
    bool possible = true;
};
[[nodiscard]] std::size_t list_row(const char* label, const char* help, float width,
                                   const std::vector<ListEntry>& entries, std::size_t chosen);
// Moves the cursor so that an item of `width` ends at the right edge.
void align_right(float width);
// Position of a tooltip: next to its item, or next to the menu that contains the item.
enum class TooltipAt : std::uint8_t { kItem, kMenu };
void tooltip(const char* text, const char* key = nullptr, TooltipAt at = TooltipAt::kItem);

// Positions of a frame's controls (x, y, width, height in pixels of the window) by their help text, for scripts that
// drive the window from outside.
using Controls = std::map<std::string, std::array<int, 4>>;
// Records controls into this map from now on; null: stops.
void note_controls(Controls* controls);
// Records a control. Items with tooltips are recorded automatically; of several with the same text, the last.
void note(const char* words, const ImVec2& from, const ImVec2& to);
void note_item(const char* words); // records the last item

// Calls row(n) for the visible rows of `count`; `height`: of each row; negative: that of the first.
template <class Row> void clipped(std::size_t count, const Row& row, float height = -1.0F) {
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(count), height);
    while (clipper.Step())
        for (int n = clipper.DisplayStart; n < clipper.DisplayEnd; ++n) row(static_cast<std::size_t>(n));
}

// The heading of the current table column, shortened if necessary. `help` has the full text with the unit. `arrow`:
// pixels to leave free at the right.
enum class HeadingAt : std::uint8_t { kLeft, kRight };
void column_heading(const char* text, const std::string& help, HeadingAt at = HeadingAt::kLeft, float arrow = 0.0F);
// Headings over rows outside a table: `left` begins at the cursor, `right` ends `before_right` pixels before the right
// edge.
struct RowHeading {
    const char* text;
    const char* help;
};
void row_headings(const RowHeading& left, const RowHeading& right, float before_right = 0.0F);

// The list of a panel over the picture, in small text: as high as its rows, at most `most_rows` and down to `bottom`;
// it scrolls beyond that.
struct ListColumn {
    const char* heading;
    float share;      // of the width
    const char* help; // full text of the heading, with the unit
};
struct ListTable {
    const char* id;
    std::span<const ListColumn> columns;
    std::size_t most_rows;
    float bottom; // lower end of the space, in screen pixels
};
// False: invisible; do not call end_list().
[[nodiscard]] bool begin_list(const ListTable& table, std::size_t rows);
void end_list();

// A square patch of colour in a line of text whose upper left corner is `at`, for lists that explain a picture.
void patch(const ImVec2& at, const glm::vec3& colour);

// Converts to ImGui's packed colours.
[[nodiscard]] inline ImU32 packed(const glm::vec4& colour) {
    return ImGui::ColorConvertFloat4ToU32({colour.x, colour.y, colour.z, colour.w});
}

// `text` shortened in the middle to fit `width`.
[[nodiscard]] std::string fitted(const std::string& text, float width);

} // namespace ramus::app::widgets
