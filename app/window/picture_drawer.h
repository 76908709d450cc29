// PictureDrawer: has the window's picture drawn, on the thread for that where there is one, one picture at a time; and
// asks what it shows. Pictures that come soon are waited for, others are taken when they are there. Without a thread
// all is done when it is asked for.
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
    // Both outlive it.
    PictureDrawer(render::Renderer& renderer, DrawingThread& thread);
    ~PictureDrawer();
    PictureDrawer(const PictureDrawer&) = delete;
    PictureDrawer& operator=(const PictureDrawer&) = delete;

    // A picture that was drawn, or made finer.
    struct Made {
        render::Sheet sheet;
        Result<render::DrawStatistics> drawn{};
        std::optional<render::Refined> finer{}; // none: it was drawn
        std::optional<render::ScaleBar> scale_bar{};
        render::SheetRenderer::Seen seen{};
    };
    // Begin it, as SheetRenderer has it, while none is on its way. take() has it, after waiting so long at most.
    void draw(const render::Sheet& sheet, std::size_t upload_budget, double seconds);
    void refine(const render::Sheet& sheet, double seconds);
    [[nodiscard]] std::optional<Made> take(double seconds);
    [[nodiscard]] bool busy() const { return made_.valid(); } // one is on its way
    [[nodiscard]] bool drawing() const { return busy() && !refines_; }
    [[nodiscard]] bool has_picture() const { return !thread_.apart() || shown_.any(); }

    [[nodiscard]] int waits() const { return thread_.waits(); }

    void present(unsigned framebuffer, glm::ivec2 at, glm::ivec2 size);

    // As of SheetRenderer. The first is of the picture that is shown now, whatever is drawn until it is there; none: by
    // then it is not known any more.
    [[nodiscard]] Deferred<std::optional<render::Pick>> pick(glm::dvec2 at);
    [[nodiscard]] glm::ivec2 shown_size() const { return seen_.outline.size; }
    void request_pick(glm::dvec2 at);
    [[nodiscard]] std::optional<render::Pick> poll_pick();

    // Asks for depths when nothing is being done; false: it is not the time.
    [[nodiscard]] bool request_depths();
    struct Depths {
        std::optional<std::vector<render::DepthMap>> maps; // none: to be asked for again after the next picture
    };
    [[nodiscard]] std::optional<Depths> poll_depths(); // of that

    // `work(renderer, sheets)` where they are to be used, after what is on its way. What it draws is not shown.
    template <class Work> [[nodiscard]] auto later(Work work) {
        return thread_.later([this, work = std::move(work)] {
            drawn_for_others_ = true;
            return work(renderer_, *sheets_);
        });
    }
    template <class Work> auto with(Work work) { // and waits for it
        return thread_.run([this, &work] {
            drawn_for_others_ = true;
            return work(renderer_, *sheets_);
        });
    }

private:
    struct Asked {
        glm::dvec2 at{0.0};
        render::SheetRenderer::Seen of{}; // what was there to be asked
        std::optional<render::Pick> answer{};
    };
    [[nodiscard]] bool idle() const { return thread_.idle(); }
    [[nodiscard]] Made drawn(render::Sheet sheet, std::size_t upload_budget, double seconds);
    [[nodiscard]] Made refined(render::Sheet sheet, double seconds);
    Result<void> keep(const render::Sheet& sheet);
    void ask(); // on the thread, while it is waited for

    render::Renderer& renderer_;
    DrawingThread& thread_;
    std::optional<render::SheetRenderer> sheets_; // draws with it
    bool drawn_for_others_ = false;               // since the last picture that is shown; of the drawing thread
    ShownPicture shown_;
    std::future<Made> made_;
    bool refines_ = false;
    render::SheetRenderer::Seen seen_; // that is shown
    Asked asked_;                      // the last pick
    bool ask_when_idle_ = false;       // it is to be sent
    std::optional<std::future<bool>> depths_asked_;
};

} // namespace ramus::app
