#include "app/tools/slice_mouse.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace ramus::app {

namespace {

constexpr double kLeastZoom = 0.2, kMostZoom = 200.0;

// The place under the pointer. A grid counts from the middle of its first pixel.
glm::dvec3 place_at(const slice::PixelGrid& grid, glm::dvec2 at) { return grid.place(at - 0.5); }

} // namespace

SliceChange SliceMouse::press(MouseButton button, Modifiers modifiers, glm::dvec2 at, const SliceGrip& grip) {
    if (held_) return {};
    held_ = button;
    modifiers_ = modifiers;
    grip_ = grip;
    pressed_at_ = at;
    dragging_ = false;
    if (button != MouseButton::kLeft || modifiers.shift) return {};
    if (grip.along) return move_along(at);
    return {.crosshair = place_at(grip.grid, at)};
}

bool SliceMouse::twice(MouseButton button, Modifiers modifiers, glm::dvec2 at, double seconds) {
    const bool plain = button == MouseButton::kLeft && !modifiers.ctrl && !modifiers.shift && !modifiers.alt;
    const bool second = plain && !held_ && seconds - last_press_seconds_ < ViewportMouse::kDoubleClickSeconds &&
                        glm::distance(at, last_press_at_) < ViewportMouse::kDragThreshold * pixel_ratio_;
    last_press_seconds_ = plain && !second ? seconds : -1e9; // a third click starts a new sequence
    last_press_at_ = at;
    return second;
}

SliceChange SliceMouse::move_along(glm::dvec2 at) const {
    if (modifiers_.shift || *held_ == MouseButton::kMiddle) {
        constexpr double kDegrees = 0.5; // tuned: for a point across
        const double turned = grip_.along->angle_deg + kDegrees * (at.x - pressed_at_.x) / pixel_ratio_;
        return {.angle_deg = std::remainder(turned, 360.0)};
    }
    const auto place = grip_.along->place_at(at - 0.5);
    return {.along_mm = place ? std::optional(place->arc_mm) : std::nullopt};
}

SliceChange SliceMouse::move(glm::dvec2 at) {
    if (!held_) return {};
    const glm::dvec2 by = (at - pressed_at_) / pixel_ratio_;
    dragging_ |= glm::length(by) >= ViewportMouse::kDragThreshold;
    if (*held_ == MouseButton::kLeft && !modifiers_.shift)
        return grip_.along ? move_along(at) : SliceChange{.crosshair = place_at(grip_.grid, at)};
    if (!dragging_) return {};
    if (grip_.along && *held_ != MouseButton::kRight) return move_along(at);
    if (*held_ == MouseButton::kRight) {
        if (!grip_.window) return {};
        // Tuned: 200 points across make the window 2.7 times as wide; 200 points up move it by 0.8 widths.
        constexpr double kWider = 0.005;
        constexpr double kHigher = 0.004;
        slice::Window window = *grip_.window;
        window.level -= kHigher * by.y * window.width;
        window.width *= std::exp(kWider * by.x);
        return {.window = window};
    }
    SliceZoom zoom = grip_.zoom;
    zoom.shift -= (at - pressed_at_) * glm::dvec2(glm::length(grip_.grid.right), glm::length(grip_.grid.down));
    return {.zoom = zoom};
}

std::optional<Click> SliceMouse::release(MouseButton button, glm::dvec2 at) {
    if (held_ != button) return {};
    held_.reset();
    if (dragging_ || button == MouseButton::kMiddle) return {};
    if (button == MouseButton::kRight) return Click{Click::Kind::kSecondary, at};
    if (modifiers_.shift) return Click{Click::Kind::kAdd, at};
    if (modifiers_.alt) return Click{Click::Kind::kSelectWithDependents, at};
    return Click{modifiers_.ctrl ? Click::Kind::kToggle : Click::Kind::kSelect, at};
}

SliceZoom SliceMouse::zoomed(const SliceGrip& grip, glm::dvec2 at, double notches) {
    SliceZoom zoom = grip.zoom;
    zoom.factor = std::clamp(zoom.factor * std::pow(ViewportMouse::kWheelStep, notches), kLeastZoom, kMostZoom);
    // The place under the pointer keeps its pixel.
    const glm::dvec2 from_middle = at - 0.5 * glm::dvec2(grip.grid.size);
    const double mm = glm::length(grip.grid.right);
    zoom.shift += mm * from_middle * (1.0 - grip.zoom.factor / zoom.factor);
    return zoom;
}

} // namespace ramus::app
