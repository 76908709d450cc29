// The window without a window: what it does where graphics memory runs out, and with several viewports.
#include "app/window/viewer.h"
#include "render/renderer/renderer.h"
#include "tests/support/gl_test.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <fstream>
#include <glm/geometric.hpp>
#include <imgui.h>
#include <thread>

using namespace ramus;
using render::GlVersion;
using test::WatchedContext;

namespace {

struct ImguiContext {
    ImguiContext() { ImGui::CreateContext(); }
    ~ImguiContext() { ImGui::DestroyContext(); }
    ImguiContext(const ImguiContext&) = delete;
    ImguiContext& operator=(const ImguiContext&) = delete;
};

// The tree's part of a picture of the window: panels remember where the pointer was.
std::vector<std::uint8_t> view_of(const render::Image& image, const app::Layout& layout) {
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < layout.view_size.y; ++y) {
        const std::uint8_t* row = image.pixel(layout.view_at.x, layout.view_at.y + y);
        pixels.insert(pixels.end(), row, row + 4 * static_cast<std::ptrdiff_t>(layout.view_size.x));
    }
    return pixels;
}

} // namespace

TEST_CASE("a viewer that runs out of graphics memory says so, lives, and shows the tree again") {
    for (const GlVersion version : {GlVersion{4, 5}, GlVersion{3, 3}}) {
        CAPTURE(version.text());
        const TemporaryFolder folder;
        const auto file = folder.path() / "tree.swc";
        std::ofstream(file) << "1 1 0 0 -20 3 -1\n2 1 0 0 0 2.5 1\n3 1 -15 3 12 1.5 2\n4 1 14 -2 15 1.2 2\n";
        const WatchedContext context(version);
        const ImguiContext imgui;
        app::Workspace workspace({});
        workspace.document.open(nullptr, {});
        workspace.open(file);
        auto renderer = render::Renderer::create();
        REQUIRE(renderer);
        const glm::ivec2 size(900, 600);
        const render::Target target(size.x, size.y);
        auto viewer = app::Viewer::create(workspace, **renderer, 1.0F);
        REQUIRE(viewer);
        (*viewer)->resize(size, 1.0F);
        double now = 0.0;
        const auto settle = [&] {
            for (int i = 0; i < 2000 && (i < 5 || !(*viewer)->resting() || !workspace.surface_ready()); ++i) {
                (*viewer)->draw(now += 0.05, target.framebuffer());
                if (workspace.busy()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
            }
            now += 10.0; // notices are gone
            (*viewer)->redraw();
            for (int i = 0; i < 5; ++i) (*viewer)->draw(now += 0.05, target.framebuffer());
            return view_of(target.read_image(), (*viewer)->layout());
        };
        const std::vector<std::uint8_t> before = settle();
        const glm::ivec2 middle = (*viewer)->layout().view_at + (*viewer)->layout().view_size / 2;

        render::limit_gl_allocation(200'000); // the interface fits, no picture does
        (*viewer)->resize(size + 60, 1.0F);
        (*viewer)->draw(now += 0.05, target.framebuffer());
        CHECK((*viewer)->interface().notice.text.find("out of graphics memory") != std::string::npos);
        (*viewer)->input().mouse_moved(glm::dvec2(middle));
        for (int i = 0; i < 10; ++i) (*viewer)->draw(now += 0.05, target.framebuffer());
        CHECK_FALSE((*viewer)->files().closing());
        (*viewer)->input().mouse_left();

        render::limit_gl_allocation();
        (*viewer)->resize(size, 1.0F);
        CHECK(settle() == before);
    }
}

TEST_CASE("viewports beside each other turn together, and each is pointed at by itself") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "tree.swc";
    std::ofstream(file) << "1 1 0 0 -20 6 -1\n2 1 0 0 20 6 1\n";
    const WatchedContext context;
    const ImguiContext imgui;
    app::Workspace workspace({});
    workspace.document.open(nullptr, {});
    workspace.open(file);
    auto renderer = render::Renderer::create();
    REQUIRE(renderer);
    const glm::ivec2 size(1100, 600);
    const render::Target target(size.x, size.y);
    auto viewer = app::Viewer::create(workspace, **renderer, 1.0F);
    REQUIRE(viewer);
    (*viewer)->resize(size, 1.0F);
    double now = 0.0;
    const auto settle = [&] {
        for (int i = 0;
             i < 2000 && (i < 5 || !(*viewer)->resting() || !workspace.surface_ready() || workspace.comparing()); ++i) {
            (*viewer)->draw(now += 0.05, target.framebuffer());
            if (workspace.busy()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    };
    settle();
    const auto run = [&](std::vector<std::string> words) { REQUIRE(app::run_command((*viewer)->actions(), words)); };
    run({"compare", "side-by-side", "iso,cones,cs"});
    settle();
    const app::Layout& layout = (*viewer)->layout();
    REQUIRE(layout.viewports_at.size() == 3);
    CHECK((*viewer)->picture().picture_size() == layout.viewport_size);
    CHECK(3 * layout.viewport_size.x < layout.view_size.x);
    const auto middle = [&](std::size_t viewport) {
        return glm::dvec2(layout.view_at + layout.viewports_at[viewport]) + 0.5 * glm::dvec2(layout.viewport_size);
    };
    // The tree was fitted to the viewport: its middle is in the middle of each.
    const render::Image beside = target.read_image();
    for (std::size_t viewport = 0; viewport < 3; ++viewport) {
        CAPTURE(viewport);
        const glm::ivec2 at(middle(viewport));
        CHECK(beside.pixel(at.x, at.y)[0] > beside.pixel(at.x, at.y)[2] + 40); // vessels are red
        (*viewer)->input().mouse_moved(middle(viewport));
        settle();
        CHECK((*viewer)->interface().hovered == (viewport == 0 ? tree::kNoBranch : 0)); // a mask has no branches
    }
    // A click on the mask selects nothing, one on the cones the branch.
    for (const std::size_t viewport : {0U, 1U}) {
        (*viewer)->input().mouse_moved(middle(viewport));
        (*viewer)->input().mouse_button(app::MouseButton::kLeft, true, {}, now += 1.0);
        (*viewer)->input().mouse_button(app::MouseButton::kLeft, false, {}, now += 0.05);
        settle();
        CHECK(workspace.document.marks().selection.size() == viewport);
    }
    // Dragging in any of them turns the one camera, as far in each.
    const render::Camera start = workspace.document.session().camera;
    std::vector<render::Camera> turned;
    for (std::size_t viewport = 0; viewport < 3; ++viewport) {
        workspace.document.set_camera(start);
        (*viewer)->input().mouse_moved(middle(viewport));
        (*viewer)->input().mouse_button(app::MouseButton::kLeft, true, {}, now += 1.0);
        (*viewer)->input().mouse_moved(middle(viewport) + glm::dvec2(30.0, 0.0));
        (*viewer)->draw(now += 0.05, target.framebuffer());
        (*viewer)->input().mouse_moved(middle(viewport) + glm::dvec2(5.0, 500.0)); // out of it
        (*viewer)->input().mouse_button(app::MouseButton::kLeft, false, {}, now += 0.05);
        turned.push_back(workspace.document.session().camera);
        CHECK(turned.back() != start);
        CHECK(glm::distance(turned.back().position, turned.front().position) < 1e-6);
        settle();
    }
    run({"compare", "off"});
    settle();
    CHECK(layout.viewports_at.size() == 1);
    CHECK((*viewer)->picture().picture_size() == layout.view_size);
}
