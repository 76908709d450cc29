// Viewer: draws the picture and the interface over it with the current GL context, and handles mouse and keys. It knows
// no window: run_window.cpp passes it GLFW's events, headless_interface.h none. Times are seconds of one clock.
//
// Its parts implement the roles that commands use (app/actions/hosts.h): PictureView, ViewerInput, ViewerFiles and
// WindowParts; they share ViewerState.
//
// Nothing is drawn while nothing changes: draw() returns whether there is something new to show, wait_seconds() how
// long nothing will happen without events. All calls from one thread.
#pragma once

#include "app/panels/error_dialog.h"
#include "app/panels/widgets.h"
#include "app/picture/framing.h"
#include "app/window/figure_previewer.h"
#include "app/window/imgui_renderer.h"
#include "app/window/picture_view.h"
#include "app/window/viewer_files.h"
#include "app/window/viewer_input.h"
#include "app/window/window_parts.h"

#include <functional>
#include <memory>
#include <optional>

namespace ramus::app {

class Viewer {
public:
    // An ImGui context must be current. References must outlive the viewer. `wake`: called from other threads when
    // draw() has something to do; must be thread-safe. `thread`: draws pictures with `renderer`; null: draw() does.
    [[nodiscard]] static Result<std::unique_ptr<Viewer>> create(Workspace& workspace, render::Renderer& renderer,
                                                                float scale, std::function<void()> wake = {},
                                                                DrawingThread* thread = nullptr);

    void resize(glm::ivec2 window, float scale);
    [[nodiscard]] const Layout& layout() const { return state_.layout; }
    [[nodiscard]] const Interface& interface() const { return state_.interface; }
    [[nodiscard]] const CommandRunner& commands() const { return state_.commands; }
    [[nodiscard]] const PictureView& picture() const { return picture_; }
    [[nodiscard]] ViewerInput& input() { return input_; }
    [[nodiscard]] ViewerFiles& files() { return files_; }
    [[nodiscard]] const ViewerFiles& files() const { return files_; }
    [[nodiscard]] ActionContext& actions() { return actions_; }

    void redraw() { state_.redraw(); }               // call when something outside changed
    void present_again() { state_.present_again(); } // call when the window's pixels are lost
    void say(const std::string& sentence) { state_.say(sentence); }
    void warn(Warning warning) { state_.warn(std::move(warning)); }
    void tell(const Error& error) { state_.interface.of<ErrorDialog>().errors.push_back(error); } // shows a dialog
    void set_script_runs(bool runs) { state_.script_runs = runs; }
    void set_script_left(bool left) { state_.script_left = left; }
    [[nodiscard]] bool script_left() const { return state_.script_left; }
    void tell_steps(std::function<void(const char* step)> did) {
        state_.did = std::move(did);
    } // called after each step of draw()

    // Takes results of workers and picks, then draws changes into `framebuffer`. False: nothing changed.
    bool draw(double now, unsigned framebuffer);
    [[nodiscard]] double wait_seconds(double now) const; // infinite: until the next event
    [[nodiscard]] bool resting() const;                  // the picture is final for the current state
    [[nodiscard]] bool refined() const { return resting() && !picture_.refines(); } // and will not be refined further
    [[nodiscard]] std::string title() const;

    // Positions of controls, for scripts that drive the window; recorded after note_controls().
    void note_controls() { controls_.emplace(); }
    [[nodiscard]] const std::optional<widgets::Controls>& controls() const { return controls_; }

private:
    static constexpr int kDialogFrames = 14; // for fading in the background of a dialog
    static constexpr double kPollSeconds = 0.004;
    static constexpr double kProgressSeconds = 0.25; // interval of progress updates: each redraw slows the work

    Viewer(Workspace& workspace, render::Renderer& renderer, std::function<void()> wake, DrawingThread* thread);
    [[nodiscard]] bool working() const {
        return state_.workspace.busy() || state_.commands.busy() || files_.reading_volume();
    }
    void lay_out();
    void lay_out_viewports();
    void keep_in_view(); // of the vessels, when their part of the picture gets another shape
    void take_news();
    void begin_tree(const Workspace::Opened& opened);
    void build_interface();
    void present(unsigned framebuffer);

    ViewerState state_;
    DrawingThread no_thread_;
    PictureView picture_;
    FigurePreviewer previewer_;
    ViewerInput input_;
    ViewerFiles files_;
    WindowParts parts_;
    ActionContext actions_;
    Framing framing_;
    std::unique_ptr<ImguiRenderer> imgui_;
    std::optional<widgets::Controls> controls_; // of the last frame
    bool interface_waits_ = false, dialog_was_open_ = false;
};

} // namespace ramus::app
