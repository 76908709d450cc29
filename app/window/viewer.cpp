#include "app/window/viewer.h"

#include "app/actions/arguments.h"
#include "app/panels/doctor_panel.h"
#include "app/panels/fly_panel.h"
#include "app/panels/overview.h"
#include "app/panels/theme.h"
#include "app/panels/units_panel.h"
#include "app/panels/welcome_panel.h"
#include "app/picture/fit.h"
#include "app/session/reading_options.h"
#include "app/storage/opening_files.h"
#include "core/io/volumes/volume_file.h"

#include <algorithm>
#include <glad/gl.h>
#include <imgui.h>

namespace ramus::app {

Viewer::Viewer(Workspace& workspace, render::Renderer& renderer, std::function<void()> wake, DrawingThread* thread)
    : state_(workspace, std::move(wake)), picture_(state_, renderer, thread != nullptr ? *thread : no_thread_),
      previewer_(state_, thread != nullptr ? *thread : no_thread_), input_(state_, picture_),
      files_(state_, [this](const Workspace::Opened& opened) { begin_tree(opened); }),
      parts_(state_), actions_{.document = workspace.document(),
                               .picture = picture_,
                               .assets = workspace.assets(),
                               .files = &files_,
                               .window = &parts_,
                               .clipboard = &parts_,
                               .tools = &input_,
                               .tell = [this](const std::string& sentence) { state_.say(sentence); }} {
    state_.actions = &actions_;
}

Result<std::unique_ptr<Viewer>> Viewer::create(Workspace& workspace, render::Renderer& renderer, float scale,
                                               std::function<void()> wake, DrawingThread* thread) {
    std::unique_ptr<Viewer> viewer(new Viewer(workspace, renderer, std::move(wake), thread));
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // ImGui must not write a file into the working folder
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    io.ConfigInputTextCursorBlink = false; // a caret that blinks would redraw the window twice a second
    map_keys(io);
    viewer->state_.scale = scale;
    if (!io.Fonts->IsBuilt() || theme::scale() != scale) theme::apply(scale);
    RAMUS_TRY(imgui, ImguiRenderer::create());
    viewer->imgui_ = std::move(imgui);
    return viewer;
}

void Viewer::resize(glm::ivec2 window, float scale) {
    if (scale != state_.scale) {
        theme::apply(scale);
        imgui_->upload_fonts();
        state_.scale = scale;
    }
    input_.set_pixel_ratio(scale);
    state_.layout.window = window;
    lay_out();
    state_.redraw();
}

bool Viewer::draw(double now, unsigned framebuffer) {
    state_.now = now;
    state_.frame = {};
    lay_out();
    take_news();
    state_.did("news");
    lay_out_viewports();
    keep_in_view();
    // Picks in the current picture: if nothing else moves, this frame shows the result.
    input_.ask_pick();
    input_.take_pick();
    state_.did("pick");
    previewer_.update(); // before its texture is used
    state_.did("preview");
    build_interface();
    state_.did("interface");
    const bool drawn = picture_.draw(input_.dragging());
    if (drawn) input_.look_again();
    input_.ask_pick();
    const std::uint64_t looks = fingerprint(*ImGui::GetDrawData());
    state_.did("pick");
    const bool finer = picture_.refine(drawn || looks != state_.presented || !resting());
    state_.did("refine");
    if (!drawn && !finer && looks == state_.presented) return false;
    state_.presented = looks;
    present(framebuffer);
    state_.did("present");
    return true;
}

void Viewer::lay_out() {
    const Interface& interface = state_.interface;
    state_.layout = layout_of(state_.layout.window, state_.scale, interface.panel_open,
                              interface.of<Overview>().wanted_height(), interface.panel_points);
}

void Viewer::lay_out_viewports() {
    Layout& layout = state_.layout;
    layout.viewports_at.clear();
    layout.slices_at.clear();
    layout.current_plan_in.reset();
    for (const Viewport& viewport : state_.viewports()) {
        if (viewport.slice) {
            layout.slices_at.push_back({*viewport.slice, viewport.along, viewport.at, viewport.size});
            continue;
        }
        if (viewport.plan == state_.workspace.document().marks().plans.place)
            layout.current_plan_in = layout.viewports_at.size();
        layout.viewports_at.push_back(viewport.at);
    }
    if (layout.viewports_at.empty()) layout.viewports_at.emplace_back(0);
    layout.viewport_size = state_.viewport_size();
}

// Where surfaces or plans are compared, the commands that do that move the camera.
void Viewer::keep_in_view() {
    const Viewport tree = state_.viewports().front();
    const Session& session = state_.workspace.document().session();
    if (!tree.title.empty() || !state_.workspace.document().has_scene()) return framing_.forget();
    if (tree.slice) return;
    const auto seen = [this](const render::Camera& camera, glm::ivec2 size) {
        return actions::visible_positions(actions_, camera, size);
    };
    const auto camera = framing_.follow(session.camera, tree.size, seen);
    if (camera) state_.workspace.document().set_camera(*camera);
}

void Viewer::take_news() {
    if (state_.workspace.update()) state_.redraw();
    state_.follow_tree();
    files_.update();
    const bool worked = state_.commands.busy();
    for (const Error& error : state_.commands.update(actions_))
        state_.interface.tell(error, state_.workspace.document().lengths(), state_.now);
    if (worked != state_.commands.busy()) state_.redraw();
    state_.follow_tree();
}

// Ends everything that was begun on the previous tree.
void Viewer::begin_tree(const Workspace::Opened& opened) {
    if (const auto mesh = picture_.picture_mesh(); mesh && !opened.has_camera) {
        const glm::ivec2 size = picture_.picture_size();
        const auto& tree = state_.workspace.document().tree();
        const render::Camera from = render::looking({}, tree ? opening_view(*tree) : render::View::kAnterior);
        const auto positions = mesh->farthest(render::fitting_directions(from, size));
        state_.workspace.document().set_camera(
            with_room(render::fitted(from, positions, size), state_.workspace.document().marks().comparison));
    }
    picture_.stop_gliding();
    state_.interface.forget_tree();
    input_.use_tool(input_.tool());
    const Document& document = state_.workspace.document();
    state_.tree = document.tree();
    Interface& interface = state_.interface;
    if (interface.left_is<Doctor>() || interface.left_is<UnitsPanel>()) interface.close_left();
    if (document.subject() != demo_tree().value_or(std::filesystem::path())) interface.show_left<Welcome>(false);
    auto& doctor = interface.of<Doctor>() = {};
    auto& units = interface.of<UnitsPanel>() = {};
    // Who opens a session has been asked when it was made.
    if (state_.persons_window && state_.tree && !state_.tree->claims.complete() && !opened.has_camera)
        units.show(document.marks().reading), interface.show_left<UnitsPanel>();
    else if (state_.tree && could_mislead(*state_.tree, document.marks().reading))
        interface.show_left<Doctor>();
    doctor.of_mask = state_.tree && io::is_volume(document.session().tree.path);
}

void Viewer::build_interface() {
    Interface& interface = state_.interface;
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(state_.layout.window.x), static_cast<float>(state_.layout.window.y)};
    io.DeltaTime = 1.0F / 60.0F;
    interface_waits_ = !input_.apply(io);
    ImGui::NewFrame();
    const std::pair listed(interface.listed, interface.listed_lesion);
    interface.tool_drawing = input_.tool_drawing();
    if (controls_) controls_->clear();
    widgets::note_controls(controls_ ? &*controls_ : nullptr);
    InterfaceContext context = state_.context();
    draw_interface(context);
    widgets::note_controls(nullptr);
    ImGui::Render();
    if (listed != std::pair(interface.listed, interface.listed_lesion) || interface.between_menus()) state_.redraw();
    if (state_.frames_left > 0) --state_.frames_left;
    if (std::exchange(dialog_was_open_, interface.dialog_open()) == interface.dialog_open()) return;
    state_.frames_left = kDialogFrames;
    input_.look_again(); // branches under a dialog are not hovered
}

