// Viewer: the picture and the interface over it, drawn with whatever GL context is current, and what the mouse and the
// keys do to them. It knows no window: run_window.cpp feeds it GLFW's events, headless_interface.h none at all. Places
// are framebuffer pixels from the top left, times are seconds of any one clock.
//
// Nothing is drawn while nothing changes: draw() says whether there is something new to show, wait_seconds() how long
// nothing will happen by itself.
#pragma once

#include "app/actions/keys.h"
#include "app/panels/interface.h"
#include "app/panels/widgets.h"
#include "app/picture/compose_sheet.h"
#include "app/tools/tool_mouse.h"
#include "app/tools/viewport_mouse.h"
#include "app/window/imgui_input.h"
#include "app/window/imgui_renderer.h"
#include "app/window/pace.h"
#include "app/workspace/workspace.h"
#include "render/renderer/sheet.h"

#include <functional>
#include <memory>
#include <optional>

namespace ramus::app {

class Viewer final : public Host {
public:
    // An ImGui context must be current. All references outlive the viewer.
    [[nodiscard]] static Result<std::unique_ptr<Viewer>> create(Workspace& workspace, render::Renderer& renderer,
                                                                float scale);

    void resize(glm::ivec2 window, float scale);
    [[nodiscard]] const Layout& layout() const { return layout_; }

    void mouse_moved(glm::dvec2 at);
    void mouse_left();
    void mouse_button(MouseButton button, bool down, Modifiers modifiers, double now);
    void mouse_wheel(glm::dvec2 notches);
    // `number` is GLFW's; `press` is empty for releases and for keys without a name.
    void key(int number, bool down, const std::optional<KeyPress>& press, Modifiers modifiers, double now);
    void character(unsigned codepoint, double now);
    void dropped(const std::filesystem::path& path);
    void shake() { frames_left_ = kFramesAfterEvent; } // something outside changed

    void exposed() { // the window's own pixels are lost
        drawn_ = 0;
        shake();
    }

    // Takes results of workers and picks. Then draws into `framebuffer` what changed; false: it looks as before.
    bool draw(double now, unsigned framebuffer);
    [[nodiscard]] double wait_seconds(double now) const; // infinite: until an event
    [[nodiscard]] bool closing() const { return closing_; }

    [[nodiscard]] const Interface& interface() const { return interface_; }
    [[nodiscard]] bool resting() const; // the picture is the final one of what is known now
    // What the last picture was made of, and the kernel's width in it: maybe of a surface that is not there yet.
    [[nodiscard]] bool cast() const { return cast_; }
    [[nodiscard]] bool refined() const { return resting() && !refines_; } // it gets no finer
    [[nodiscard]] float pictured_width() const { return pictured_width_; }
    [[nodiscard]] std::string title() const;
    [[nodiscard]] Cursor cursor() const;
    void tell(const Error& error) { interface_.errors.push_back(error); }
    // For scripts that drive the window: nothing until they are wanted.
    void want_controls() { controls_.emplace(); }
    [[nodiscard]] const std::optional<widgets::Controls>& controls() const { return controls_; }

    // What lives longer than the window: see run_window.cpp.
    void use_settings(const Settings& settings);
    [[nodiscard]] Settings settings() const;
    void offer(std::vector<autosave::Slot> abandoned);
    // What was recovered since the last call, to be taken over.
    [[nodiscard]] std::optional<autosave::Slot> take_recovered() { return std::exchange(recovered_, std::nullopt); }
    // A script runs: nobody is asked about unsaved changes.
    void set_unattended(bool unattended) { unattended_ = unattended; }

    // Host
    [[nodiscard]] glm::ivec2 picture_size() const override { return panes().front().size; }
    [[nodiscard]] std::shared_ptr<const render::PagedMesh> picture_mesh() const override;
    Result<render::BranchPicture> branch_picture() override;
    Result<void> write_picture(const std::filesystem::path& path) override;
    Result<render::Image> draw_picture(const render::Camera& camera, glm::ivec2 size) override;
    void say(const std::string& sentence) override;
    Result<void> open(const std::filesystem::path& path) override;
    Result<void> ask_for_file() override;
    Result<void> ask_for_lesion_mesh() override;
    Result<void> ask_for_mask() override;
    [[nodiscard]] bool unhurried() const override { return unattended_ || !keeps_files_; }
    bool reads_lesion_mesh(const std::filesystem::path& path) override;
    Result<void> ask_for_context() override;
    bool reads_context(const ContextItem& item, std::span<const std::string> arguments) override;
    Result<void> ask_for_name() override;
    Result<void> toggle(std::string_view part) override;
    Result<void> arrange(std::string_view part, std::string_view setting) override;
    [[nodiscard]] bool shows(std::string_view part) const override;
    void camera_leapt() override;
    void flew(int branch, double fraction) override;
    bool dismiss() override;
    Result<void> quit() override;
    Result<void> copy_text(const std::string& text) override;
    Result<std::string> pasted_text() override;
    Result<void> recover(int which) override;
    Result<void> discard_recovery(int which) override;
    Result<void> set_ui_scale(double pixels_per_point) override;
    [[nodiscard]] double ui_scale() const override { return scale_; }
    Result<void> use_tool(std::string_view name) override;
    [[nodiscard]] std::string_view tool() const override { return interface_.tool_kind->name; }
    ToolSettings* tool_settings() override { return &interface_.tool_settings; }

private:
    // ImGui needs a few frames until popups and their sizes have settled.
    static constexpr int kFramesAfterEvent = 3;
    static constexpr int kDialogFrames = 14; // what lies behind a dialog fades
    static constexpr double kPollSeconds = 0.004;
    static constexpr double kProgressSeconds = 0.25; // each redraw takes from the work
    static constexpr float kToolBarHeight = 48.0F;   // points at the top of the picture that the tools' bar takes
    static constexpr double kGlideSeconds = 0.35;
    static constexpr double kDrawingSeconds = 0.03; // a frame may take for a picture at rest, and a part more
    // A picture that is kept may take so long to get finer while the window waits; of a large surface it stays coarser.
    [[nodiscard]] double keeping_seconds() const { return unhurried() ? render::kUntilDone : 1.0; }
    static constexpr double kSlowToRefine = 3.0; // seconds of a full picture; one that takes more is fine enough
    static constexpr double kRefiningRest = 0.5; // seconds that nothing happens before the picture gets finer
    static constexpr std::size_t kUploadBudget = std::size_t{24} << 20; // bytes a frame: a few milliseconds

