// ViewportMouse: converts mouse events over the picture into camera changes and clicks, as in 3D Slicer: left-drag
// rotates, middle-drag or Shift+left-drag pans, right-drag or the wheel zooms, each about the point of a grip (see
// app/tools/aim.h). A drag begins after the pointer has moved by kDragThreshold, and is never a click. No window, no
// picking; time is passed in.
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
        kSelectWithDependents, // Alt; also Ctrl+Shift, since many window managers use Alt
        kToggle,               // Ctrl
        kAdd,                  // Shift; a drag with it pans
        kCentre,               // the second click of a double-click
        kSecondary,            // the right button
    };
    Kind kind;
    glm::dvec2 at;
};

// The anchor of a drag, set when the button is pressed.
struct Grip {
    glm::dvec3 about{0.0};  // centre of rotation; panning is in its depth
    glm::dvec3 goal{0.0};   // target of zooming
    double least_mm = 1e-6; // smallest distance from the target
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
    // The camera after the pointer moved; none if it did not change.
    [[nodiscard]] std::optional<render::Camera> move(const render::Camera& camera, glm::ivec2 size, glm::dvec2 to);
    // Zooms; the grip's goal keeps its place in the picture.
    [[nodiscard]] static render::Camera wheel(const render::Camera& camera, const Grip& grip, double notches);
    // Whether the current drag rotates the view; other drags pan or zoom.
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