void Viewer::present(unsigned framebuffer) {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glDisable(GL_SCISSOR_TEST);
    glClearColor(theme::kPanel.x, theme::kPanel.y, theme::kPanel.z, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    picture_.present(framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    imgui_->draw(*ImGui::GetDrawData());
}

double Viewer::wait_seconds(double now) const {
    if (state_.frames_left > 0 || interface_waits_ || input_.pick_wanted()) return 0.0;
    if (state_.interface.of<Fly>().playing && !picture_.under_way()) return 0.0;
    double wait = picture_.wait_seconds(now);
    if (input_.pick_pending()) wait = std::min(wait, kPollSeconds);
    if (working()) wait = std::min(wait, kProgressSeconds);
    const double notice_until = state_.interface.notice.until;
    if (now < notice_until) wait = std::min(wait, notice_until - now + 1e-3);
    return wait;
}

bool Viewer::resting() const {
    return !working() && !state_.commands.awaits() && state_.frames_left == 0 && !interface_waits_ &&
           !input_.pick_wanted() && !input_.pick_pending() && !previewer_.drawing() && picture_.resting();
}

std::string Viewer::title() const {
    const Document& document = state_.workspace.document();
    if (!document.has_scene()) return "ramus";
    std::string text(document.has_unsaved_work() ? "*" : ""); // not for changes of the view
    text += document.subject().filename().string();
    text += " \xE2\x80\x93 ramus";
    return text;
}

} // namespace ramus::app
