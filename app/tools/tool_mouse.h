// ToolMouse: the left button's presses, moves and releases over the picture, as a Tool is told of them: it tells
// double-clicks from two clicks. No clock of its own. Who tells the tool may do so later: `tell` gets what there is to
// be told.
#pragma once

#include "app/tools/tool.h"

namespace ramus::app {

class ToolMouse {
public:
    using Tell = std::function<void(Tool::Event, const Pointing&)>;
    void press(const Tell& tell, Pointing pointing, double seconds);
    void move(const Tell& tell, Pointing pointing) const;
    void release(const Tell& tell, Pointing pointing);
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
