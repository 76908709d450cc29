// Draws the whole window as a picture without a window, for `ramus render --ui`. The Viewer of the window draws it,
// after all work has finished.
#pragma once

#include "app/actions/action.h"
#include "app/workspace/workspace.h"
#include "render/image/image.h"
#include "render/overlay/scale_bar.h"
#include "render/renderer/renderer.h"

#include <functional>
#include <optional>

namespace ramus::app {

struct WindowPicture {
    render::Image image;
    std::optional<render::ScaleBar> scale_bar; // none: no scale bar
};

// `size`: of the window in pixels. A GL context must be current; `workspace` must have a tree and its surface
// (adopt()). `prepare`, if given, runs after the interface was created, so that commands like `help` find it.
[[nodiscard]] Result<WindowPicture>
picture_with_interface(Workspace& workspace, render::Renderer& renderer, glm::ivec2 size, float scale,
                       const std::function<Result<void>(ActionContext&)>& prepare = {});

} // namespace ramus::app
