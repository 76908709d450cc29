#include "app/window/picture_drawer.h"

#include <algorithm>
#include <exception>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

namespace ramus::app {

PictureDrawer::PictureDrawer(render::Renderer& renderer, DrawingThread& thread)
    : renderer_(renderer), thread_(thread), sheets_(renderer) {}

PictureDrawer::~PictureDrawer() {
    thread_.run([this] {
        sheets_.reset();
        shown_.release();
    });
}

void PictureDrawer::draw(const render::Sheet& sheet, std::size_t upload_budget, double seconds) {
    refines_ = false;
    made_ = thread_.begin([this, sheet, upload_budget, seconds] { return drawn(sheet, upload_budget, seconds); });
}

void PictureDrawer::refine(const render::Sheet& sheet, double seconds) {
    refines_ = true;
    made_ = thread_.begin([this, sheet, seconds] { return refined(sheet, seconds); });
}

std::optional<PictureDrawer::Made> PictureDrawer::take(double seconds) {
    if (!busy()) return {};
    constexpr double kLongest = 1e6;
    if (!thread_.done(made_, std::min(seconds, kLongest))) return {};
    Made made = made_.get();
    const bool shown = made.finer ? made.finer->changed : made.drawn && made.drawn->shaded;
    if (shown) seen_ = made.seen;
    return made;
}

PictureDrawer::Made PictureDrawer::drawn(render::Sheet sheet, std::size_t upload_budget, double seconds) {
    Made made{.sheet = std::move(sheet)};
    try {
        made.drawn = sheets_->draw(made.sheet, upload_budget, seconds);
        made.scale_bar = sheets_->scale_bar();
        made.seen = sheets_->seen();
        // A picture drawn for another purpose may equal this sheet: then nothing is shaded again, but it is not shown
        // yet.
        if (std::exchange(drawn_for_others_, false) && made.drawn && !made.drawn->unfinished) made.drawn->shaded = true;
        if (made.drawn && made.drawn->shaded)
            if (auto kept = keep(made.sheet); !kept) made.drawn = tl::unexpected(kept.error());
    } catch (const std::exception& exception) { // fails this picture, not the window
        made.drawn = fail("the picture was given up: " + std::string(exception.what()));
    }
    return made;
}

PictureDrawer::Made PictureDrawer::refined(render::Sheet sheet, double seconds) {
    Made made{.sheet = std::move(sheet), .finer = render::Refined{}};
    try {
        made.finer = sheets_->refine(made.sheet, seconds).value_or(render::Refined{});
        made.scale_bar = sheets_->scale_bar();
        made.seen = sheets_->seen();
        if (made.finer->changed && !keep(made.sheet)) made.finer = render::Refined{};
    } catch (const std::exception&) { // as above; the picture stays
        made.finer = render::Refined{};
    }
    return made;
}

Result<void> PictureDrawer::keep(const render::Sheet& sheet) {
    if (!thread_.has_thread()) return {}; // without a thread it is shown directly
    try {
        shown_.keep(*sheets_, sheet.size);
        return {};
    } catch (const render::OutOfGraphicsMemory& error) {
        return fail(error.what(), {}, "make the window smaller");
    }
}

void PictureDrawer::present(unsigned framebuffer, glm::ivec2 at, glm::ivec2 size) {
    if (thread_.has_thread()) return shown_.present(framebuffer, at, size);
    sheets_->present(framebuffer, at.x, at.y);
}

Deferred<std::optional<render::Pick>> PictureDrawer::pick(glm::dvec2 at) {
    const bool same = asked_.answer && asked_.of == seen_ && glm::distance(asked_.at, at) < 1.0;
    if (!idle() && same) return known_now(asked_.answer);
    return thread_.later([this, at, of = seen_] { return sheets_->pick(at, of); });
}

void PictureDrawer::request_pick(glm::dvec2 at) {
    asked_ = {.at = at};
    ask_when_idle_ = !idle();
    if (!ask_when_idle_) thread_.run([this] { ask(); });
}

void PictureDrawer::ask() {
    asked_.of = sheets_->seen();
    sheets_->request_pick(asked_.at);
}

std::optional<render::Pick> PictureDrawer::poll_pick() {
    if (!idle()) return {};
    const bool asks = std::exchange(ask_when_idle_, false);
    const auto pick = thread_.run([&] {
        if (asks) ask();
        return sheets_->poll_pick();
    });
    if (pick) asked_.answer = pick;
    return pick;
}

// The first request links a program.
bool PictureDrawer::request_depths() {
    if (!idle()) return false;
    depths_asked_ = thread_.begin([this] { return sheets_->request_depths(); });
    return true;
}

std::optional<PictureDrawer::Depths> PictureDrawer::poll_depths() {
    if (!idle()) return {};
    if (depths_asked_ && !std::exchange(depths_asked_, std::nullopt)->get()) return Depths{};
    auto maps = thread_.run([this] { return sheets_->poll_depths(); });
    if (!maps) return {};
    return Depths{std::move(maps)};
}

} // namespace ramus::app
