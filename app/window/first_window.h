// Chooses the initial size of text and window from the properties of a monitor. Pure functions: they call neither GLFW
// nor OpenGL.
#pragma once

#include <glm/vec2.hpp>

namespace ramus::app {

struct MonitorFacts {
    glm::ivec2 work_area{0};    // pixels without panels and docks; 0: unknown
    float content_scale = 1.0F; // pixels per point set on the desktop; also 1 if not set
    float pixels_per_mm = 0.0F; // 0: unknown
};

// Pixels per point: the desktop's scale, limited to 0.75 to 4. If that is 1, monitors with 1,620 pixels or more along
// the shorter side get more, in steps of a quarter, for legible text: at least 1.5 for 3840 x 2160, and 2 if there are
// 192 pixels per inch.
[[nodiscard]] float suggested_scale(const MonitorFacts& monitor);

// The scale after the window was moved to a monitor with this `content_scale`. `usual`: suggested_scale() of the
// monitor on which the window was opened; `usual_content_scale`: that monitor's content scale.
[[nodiscard]] float scale_after_move(float content_scale, float usual, float usual_content_scale);

// The size of the window's content in pixels. `chosen_points`: the user's size; 0: not chosen, then 1440 x 900 points,
// or 70 % of the work area in each direction if that is more. Never larger than the work area minus space for a title
// bar.
[[nodiscard]] glm::ivec2 window_pixels(const MonitorFacts& monitor, float scale, glm::ivec2 chosen_points);

} // namespace ramus::app
