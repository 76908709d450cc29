// The window without a window: a viewer on a tree, with an OpenGL context and a clock of its own.
#pragma once

#include "app/window/viewer.h"
#include "render/renderer/renderer.h"
#include "tests/support/gl_test.h"
#include "tests/support/temporary_folder.h"

#include <chrono>
#include <fstream>
#include <imgui.h>
#include <memory>
#include <string>
#include <thread>

namespace ramus::test {

class ViewerStage {
    struct ImguiContext {
        ImguiContext() { ImGui::CreateContext(); }
        ~ImguiContext() { ImGui::DestroyContext(); }
        ImguiContext(const ImguiContext&) = delete;
        ImguiContext& operator=(const ImguiContext&) = delete;
    };
    WatchedContext context_;
    ImguiContext imgui_;

public:
    TemporaryFolder folder;
    app::Workspace workspace{{}};
    std::unique_ptr<render::Renderer> renderer;
    render::PictureTarget target;
    std::unique_ptr<app::Viewer> viewer;
    double now = 0.0; // s

    ViewerStage(const std::string& swc, glm::ivec2 size, render::GlVersion newest = {99, 0}) : context_(newest) {
        target.make(size);
        std::ofstream(folder.path() / "tree.swc") << swc;
        workspace.open(folder.path() / "tree.swc");
        auto made = render::Renderer::create();
        REQUIRE(made);
        renderer = std::move(*made);
        auto shown = app::Viewer::create(workspace, *renderer, 1.0F);
        REQUIRE(shown);
        viewer = std::move(*shown);
        viewer->resize(size, 1.0F);
    }
    void draw() { viewer->draw(now += 0.05, target.framebuffer); }
    // Until nothing is to come; the picture then.
    render::Image settle() {
        const auto busy = [&] {
            return !viewer->resting() || !workspace.surface_ready() || workspace.awaited(app::WorkKind::kComparison);
        };
        for (int i = 0; i < 4000 && (i < 5 || busy()); ++i) {
            draw();
            if (workspace.busy()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return target.read_premultiplied();
    }
    void button(bool down, double after) {
        viewer->input().mouse_button(app::MouseButton::kLeft, down, {}, now += after);
    }
};

} // namespace ramus::test
