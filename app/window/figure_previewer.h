// FigurePreviewer: what an export would look like, small, while its dialog is open. It draws the coarser surfaces with
// a renderer of its own, so that the window's picture stays, and lets go of both when the dialog closes.
#pragma once

#include "app/window/viewer_state.h"
#include "render/gl/gl_objects.h"
#include "render/renderer/sheet.h"

#include <memory>
#include <optional>

namespace ramus::app {

class FigurePreviewer {
public:
    explicit FigurePreviewer(ViewerState& state) : state_(state) {}
    // Draws what Interface::preview asks for, where that is another than before.
    void update();

private:
    [[nodiscard]] render::Sheet small_sheet(glm::ivec2 size) const;
    [[nodiscard]] Result<render::Image> drawn(glm::ivec2 size);
    void show(const render::Image& image);
    void let_go();

    struct Wanted {
        render::Sheet sheet; // as the window would draw it at that size
        FigureOptions options;
        glm::ivec2 full; // pixels of the file
        bool operator==(const Wanted&) const = default;
    };
    ViewerState& state_;
    std::unique_ptr<render::Renderer> renderer_;
    render::Texture texture_;
    std::optional<Wanted> shown_;
};

} // namespace ramus::app
