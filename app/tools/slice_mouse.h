// SliceMouse: converts mouse events over a slice into changes of the slice views: the left button moves the crosshair,
// the right one changes window (across) and level (up and down), the middle one or Shift and the left one moves the
// picture. Over the picture along a vessel the left button moves the place along it, and with Shift turns the picture
// about the vessel's axis. A press that is released without a drag is also a click. Pixels count from the top left of
// the slice. No window; time is passed in.
#pragma once

#include "app/session/slices.h"
#include "app/tools/viewport_mouse.h"
#include "core/slice/window.h"
#include "render/slice/along_view.h"

#include <optional>

namespace ramus::app {

// The slice under the pointer when a button was pressed.
struct SliceGrip {
    slice::Direction direction = slice::Direction::kAxial;
    slice::PixelGrid grid;
    SliceZoom zoom;
    std::optional<slice::Window> window{};    // none: there is no scan in grey
    std::optional<render::AlongView> along{}; // instead of the slice: the picture along a vessel
};

// What a move of the mouse changes; empty members stay.
struct SliceChange {
    std::optional<glm::dvec3> crosshair{};
    std::optional<slice::Window> window{};
    std::optional<SliceZoom> zoom{};
    std::optional<double> along_mm{}, angle_deg{}; // of the vessel that slices follow
};

class SliceMouse {
public:
    void set_pixel_ratio(double ratio) { pixel_ratio_ = ratio; }
    // The left button moves the crosshair at once.
    [[nodiscard]] SliceChange press(MouseButton button, Modifiers modifiers, glm::dvec2 at, const SliceGrip& grip);
    [[nodiscard]] SliceChange move(glm::dvec2 at);
    // The click, unless the pointer was dragged.
    [[nodiscard]] std::optional<Click> release(MouseButton button, glm::dvec2 at);
    // Magnifies about the pointer.
    [[nodiscard]] static SliceZoom zoomed(const SliceGrip& grip, glm::dvec2 at, double notches);

    // Whether a press is the second one of a double click with the left button; to be asked before press(). `at`:
    // pixels of the whole picture, `seconds` of any clock.
    [[nodiscard]] bool twice(MouseButton button, Modifiers modifiers, glm::dvec2 at, double seconds);

    [[nodiscard]] bool held() const { return held_.has_value(); }
    [[nodiscard]] bool windowing() const { return held_ == MouseButton::kRight && dragging_; }
    [[nodiscard]] const SliceGrip& grip() const { return grip_; } // of the last press

private:
    [[nodiscard]] SliceChange move_along(glm::dvec2 at) const;

    std::optional<MouseButton> held_;
    Modifiers modifiers_;
    SliceGrip grip_;
    glm::dvec2 pressed_at_{0.0};
    bool dragging_ = false;
    double pixel_ratio_ = 1.0;
    glm::dvec2 last_press_at_{0.0};
    double last_press_seconds_ = -1e9;
};

} // namespace ramus::app
