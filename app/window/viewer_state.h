// What the parts of a Viewer share: the document with the work behind it, what is drawn around the picture, and how
// large all of it is.
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

// What pictures may take of a frame while somebody watches.
inline constexpr double kDrawingSeconds = 0.03;                     // and a part more
inline constexpr std::size_t kUploadBudget = std::size_t{24} << 20; // bytes that are sent: a few milliseconds

struct ViewerState {
    // ImGui needs a few frames until popups and their sizes have settled.
    static constexpr int kFramesAfterEvent = 3;

    ViewerState(Workspace& with, std::function<void()> its_wake)
        : wake(std::move(its_wake)), workspace(with), commands(wake) {}

    std::function<void()> wake; // called on other threads when there is something to do
    std::function<void(const char* step)> did = [](const char*) {}; // told after each step of a frame (LoopWatch)

    Workspace& workspace;
    CommandRunner commands;
    ActionContext* actions = nullptr; // of all hosts, once they are there
    Interface interface;
    Layout layout;
    std::shared_ptr<const tree::VesselTree> tree; // that the panels know
    float scale = 1.0F;                           // pixels per point
    double now = 0.0;                             // seconds, of the last event or frame
    Stopwatch frame;                              // since the frame began
    int frames_left = kFramesAfterEvent;
    std::uint64_t presented = 0; // fingerprint of the interface that is on the screen
    bool persons_window = false; // not a picture of one: settings and recent files are kept
    bool script_runs = false;    // nobody is asked about unsaved changes
    bool script_left = false;    // lines of it are still to come

    // Whether somebody waits for the next picture.
    [[nodiscard]] bool watched() const { return persons_window && !script_runs; }
    // What panels and tools remember by the ids of branches is worth nothing once the tree was edited, or its file read
    // in another way.
    void follow_tree() {
        (void)workspace.follow_tree();
        if (std::exchange(tree, workspace.document().tree()) == workspace.document().tree()) return;
        interface.forget_tree();
        actions->tools->use_tool(actions->tools->tool());
        redraw();
    }
    void redraw() { frames_left = kFramesAfterEvent; }
    void present_again() { // what is on the screen is not the last frame
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

    // What takes effect once `ready`, before all that is done after it.
    void await(std::function<bool()> ready, std::function<void()> then) {
        const auto act = [this, then = std::move(then)](ActionContext&) -> Result<void> {
            then();
            redraw();
            return {};
        };
        (void)commands.await(*actions, {std::move(ready), act});
    }

    [[nodiscard]] std::vector<Viewport> viewports() const {
        return viewports_of(workspace.document().marks(), layout.view_size, scale);
    }
    [[nodiscard]] glm::ivec2 viewport_size() const { return viewports().front().size; }
};

} // namespace ramus::app
