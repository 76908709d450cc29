// PictureDrawer: draws the window's picture on the drawing thread if there is one, one picture at a time, and answers
// picks. The window waits for pictures that finish soon and takes others when they are ready. Without a thread
// everything is synchronous.
#pragma once

#include "app/window/drawing_thread.h"
#include "app/window/shown_picture.h"
#include "render/renderer/sheet.h"

#include <future>
#include <optional>
#include <utility>

namespace ramus::app {

class PictureDrawer {
public:
    // Both must outlive it.
    PictureDrawer(render::Renderer& renderer, DrawingThread& thread);
    ~PictureDrawer();
    PictureDrawer(const PictureDrawer&) = delete;
    PictureDrawer& operator=(const PictureDrawer&) = delete;

    // A picture that was drawn or refined.
    struct Made {
        render::Sheet sheet;
        Result<render::DrawStatistics> drawn{};
        std::optional<render::Refined> finer{}; // none: drawn, not refined
        std::optional<render::ScaleBar> scale_bar{};
        render::SheetRenderer::Seen seen{};
    };
    // Starts drawing or refining; see SheetRenderer. Call only if not busy(). take() returns the result, after waiting
    // at most `seconds`.
    void draw(const render::Sheet& sheet, std::size_t upload_budget, double seconds);
    void refine(const render::Sheet& sheet, double seconds);
    [[nodiscard]] std::optional<Made> take(double seconds);
    [[nodiscard]] bool busy() const { return made_.valid(); } // a picture is in progress
    [[nodiscard]] bool drawing() const { return busy() && !refines_; }
    [[nodiscard]] bool has_picture() const { return !thread_.has_thread() || shown_.any(); }

    [[nodiscard]] int waits() const { return thread_.waits(); }

    void present(unsigned framebuffer, glm::ivec2 at, glm::ivec2 size);

    // See SheetRenderer. pick() refers to the picture shown now, even if another is drawn before the answer; none: that
    // picture is no longer known.
    [[nodiscard]] Deferred<std::optional<render::Pick>> pick(glm::dvec2 at);
    [[nodiscard]] glm::ivec2 shown_size() const { return seen_.outline.size; }
    void request_pick(glm::dvec2 at);
    [[nodiscard]] std::optional<render::Pick> poll_pick();

    // Requests depths if idle; otherwise returns false.
    [[nodiscard]] bool request_depths();
    struct Depths {
        std::optional<std::vector<render::DepthMap>> maps; // none: ask again after the next picture
    };
    [[nodiscard]] std::optional<Depths> poll_depths(); // the answer

    // Runs `work(renderer, sheets)` where pictures are drawn, after queued work. Its pictures are not shown.
    template <class Work> [[nodiscard]] auto later(Work work) {
        return thread_.later([this, work = std::move(work)] {
            drawn_for_others_ = true;
            return work(renderer_, *sheets_);
        });
    }
    template <class Work> auto with(Work work) { // the same, and waits
        return thread_.run([this, &work] {
            drawn_for_others_ = true;
            return work(renderer_, *sheets_);
        });
    }

private:
    struct Asked {
        glm::dvec2 at{0.0};
        render::SheetRenderer::Seen of{}; // the sheet that was shown
        std::optional<render::Pick> answer{};
    };
    [[nodiscard]] bool idle() const { return thread_.idle(); }
    [[nodiscard]] Made drawn(render::Sheet sheet, std::size_t upload_budget, double seconds);
    [[nodiscard]] Made refined(render::Sheet sheet, double seconds);
    Result<void> keep(const render::Sheet& sheet);
    void ask(); // runs on the thread while the window waits

    render::Renderer& renderer_;
    DrawingThread& thread_;
    std::optional<render::SheetRenderer> sheets_; // uses renderer_
    bool drawn_for_others_ = false;               // since the shown picture; belongs to the drawing thread
    ShownPicture shown_;
    std::future<Made> made_;
    bool refines_ = false;
    render::SheetRenderer::Seen seen_; // the shown sheet
    Asked asked_;                      // the last pick
    bool ask_when_idle_ = false;       // the pick is not sent yet
    std::optional<std::future<bool>> depths_asked_;
};

} // namespace ramus::app
