// The tools that there are, in the order of menu and buttons. A new one is one more entry in tool_kinds.cpp; its menu
// entry, key, button and the argument of the command `tool` follow from that.
#pragma once

#include "app/tools/tool.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

struct ToolKind {
    std::string name;  // "lasso", as the command `tool` takes it
    std::string label; // in the menu
    std::string help;  // one sentence
    std::vector<std::string> keys;
    std::vector<std::vector<glm::vec2>> icon;  // strokes in a unit square, y downward
    std::unique_ptr<Tool> (*make)() = nullptr; // null: no tool, the mouse turns the view
};

inline constexpr std::string_view kNavigate = "navigate";

[[nodiscard]] const std::vector<ToolKind>& tool_kinds(); // the first is kNavigate
[[nodiscard]] const ToolKind* find_tool(std::string_view name);

} // namespace ramus::app
