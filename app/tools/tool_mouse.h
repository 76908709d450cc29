// ToolMouse: the left button's presses, moves and releases over the picture, as a Tool is told of them: it tells
// double-clicks from two clicks. No clock of its own.
#pragma once

#include "app/tools/tool.h"

namespace ramus::app {

class ToolMouse {
public:
    void press(Tool& tool, Pointing pointing, double seconds);
    void move(Tool& tool, Pointing pointing) const;
    void release(Tool& tool, Pointing pointing);
    void abandon() { held_ = false; } // another tool was taken
    [[nodiscard]] bool held() const { return held_; }
    [[nodiscard]] Modifiers modifiers() const { return modifiers_; }

private:
    bool held_ = false;
    Modifiers modifiers_; // of the press
    double last_seconds_ = -1e9;
    glm::dvec2 last_at_{0.0};
};

} // namespace ramus::app
