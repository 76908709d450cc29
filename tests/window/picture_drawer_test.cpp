// The window's picture, drawn on a thread of its own: what is asked of it meanwhile, and what becomes of failures.
#include "app/window/picture_drawer.h"
#include "render/gl/headless_context.h"
#include "tests/support/tube_scene.h"

#include <doctest/doctest.h>
#include <future>
#include <memory>

using namespace ramus;
using app::PictureDrawer;

namespace {

// A context of its own, a renderer for it, and who draws with it.
struct DrawnElsewhere {
    std::unique_ptr<render::GlContext> context;
    app::DrawingThread thread{[this] { return enter(); }, [this] { context.reset(); }, [] {}};
    std::unique_ptr<render::Renderer> renderer = render::Renderer::create_later();
    std::unique_ptr<PictureDrawer> drawer = std::make_unique<PictureDrawer>(*renderer, thread);

    DrawnElsewhere() { REQUIRE(thread.has_thread()); }
    ~DrawnElsewhere() {
        drawer.reset();
        thread.run([this] { renderer.reset(); });
    }
    DrawnElsewhere(const DrawnElsewhere&) = delete;
    DrawnElsewhere& operator=(const DrawnElsewhere&) = delete;

    [[nodiscard]] PictureDrawer::Made draw(const render::Sheet& sheet) const {
        drawer->draw(sheet, render::kUploadAll, render::kUntilDone);
        auto made = drawer->take(kLong);
        REQUIRE(made);
        return std::move(*made);
    }
    // What is answered while something else is being done.
    [[nodiscard]] render::Pick pick_while_busy(glm::dvec2 at) {
        std::promise<void> gate;
        thread.post([shut = gate.get_future().share()] { shut.wait(); });
        const auto coming = drawer->pick(at);
        gate.set_value();
        return coming.take().value();
    }
    static constexpr double kLong = 60.0; // seconds; nothing here takes as long

private:
    [[nodiscard]] bool enter() {
        auto made = render::make_osmesa_context();
        if (made) context = std::move(*made);
        return context != nullptr;
    }
};

} // namespace

TEST_CASE_FIXTURE(DrawnElsewhere, "what was pointed at in a picture before is not what is clicked in this one") {
    const glm::dvec2 at(150.0, 100.0);
    render::Frame frame = test::tube(3.0F);
    REQUIRE(draw(render::sheet_of(frame)).drawn);
    drawer->request_pick(at);
    std::optional<render::Pick> hovered;
    while (!hovered) hovered = drawer->poll_pick();
    CHECK(hovered->branch == 0);
    CHECK(pick_while_busy(at) == *hovered);
    frame.camera.position.z += 20.0; // the vessel goes out of the picture
    frame.camera.focal_point.z += 20.0;
    REQUIRE(draw(render::sheet_of(frame)).drawn);
    CHECK(pick_while_busy(at).branch == render::kNoBranch);
}

TEST_CASE_FIXTURE(DrawnElsewhere, "a click is on the picture that is shown, whatever becomes of the next one") {
    const render::Frame frame = test::tube(3.0F);
    render::Sheet two;
    two.size = {600, 200};
    two.viewports = {{{0, 0}, frame}, {{300, 0}, frame}};
    const glm::dvec2 middle = 0.5 * glm::dvec2(frame.size);
    REQUIRE(draw(render::sheet_of(frame)).drawn);
    CHECK(drawer->shown_size() == frame.size);
    const render::Pick shown = pick_while_busy(middle);
    CHECK(shown.branch == 0);

    std::promise<void> gate;
    thread.post([shut = gate.get_future().share()] { shut.wait(); });
    const auto begin = [&](const render::Sheet& sheet) {
        drawer->draw(sheet, render::kUploadAll, render::kUntilDone);
        auto coming = drawer->pick(middle); // before the next one is shown
        gate.set_value();
        return coming;
    };
    const auto beside = begin(two);
    CHECK(beside.take() == shown);
    REQUIRE(drawer->take(kLong));
    CHECK(drawer->shown_size() == two.size);

    // The second viewport's picture is gone with it.
    const glm::dvec2 in_second(450.0, 100.0);
    CHECK(pick_while_busy(in_second) == shown);
    gate = {};
    thread.post([shut = gate.get_future().share()] { shut.wait(); });
    drawer->draw(render::sheet_of(frame), render::kUploadAll, render::kUntilDone);
    const auto gone = drawer->pick(in_second);
    gate.set_value();
    CHECK_FALSE(gone.take());
}

TEST_CASE_FIXTURE(DrawnElsewhere, "a picture that there is no memory for is told, and the next one is drawn") {
    const render::Frame frame = test::tube(3.0F);
    render::Sheet two;
    two.size = {600, 200};
    two.viewports = {{{0, 0}, frame}, {{300, 0}, frame}};
    REQUIRE(draw(render::sheet_of(frame)).drawn);
    render::limit_gl_allocation(16);
    const PictureDrawer::Made refused = draw(two);
    render::limit_gl_allocation();
    REQUIRE_FALSE(refused.drawn);
    CHECK(refused.drawn.error().message().find("out of graphics memory") != std::string::npos);
    drawer->refine(two, render::kUntilDone);
    CHECK_FALSE(drawer->take(kLong)->finer->changed);
    CHECK(draw(two).drawn);
    drawer->refine(two, render::kUntilDone);
    CHECK(drawer->take(kLong)->finer->changed);
}
