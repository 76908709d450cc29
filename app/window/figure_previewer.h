// FigurePreviewer: what an export would look like, small, while its dialog is open. It draws the coarser surfaces with
// a renderer of its own, so that the window's picture stays, and lets go of both when the dialog closes. A frame draws
// one of four views at the most, and of a large one a part.
#pragma once

#include "app/picture/figures.h"
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
    [[nodiscard]] Result<FourViews> views_of(glm::ivec2 size, const FigureOptions& options) const;
    void begin(glm::ivec2 size);
    [[nodiscard]] Result<void> go_on();
    void show(const render::Image& image);
    void let_go();

    // What is being drawn, and how far it is.
    struct Drawing {
        FourViews all; // or the one
        FigureOptions options;
        std::size_t next = 0;
    };
    struct Wanted {
        render::Sheet sheet; // as the window would draw it at that size
        FigureOptions options;
        glm::ivec2 full; // pixels of the file
        bool operator==(const Wanted&) const = default;
    };
    ViewerState& state_;
    std::unique_ptr<render::Renderer> renderer_;
    std::optional<render::SheetRenderer> sheets_; // draws with it
    std::optional<Drawing> drawing_;
    render::Texture texture_;
    std::optional<Wanted> shown_;
};

} // namespace ramus::app
