// Rows of a panel with a label and, beside it, one control.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app::widgets {

// The label; the next item fills the row. ImGui::PopID() ends it.
void begin_row(const char* label, const char* help, float width = -1.0F);

// A list to choose from, of values and their words; returns the value that was chosen.
[[nodiscard]] std::optional<std::string> choice_row(const char* label, const char* help, const std::string& now,
                                                    const std::vector<std::pair<std::string, std::string>>& entries);

// RAS or LPS, of a mesh whose file does not state its axes; returns the ones that were chosen. `asked`: what somebody
// has said of them so far; empty: nothing.
[[nodiscard]] std::optional<std::string> mesh_axes_row(const std::string& asked);

} // namespace ramus::app::widgets
