// The table of tools, in the order of menu and buttons. To add a tool, add an entry in tool_kinds.cpp; its menu entry,
// key, button and the argument of the command `tool` follow from it.
#pragma once

#include "app/tools/tool.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

struct ToolKind {
    std::string name;  // "lasso", the argument of the command `tool`
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
