#include "app/tools/viewport_mouse.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace ramus::app {

void ViewportMouse::press(MouseButton button, Modifiers modifiers, glm::dvec2 at, const Grip& grip) {
    if (held_) return; // one button at a time: the first one decides
    held_ = button;
    modifiers_ = modifiers;
    grip_ = grip;
    pressed_at_ = last_ = at;
    dragging_ = false;
}

std::optional<Click> ViewportMouse::release(MouseButton button, glm::dvec2 at, double seconds) {
    if (held_ != button) return {};
    held_.reset();
    if (dragging_ || button == MouseButton::kMiddle) return {};
    if (button == MouseButton::kRight) return Click{Click::Kind::kSecondary, at};
    // Only plain clicks make a double-click: a quick Alt+click after a click still takes all that depends on it.
    const bool plain = !modifiers_.alt && !modifiers_.ctrl && !modifiers_.shift;
    const bool second = plain && seconds - last_click_seconds_ < kDoubleClickSeconds &&
                        glm::distance(at, last_click_at_) < kDragThreshold * pixel_ratio_;
    last_click_seconds_ = plain && !second ? seconds : -1e9; // a third click starts a new sequence
    last_click_at_ = at;
    if (second) return Click{Click::Kind::kCentre, at};
    if (modifiers_.alt || (modifiers_.ctrl && modifiers_.shift)) return Click{Click::Kind::kSelectWithDependents, at};
    if (modifiers_.ctrl) return Click{Click::Kind::kToggle, at};
    if (modifiers_.shift) return Click{Click::Kind::kAdd, at};
    return Click{Click::Kind::kSelect, at};
}

std::optional<render::Camera> ViewportMouse::move(const render::Camera& camera, glm::ivec2 size, glm::dvec2 to) {
    if (!held_ || to == last_) return {};
    if (!dragging_) {
        if (glm::distance(to, pressed_at_) < kDragThreshold * pixel_ratio_) return {};
        dragging_ = true;
    }
    const glm::dvec2 from = last_;
    last_ = to;
    if (*held_ == MouseButton::kRight)
        return render::zoomed_about(camera, grip_.goal, render::zoom_of_drag(size, from, to), grip_.least_mm);
    if (*held_ == MouseButton::kMiddle || modifiers_.shift) return render::panned(camera, size, grip_.about, from, to);
    return render::rotated(camera, size, grip_.about, from, to);
}

render::Camera ViewportMouse::wheel(const render::Camera& camera, const Grip& grip, double notches) {
    return render::zoomed_about(camera, grip.goal, std::pow(kWheelStep, notches), grip.least_mm);
}

} // namespace ramus::app
