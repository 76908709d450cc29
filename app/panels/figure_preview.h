// The picture of an export before it is written, between its dialog, which asks, and the window, which draws.
#pragma once

#include "app/picture/figure_options.h"

#include <glm/vec2.hpp>
#include <string>

namespace ramus::app {

// What an export would look like, as the dialog shows it.
struct FigurePreview {
    // Asked for by the dialog: of a file of this size, drawn in so many pixels.
    bool wanted = false;
    FigureRequest request;
    glm::ivec2 most{1};
    // What the window has made of it: a texture; 0: nothing yet.
    unsigned texture = 0;
    glm::ivec2 size{1};
    std::string trouble;
};

} // namespace ramus::app