    Viewer(Workspace& workspace, render::Renderer& renderer);
    [[nodiscard]] bool over_picture(glm::dvec2 at) const;
    [[nodiscard]] glm::dvec2 in_picture(glm::dvec2 at) const { return at - glm::dvec2(layout_.view_at); }
    [[nodiscard]] std::vector<ComparedPane> panes() const;
    // From the corner of the pane that the pointer is in, or was in when a button was pressed.
    [[nodiscard]] glm::dvec2 in_pane(glm::dvec2 at) const;
    [[nodiscard]] glm::dvec2 from_pane(glm::dvec2 at) const; // to the picture's corner
    void enter_pane();
    [[nodiscard]] bool points_at_branches() const { return !interface_.tool || interface_.tool->points_at_branches(); }
    [[nodiscard]] Viewing viewing() const;
    bool refine(const render::Sheet& sheet); // true: the picture is another one
    void take_news();
    void take_pick();
    void ask_pick();
    Result<void> draw_for_keeping(const render::Camera& camera, glm::ivec2 size);
    void clicked(const Click& click);
    [[nodiscard]] Pointing pointing(Modifiers modifiers);
    void perform_tool();
    void move_camera(const render::Camera& camera); // by hand: at once
    [[nodiscard]] render::Camera camera_on_its_way();
    void run(const Command& command);
    void when_saved(std::function<void()> next);
    Result<void> open_and_wait(const std::filesystem::path& path);
    [[nodiscard]] Result<RecoveryDialog::Entry*> recovery(int which);
    void take_opened(const Workspace::Opened& opened);

    Workspace& workspace_;
    render::Renderer& renderer_;
    render::SheetRenderer sheets_; // draws with it
    std::size_t pane_ = 0;         // see in_pane()
    std::unique_ptr<ImguiRenderer> imgui_;
    ImguiInput input_;
    Interface interface_;
    std::optional<widgets::Controls> controls_; // of the last frame
    Layout layout_;
    ViewportMouse mouse_;
    ToolMouse tool_mouse_;
    float scale_ = 1.0F;
    double now_ = 0.0;
    glm::dvec2 pointer_{-1.0};
    bool pointer_over_picture_ = false;
    bool pick_wanted_ = false, pick_pending_ = false;
    // The picture's way to a camera that a command has set.
    struct Glide {
        render::Camera from;
        double since;
    };
    std::optional<Glide> glide_;
    render::Camera shown_camera_; // of the last picture
    Pace pace_;
    render::Quality quality_ = render::Quality::kFull; // of the last picture
    bool cast_ = false;                                // it was made along centerlines, not of a mesh
    float pictured_width_ = 0.0F;
    bool awaits_ = false; // it stays until the surface comes
    int frames_left_ = kFramesAfterEvent;
    std::shared_ptr<const render::PagedMesh> told_coarse_; // the surface that is shown by its preview
    std::string drawing_problem_;                          // why the last picture could not be drawn; empty: it was
    bool upload_pending_ = false;                          // not all of the surface is on the graphics card
    bool unfinished_ = false;                              // the picture at rest is being made, a part at a time
    double full_seconds_ = 0.0;                            // that the last full picture took
    double stirred_at_ = 0.0;                              // when anything last happened
    bool refines_ = false;                                 // then, the picture gets finer
    bool interface_waits_ = false, dialog_was_open_ = false;

    std::uint64_t drawn_ = 0; // fingerprint of the last interface
    bool closing_ = false;
    bool unattended_ = false;
    bool asked_about_arrival_ = false;
    bool reread_mesh_ = false;         // a lesion's mesh or context has been read: the command goes on
    bool keeps_files_ = false;         // a person's window, not a picture of one: settings and recent files are kept
    std::filesystem::path recovering_; // the file of the recovery that is being read; empty: none is
    std::optional<autosave::Slot> recovered_;
};

} // namespace ramus::app
