// ViewportMouse: presses, moves and releases of the mouse over the picture become camera changes and clicks, as in 3D
// Slicer: left-drag rotates, middle-drag or Shift+left-drag pans, right-drag or the wheel zooms. Each is about the
// point that a grip has (app/tools/aim.h says which). A drag is never a click: it begins when the pointer has moved
// kDragThreshold. No window, no picking, no clock of its own.
#pragma once

#include "render/scene/camera_moves.h"

#include <optional>

namespace ramus::app {

enum class MouseButton { kLeft, kMiddle, kRight };

struct Modifiers {
    bool ctrl = false, shift = false, alt = false;
};

struct Click {
    enum class Kind {
        kSelect,               // the branch, or nothing on the background
        kSelectWithDependents, // Alt; Ctrl+Shift, since many window managers take Alt for themselves
        kToggle,               // Ctrl
        kAdd,                  // Shift; a drag with it pans
        kCentre,               // the second click of a double-click
        kSecondary,            // the right button
    };
    Kind kind;
    glm::dvec2 at;
};

// What drags hold on to, from when a button goes down.
struct Grip {
    glm::dvec3 about{0.0};  // turns are about it, and moves are in its depth
    glm::dvec3 goal{0.0};   // zooms come nearer to it
    double least_mm = 1e-6; // but not nearer than that
    [[nodiscard]] static Grip at(const glm::dvec3& point) { return {point, point}; }
};

class ViewportMouse {
public:
    static constexpr double kDragThreshold = 4.0;       // pixels at a pixel ratio of 1
    static constexpr double kDoubleClickSeconds = 0.35; // between the presses
    static constexpr double kWheelStep = 1.15;          // magnification of one notch

    void set_pixel_ratio(double ratio) { pixel_ratio_ = ratio; }
    void press(MouseButton button, Modifiers modifiers, glm::dvec2 at, const Grip& grip);
    [[nodiscard]] std::optional<Click> release(MouseButton button, glm::dvec2 at, double seconds);
    // The camera after the pointer moved, when that changed it.
    [[nodiscard]] std::optional<render::Camera> move(const render::Camera& camera, glm::ivec2 size, glm::dvec2 to);
    // What lies at the grip's goal stays where it is in the picture.
    [[nodiscard]] static render::Camera wheel(const render::Camera& camera, const Grip& grip, double notches);
    // Whether the drag that goes on turns the view; else it keeps what was under the pointer there, or zooms.
    [[nodiscard]] bool turning() const { return dragging() && *held_ == MouseButton::kLeft && !modifiers_.shift; }
    [[nodiscard]] bool zooming() const { return dragging() && *held_ == MouseButton::kRight; }
    [[nodiscard]] const Grip& grip() const { return grip_; } // of the last press

    [[nodiscard]] bool held() const { return held_.has_value(); }
    [[nodiscard]] bool dragging() const { return held_ && dragging_; }

private:
    std::optional<MouseButton> held_;
    Modifiers modifiers_;
    Grip grip_;
    glm::dvec2 pressed_at_{0.0}, last_{0.0};
    bool dragging_ = false;
    double pixel_ratio_ = 1.0;
    double last_click_seconds_ = -1e9;
    glm::dvec2 last_click_at_{0.0};
};

} // namespace ramus::app
