// The whole window as a picture without a window: `ramus render --ui`. The same Viewer as in the window draws it, once
// everything has come to rest.
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
    std::optional<render::ScaleBar> scale_bar; // none: there is none
};

// `size` is the window's, in pixels. A GL context is current; `workspace` has its tree and its surface (adopt()).
// `prepare`, when given, runs once the interface is there: commands like `help` find their window in it.
[[nodiscard]] Result<WindowPicture>
picture_with_interface(Workspace& workspace, render::Renderer& renderer, glm::ivec2 size, float scale,
                       const std::function<Result<void>(ActionContext&)>& prepare = {});

} // namespace ramus::app
