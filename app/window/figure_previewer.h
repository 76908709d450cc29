// FigurePreviewer: what an export would look like, small, while its dialog is open. It draws the coarser surfaces with
// a renderer of its own, on the thread for that where there is one, so that the window's picture stays, and lets go of
// both when the dialog closes. One of four views is drawn at a time, and of a large one a part.
#pragma once

#include "app/picture/figures.h"
#include "app/window/drawing_thread.h"
#include "app/window/viewer_state.h"
#include "render/gl/gl_objects.h"
#include "render/renderer/sheet.h"

#include <future>
#include <memory>
#include <optional>

namespace ramus::app {

class FigurePreviewer {
public:
    // Both outlive it.
    FigurePreviewer(ViewerState& state, DrawingThread& thread) : state_(state), thread_(thread) {}
    ~FigurePreviewer() { let_go(); }
    FigurePreviewer(const FigurePreviewer&) = delete;
    FigurePreviewer& operator=(const FigurePreviewer&) = delete;

    // Draws what Interface::preview asks for, where that is another than before.
    void update();
    [[nodiscard]] bool drawing() const { return drawing_.has_value(); } // one is on its way

private:
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
    // Used where pictures are drawn alone.
    struct Its {
        std::unique_ptr<render::Renderer> renderer; // null: there is none yet, or memory ran out
        std::optional<render::SheetRenderer> sheets;
    };
    using Part = std::optional<render::Image>; // none: the view is not whole yet

    [[nodiscard]] render::Sheet small_sheet(glm::ivec2 size) const;
    [[nodiscard]] Result<FourViews> views_of(glm::ivec2 size, const FigureOptions& options) const;
    [[nodiscard]] static Result<Part> draw_part(Its& its, const render::Sheet& sheet, const FigureOptions& options,
                                                double seconds);
    void begin(glm::ivec2 size);
    void begin_part();
    void take_part(double seconds);
    void give_up();
    void show(const render::Image& image);
    void let_go();

    ViewerState& state_;
    DrawingThread& thread_;
    std::shared_ptr<Its> its_; // null: there is no dialog
    std::optional<Drawing> drawing_;
    std::future<Result<Part>> part_; // of it, on its way
    render::Texture texture_;
    std::optional<Wanted> shown_;
};

} // namespace ramus::app
