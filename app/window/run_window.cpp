#include "app/window/run_window.h"

#include "app/script.h"
#include "app/tree_source.h"
#include "app/window/glfw_window.h"
#include "app/window/status_file.h"
#include "app/window/theme.h"
#include "app/window/viewer.h"

// GL comes through glad, in render.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <future>
#include <imgui.h>
#include <iostream>
#include <optional>

namespace ramus::app {

namespace {

int complain(const Error& error) {
    std::cerr << "ramus: " << error.message() << '\n';
    return 1;
}

struct ImguiContext {
    ImguiContext() { ImGui::CreateContext(); }
    ~ImguiContext() { ImGui::DestroyContext(); }
    ImguiContext(const ImguiContext&) = delete;
    ImguiContext& operator=(const ImguiContext&) = delete;
};

std::optional<std::filesystem::path> first_file(const WindowOptions& options) {
    if (!options.session.empty()) return options.session;
    if (!options.files.empty()) return options.files.front();
    return demo_tree();
}

Result<void> loop(GlfwWindow& window, Viewer& viewer, Workspace& workspace, const WindowOptions& options,
                  std::optional<std::vector<ScriptLine>> script) {
    StatusFile status(options.status);
    while (!viewer.closing() && !window.close_wanted()) {
        if (viewer.draw(glfwGetTime(), 0)) window.swap();
        if (script && workspace.surface_ready() && viewer.resting()) {
            ActionContext context{workspace.document, viewer};
            const auto done = run_script(context, *std::exchange(script, std::nullopt), options.commands);
            if (!done) return done;
            viewer.shake();
            continue;
        }
        window.set_title(viewer.title());
        window.set_cursor(viewer.cursor());
        status.update(viewer, workspace);
        window.wait(viewer.wait_seconds(glfwGetTime()));
    }
    return {};
}

} // namespace

int run_window(const WindowOptions& options) {
    std::optional<std::vector<ScriptLine>> script;
    if (!options.commands.empty()) {
        auto read = read_script(options.commands);
        if (!read) return complain(read.error());
        script = std::move(*read);
    }
    // The file is read while the display and the graphics driver get ready.
    Workspace workspace(wake_window);
    workspace.reading = options.read;
    Session empty;
    empty.marks.options = options.surface;
    workspace.document.open(nullptr, empty);
    if (const auto file = first_file(options)) workspace.open(*file);

    const ImguiContext imgui;
    auto fonts = std::async(std::launch::async, [scale = options.scale > 0.0F ? options.scale : 1.0F] {
        theme::apply(scale); // another scale of the display makes them anew
        ImGui::GetIO().Fonts->Build();
    });
    auto window = GlfwWindow::create(options.size, options.scale);
    if (!window) return complain(window.error());
    auto renderer = render::Renderer::create();
    if (!renderer) return complain(renderer.error());
    fonts.wait();
    auto viewer = Viewer::create(workspace, **renderer, (*window)->scale());
    if (!viewer) return complain(viewer.error());
    (*window)->attach(viewer->get());
    (*viewer)->resize((*window)->framebuffer_size(), (*window)->scale());
    if (options.files.size() > 1) (*viewer)->say("One tree at a time: only " + options.files.front() + " was opened");
    (*window)->show();
    const auto done = loop(**window, **viewer, workspace, options, std::move(script));
    (*window)->attach(nullptr);
    return done ? 0 : complain(done.error());
}

} // namespace ramus::app
