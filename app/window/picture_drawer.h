// PictureDrawer: has the window's picture drawn, on the thread for that where there is one, one picture at a time; and
// asks what it shows. Pictures that come soon are waited for, others are taken when they are there. Without a thread
// all is done when it is asked for.
#pragma once

#include "app/window/drawing_thread.h"
#include "app/window/shown_picture.h"
#include "render/renderer/sheet.h"

#include <future>
#include <optional>
#include <vector>

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
    };
    // Begin it, as SheetRenderer has it, while none is on its way. take() has it, after waiting so long at most.
    void draw(const render::Sheet& sheet, std::size_t upload_budget, double seconds);
    void refine(const render::Sheet& sheet, double seconds);
    [[nodiscard]] std::optional<Made> take(double seconds);
    [[nodiscard]] bool busy() const { return made_.valid(); } // one is on its way
    [[nodiscard]] bool drawing() const { return busy() && !refines_; }
    [[nodiscard]] bool has_picture() const { return !thread_.apart() || shown_.any(); }

    void present(unsigned framebuffer, glm::ivec2 at, glm::ivec2 size);

    // As of SheetRenderer. The first waits for what is on its way, unless the answer to the same question is known.
    [[nodiscard]] render::Pick pick(glm::dvec2 at);
    void request_pick(glm::dvec2 at);
    [[nodiscard]] std::optional<render::Pick> poll_pick();
    [[nodiscard]] bool idle() const { return thread_.idle(); } // the next two do not wait
    [[nodiscard]] bool request_depths();
    [[nodiscard]] std::optional<std::vector<render::DepthMap>> poll_depths();

    // `work(renderer, sheets)` where they are to be used, waiting for what is on its way. What it draws is not shown.
    template <class Work> auto with(Work work) {
        return thread_.run([this, &work] { return work(renderer_, *sheets_); });
    }

private:
    struct Asked {
        glm::dvec2 at{0.0};
        std::optional<render::Pick> answer;
    };
    [[nodiscard]] Made drawn(render::Sheet sheet, std::size_t upload_budget, double seconds);
    [[nodiscard]] Made refined(render::Sheet sheet, double seconds);
    Result<void> keep(const render::Sheet& sheet);

    render::Renderer& renderer_;
    DrawingThread& thread_;
    std::optional<render::SheetRenderer> sheets_; // draws with it
    ShownPicture shown_;
    std::future<Made> made_;
    bool refines_ = false;
    Asked asked_;                // the last pick
    bool ask_when_idle_ = false; // it is to be sent
};

} // namespace ramus::app
