// Paints the pointers that systems lack, the lassos, from curves, so that they are crisp at any scale.
#pragma once

#include "app/tools/tool.h"
#include "render/image/image.h"

#include <glm/vec2.hpp>
#include <optional>

namespace ramus::app {

struct CursorImage {
    render::Image image;    // straight alpha
    glm::ivec2 hot_spot{0}; // pixels from the top left
};

// None for pointers that the system provides. `scale`: pixels per point.
[[nodiscard]] std::optional<CursorImage> cursor_image(Cursor cursor, float scale);

} // namespace ramus::app
