#include "app/tools/tool_mouse.h"

#include <glm/geometric.hpp>

namespace ramus::app {

void ToolMouse::press(const Tell& tell, Pointing pointing, double seconds) {
    held_ = pointing.held = true;
    modifiers_ = pointing.modifiers;
    const bool second = seconds - last_seconds_ < ViewportMouse::kDoubleClickSeconds &&
                        glm::distance(pointing.at, last_at_) < ViewportMouse::kDragThreshold * pointing.pixel_ratio;
    last_seconds_ = second ? -1e9 : seconds; // a third click starts a new sequence
    last_at_ = pointing.at;
    tell(second ? &Tool::double_click : &Tool::press, pointing);
}

void ToolMouse::move(const Tell& tell, Pointing pointing) const {
    pointing.held = held_;
    pointing.modifiers = modifiers_;
    tell(&Tool::move, pointing);
}

void ToolMouse::release(const Tell& tell, Pointing pointing) {
    if (!held_) return;
    held_ = false;
    pointing.held = false;
    pointing.modifiers = modifiers_;
    tell(&Tool::release, pointing);
}

} // namespace ramus::app
