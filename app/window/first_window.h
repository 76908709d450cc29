// How large text and the window are before a person has chosen, from what the display says of a monitor. Functions of
// their arguments: they call neither GLFW nor OpenGL.
#pragma once

#include <glm/vec2.hpp>

namespace ramus::app {

struct MonitorFacts {
    glm::ivec2 work_area{0};    // pixels without panels and docks; 0: not known
    float content_scale = 1.0F; // pixels per point that the desktop is set to; 1 also where nobody has set it
    float pixels_per_mm = 0.0F; // 0: not known
};

// Pixels per point: the desktop's scale, from 0.75 to 4. Where that is 1, monitors of 1,620 and more pixels along the
// shorter side get more, in steps of a quarter, so that text stays legible on them: at least 1.5 for 3840 x 2160, and 2
// where the pixels lie as close as 192 an inch.
[[nodiscard]] float suggested_scale(const MonitorFacts& monitor);

// The same on a monitor that the window is moved to, where the desktop's scale is `content_scale`; `usual` is
// suggested_scale() of the monitor that the window was opened on, whose desktop's scale was `usual_content_scale`.
[[nodiscard]] float scale_after_move(float content_scale, float usual, float usual_content_scale);

// Pixels of a window's content. `chosen_points`: the size that a person chose; 0: nobody has, and the window is 1440 x
// 900 points or, where that is more, 70 % of the work area each way. It never exceeds the work area, less the room of a
// title bar.
[[nodiscard]] glm::ivec2 window_pixels(const MonitorFacts& monitor, float scale, glm::ivec2 chosen_points);

} // namespace ramus::app
