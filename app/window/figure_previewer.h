// FigurePreviewer: draws small previews of an export while its dialog is open. It uses the preview meshes and a
// renderer of its own, on the drawing thread if there is one, so that the window's picture stays; both are released
// when the dialog closes. Of four views one is drawn at a time, and of a large view a part.
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
    // Both must outlive it.
    FigurePreviewer(ViewerState& state, DrawingThread& thread) : state_(state), thread_(thread) {}
    ~FigurePreviewer() { release(); }
    FigurePreviewer(const FigurePreviewer&) = delete;
    FigurePreviewer& operator=(const FigurePreviewer&) = delete;

    // Draws the preview that Interface::preview requests, if the request changed.
    void update();
    [[nodiscard]] bool drawing() const { return drawing_.has_value(); } // a preview is being drawn

private:
    // The preview being drawn, and its progress.
    struct Drawing {
        FourViews all; // or a single view
        FigureOptions options;
        std::size_t next = 0;
    };
    struct Wanted {
        render::Sheet sheet; // as in the window, at this size
        FigureOptions options;
        glm::ivec2 full; // pixels of the file
        bool operator==(const Wanted&) const = default;
    };
    // Used only where pictures are drawn (DrawingThread).
    struct Drawer {
        std::unique_ptr<render::Renderer> renderer; // null: none yet, or out of memory
        std::optional<render::SheetRenderer> sheets;
    };
    using Part = std::optional<render::Image>; // none: the view is not complete

    [[nodiscard]] render::Sheet small_sheet(glm::ivec2 size) const;
    [[nodiscard]] Result<FourViews> views_of(glm::ivec2 size, const FigureOptions& options) const;
    [[nodiscard]] static Result<Part> draw_part(Drawer& drawer, const render::Sheet& sheet,
                                                const FigureOptions& options, double seconds);
    void begin(glm::ivec2 size);
    void begin_part();
    void take_part(double seconds);
    void give_up();
    void show(const render::Image& image);
    void release();

    ViewerState& state_;
    DrawingThread& thread_;
    std::shared_ptr<Drawer> drawer_; // null: no dialog
    std::optional<Drawing> drawing_;
    std::future<Result<Part>> part_; // its part in progress
    render::Texture texture_;
    std::optional<Wanted> shown_;
};

} // namespace ramus::app
