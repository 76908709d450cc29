// The few widgets that the panels share, so that they align and look alike.
#pragma once

#include "app/panels/theme.h"

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec4.hpp>
#include <imgui.h>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ramus::app::widgets {

// A window at a fixed position, without title, border, or a way to move it. End with ImGui::End().
void begin_fixed(const char* name, float x, float y, float width, float height, ImGuiWindowFlags flags = 0);
// A dialog in the middle of the window, dimming what lies behind. Returns false when ImGui does not show it yet, and
// when another one was begun in this frame: of several that are open, the one that is drawn first is shown.
[[nodiscard]] bool begin_dialog(const char* name, float width, float height);
void end_dialog();

void heading(const char* text);
void rule();                     // a line across a panel, between its parts
void section(const char* title); // the same, and the title of what follows
bool small_button(const char* text, const char* help);
bool button(const char* text, const ImVec2& size, const ImVec4& ground, const ImVec4& words = theme::kText);
struct TitleButton {
    const char *text, *help, *command;
    std::vector<std::string> words{}; // of the command
};
// The same as section(), with buttons at its right end. Returns the one that was pressed.
std::optional<TitleButton> title_row(const char* title, std::initializer_list<TitleButton> buttons);
// A label and its value, values aligned at the right edge.
void fact(const char* label, const std::string& value);
void quiet(const char* text);              // one line in the colour of labels
void quiet_right(const std::string& text); // the same, at the right edge
void text_right(const std::string& text);  // there, in the colour of values
// A label and what is found of it, which is pressed to see more.
bool fact_button(const char* label, const std::string& found, const ImVec4& colour, const char* help, const char* key);
// Facts one below the other; two that follow each other and are short share a line. `draw` draws the fact, with a width
// that its line leaves to it; null: fact().
struct Fact {
    const char* label;
    std::string value;
    std::function<void()> draw{};
};
void facts(const std::vector<Fact>& all);
[[nodiscard]] std::string percent_text(float share);
void quiet_wrapped(const char* text); // several lines
void trouble(const char* text);       // several lines in the colour of what went wrong
// A label, and beside it a list of what may be chosen, `width` points wide; returns the index of what is. `help`
// explains the list.
struct ListEntry {
    std::string label, help;
    bool possible = true;
};
[[nodiscard]] std::size_t list_row(const char* label, const char* help, float width,
                                   const std::vector<ListEntry>& entries, std::size_t chosen);
// Puts the cursor so that `width` ends at the right edge.
void align_right(float width);
// Where a tooltip stands: next to its item, or next to the menu that the item is an entry of.
enum class TooltipAt : std::uint8_t { kItem, kMenu };
void tooltip(const char* text, const char* key = nullptr, TooltipAt at = TooltipAt::kItem);

// Where the controls of a frame are, in pixels of the window, by the words that explain them: x, y, width, height. For
// scripts that drive the window from outside.
using Controls = std::map<std::string, std::array<int, 4>>;
// From now on they are noted there; null: nowhere.
void note_controls(Controls* controls);
// What has a tooltip is noted by itself, the last of several with the same words.
void note(const char* words, const ImVec2& from, const ImVec2& to);
void note_item(const char* words); // the last one drawn

// Calls row(n) for those of `count` rows that can be seen; `height`: of each, else that of the first.
template <class Row> void clipped(std::size_t count, const Row& row, float height = -1.0F) {
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(count), height);
    while (clipper.Step())
        for (int n = clipper.DisplayStart; n < clipper.DisplayEnd; ++n) row(static_cast<std::size_t>(n));
}

// The heading of the column of a table whose cell is the current one, shortened where there is no room for it. `help`
// has the whole words, with the unit. `arrow`: room that is left at the right, in pixels.
enum class HeadingAt : std::uint8_t { kLeft, kRight };
void column_heading(const char* text, const std::string& help, HeadingAt at = HeadingAt::kLeft, float arrow = 0.0F);
// Headings over rows that are no table: `left` begins at the cursor, `right` ends so many pixels before the right edge.
struct RowHeading {
    const char* text;
    const char* help;
};
void row_headings(const RowHeading& left, const RowHeading& right, float before_right = 0.0F);

// The list of a panel over the picture, in small letters: as high as its rows, but for what is beyond `most_rows` or
// `bottom`, to which it scrolls.
struct ListColumn {
    const char* heading;
    float share;      // of the width
    const char* help; // the heading in whole words, with the unit
};
struct ListTable {
    const char* id;
    std::span<const ListColumn> columns;
    std::size_t most_rows;
    float bottom; // of the room there is, on the screen
};
// False: it is not seen, and has no end.
[[nodiscard]] bool begin_list(const ListTable& table, std::size_t rows);
void end_list();

// As ImGui's lists of lines and boxes take colours.
[[nodiscard]] inline ImU32 packed(const glm::vec4& colour) {
    return ImGui::ColorConvertFloat4ToU32({colour.x, colour.y, colour.z, colour.w});
}

// `text` shortened in the middle to fit `width`.
[[nodiscard]] std::string fitted(const std::string& text, float width);

} // namespace ramus::app::widgets
