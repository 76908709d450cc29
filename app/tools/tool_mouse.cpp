#include "app/tools/tool_mouse.h"

#include <glm/geometric.hpp>

namespace ramus::app {

void ToolMouse::press(Tool& tool, Pointing pointing, double seconds) {
    held_ = pointing.held = true;
    modifiers_ = pointing.modifiers;
    const bool second = seconds - last_seconds_ < ViewportMouse::kDoubleClickSeconds &&
                        glm::distance(pointing.at, last_at_) < ViewportMouse::kDragThreshold * pointing.pixel_ratio;
    last_seconds_ = second ? -1e9 : seconds; // a third click begins anew
    last_at_ = pointing.at;
    second ? tool.double_click(pointing) : tool.press(pointing);
}

void ToolMouse::move(Tool& tool, Pointing pointing) const {
    pointing.held = held_;
    pointing.modifiers = modifiers_;
    tool.move(pointing);
}

void ToolMouse::release(Tool& tool, Pointing pointing) {
    if (!held_) return;
    held_ = false;
    pointing.held = false;
    pointing.modifiers = modifiers_;
    tool.release(pointing);
}

} // namespace ramus::app
