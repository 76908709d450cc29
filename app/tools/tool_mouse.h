// ToolMouse: converts presses, moves and releases of the left button into events of a Tool, and detects double-clicks.
// Time is passed in. The `tell` function receives the events and may deliver them to the tool later.
#pragma once

#include "app/tools/tool.h"

namespace ramus::app {

class ToolMouse {
public:
    using Tell = std::function<void(Tool::Event, const Pointing&)>;
    void press(const Tell& tell, Pointing pointing, double seconds);
    void move(const Tell& tell, Pointing pointing) const;
    void release(const Tell& tell, Pointing pointing);
    void abandon() { held_ = false; } // another tool was selected
    [[nodiscard]] bool held() const { return held_; }
    [[nodiscard]] Modifiers modifiers() const { return modifiers_; }

private:
    bool held_ = false;
    Modifiers modifiers_; // of the press
    double last_seconds_ = -1e9;
    glm::dvec2 last_at_{0.0};
};

} // namespace ramus::app
