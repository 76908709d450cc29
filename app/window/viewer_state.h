// State shared by the parts of a Viewer: the workspace, the interface around the picture, and sizes.
#pragma once

#include "app/actions/command_runner.h"
#include "app/panels/interface.h"
#include "app/picture/compose_sheet.h"
#include "app/workspace/workspace.h"
#include "core/base/stopwatch.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace ramus::app {

// Limits per frame for pictures while a person watches.
inline constexpr double kDrawingSeconds = 0.03; // may be exceeded by one part
inline constexpr std::size_t kUploadBudget = std::size_t{24}
                                             << 20; // bytes sent to the graphics card: a few milliseconds

struct ViewerState {
    // ImGui needs a few frames until the sizes of popups settle.
    static constexpr int kFramesAfterEvent = 3;

    ViewerState(Workspace& with, std::function<void()> its_wake)
        : wake(std::move(its_wake)), workspace(with), commands(wake) {}

    std::function<void()> wake;                                     // called on other threads; thread-safe
    std::function<void(const char* step)> did = [](const char*) {}; // called after each step of a tick (TickWatch)

    Workspace& workspace;
    CommandRunner commands;
    ActionContext* actions = nullptr; // with all hosts, once they exist
    Interface interface;
    Layout layout;
    std::shared_ptr<const tree::VesselTree> tree; // of the panels' state
    float scale = 1.0F;                           // pixels per point
    double now = 0.0;                             // seconds, of the last event or frame
    Stopwatch frame;                              // since the frame began
    int frames_left = kFramesAfterEvent;
    std::uint64_t presented = 0; // fingerprint of the interface on the screen
    bool persons_window = false; // a real window: settings and recent files are saved
    bool script_runs = false;    // does not ask about unsaved changes
    bool script_left = false;    // the script has further lines

    // Whether a person watches the window.
    [[nodiscard]] bool watched() const { return persons_window && !script_runs; }
    // After an edit or a reread, branch ids that panels and tools remember are invalid: forgets them.
    void follow_tree() {
        (void)workspace.follow_tree();
        if (std::exchange(tree, workspace.document().tree()) == workspace.document().tree()) return;
        interface.forget_tree();
        actions->tools->use_tool(actions->tools->tool());
        redraw();
    }
    void redraw() { frames_left = kFramesAfterEvent; }
    void present_again() { // the screen does not show the last frame
        presented = 0;
        redraw();
    }
    void say(const std::string& sentence) {
        interface.tell(sentence, now);
        redraw();
    }
    void warn(Warning warning) {
        interface.warn(std::move(warning), now);
        redraw();
    }
    [[nodiscard]] InterfaceContext context() { return {interface, workspace, *actions, commands, layout, now}; }
    void perform(std::string_view name, const std::vector<std::string>& arguments) {
        context().perform(name, arguments);
    }

    // Runs `then` once `ready`, before any later command.
    void await(std::function<bool()> ready, std::function<void()> then) {
        const auto act = [this, then = std::move(then)](ActionContext&) -> Result<void> {
            then();
            redraw();
            return {};
        };
        (void)commands.await(*actions, {std::move(ready), act});
    }

    [[nodiscard]] std::vector<Viewport> viewports() const {
        return viewports_of(workspace.document().session(), layout.view_size, scale);
    }
    [[nodiscard]] glm::ivec2 viewport_size() const { return viewports().front().size; }
};

} // namespace ramus::app
