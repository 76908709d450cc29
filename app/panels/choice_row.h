// Rows of a panel with a label and one control.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app::widgets {

// Draws the label; the next item fills the row. End with ImGui::PopID().
void begin_row(const char* label, const char* help, float width = -1.0F);

// A drop-down list of values and their labels; returns the value that was chosen.
[[nodiscard]] std::optional<std::string> choice_row(const char* label, const char* help, const std::string& now,
                                                    const std::vector<std::pair<std::string, std::string>>& entries);

// Choice of RAS or LPS for a mesh whose file does not state its axes; returns the new choice. `asked`: the current
// choice; empty: none.
[[nodiscard]] std::optional<std::string> mesh_axes_row(const std::string& asked);

} // namespace ramus::app::widgets
