#include "app/window/viewer.h"

#include "app/window/theme.h"
#include "render/gl/gl_context.h"

#include <algorithm>
#include <glad/gl.h>
#include <imgui.h>
#include <limits>

namespace ramus::app {

Viewer::Viewer(Workspace& workspace, render::Renderer& renderer)
    : workspace_(workspace), renderer_(renderer), sheets_(renderer), pace_(render::is_software_rasteriser()) {}

Result<std::unique_ptr<Viewer>> Viewer::create(Workspace& workspace, render::Renderer& renderer, float scale) {
    std::unique_ptr<Viewer> viewer(new Viewer(workspace, renderer));
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // nothing of the interface is worth a file in the user's folder
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    io.ConfigInputTextCursorBlink = false; // a caret that blinks would redraw the window twice a second
    map_keys(io);
    viewer->scale_ = scale;
    if (!io.Fonts->IsBuilt() || theme::scale() != scale) theme::apply(scale);
    auto imgui = ImguiRenderer::create();
    if (!imgui) return tl::unexpected(imgui.error());
    viewer->imgui_ = std::move(*imgui);
    return viewer;
}

void Viewer::resize(glm::ivec2 window, float scale) {
    if (scale != scale_) {
        theme::apply(scale);
        imgui_->upload_fonts();
        scale_ = scale;
    }
    mouse_.set_pixel_ratio(scale);
    layout_ =
        layout_of(window, scale_, interface_.panel_open, interface_.overview.wanted_height(), interface_.panel_points);
    shake();
}

bool Viewer::over_picture(glm::dvec2 at) const {
    const glm::dvec2 in = in_picture(at);
    return in.x >= 0.0 && in.y >= 0.0 && in.x < layout_.view_size.x && in.y < layout_.view_size.y &&
           !interface_.dialog_open() && !interface_takes_mouse(static_cast<float>(at.x), static_cast<float>(at.y));
}

Viewing Viewer::viewing() const {
    Viewing viewing{.size = layout_.view_size, .pixel_ratio = scale_, .hovered = interface_.hovered};
    if (interface_.listed != tree::kNoBranch) viewing.hovered = interface_.listed;
    viewing.glass = interface_.tried_glass;
    viewing.context = interface_.tried_context;
    viewing.options = workspace_.tried_options();
    return viewing;
}

std::vector<ComparedPane> Viewer::panes() const {
    return panes_of(workspace_.document.marks(), layout_.view_size, scale_);
}

glm::dvec2 Viewer::from_pane(glm::dvec2 at) const {
    const std::vector<ComparedPane> all = panes();
    return at + glm::dvec2(all[std::min(pane_, all.size() - 1)].at);
}

glm::dvec2 Viewer::in_pane(glm::dvec2 at) const { return in_picture(at) - from_pane(glm::dvec2(0.0)); }

void Viewer::enter_pane() {
    const glm::dvec2 at = in_picture(pointer_);
    const std::vector<ComparedPane> all = panes();
    pane_ = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (at.x >= all[i].at.x && at.y >= all[i].at.y && at.x < all[i].at.x + all[i].size.x &&
            at.y < all[i].at.y + all[i].size.y)
            pane_ = i;
}

void Viewer::take_news() {
    if (workspace_.update()) shake();
    if (workspace_.arrival_waits() && !interface_.unsaved.next) {
        // Asked once; a dialog that was closed without going on sends the file away.
        if (std::exchange(asked_about_arrival_, true))
            workspace_.send_away();
        else
            when_saved([this] { workspace_.let_in(); });
    }
    if (!workspace_.arrival_waits()) asked_about_arrival_ = false;
    if (const auto opened = workspace_.take_opened()) take_opened(*opened);
    while (const auto path = workspace_.take_read_mesh()) {
        InterfaceContext context{interface_, workspace_, *this, layout_, now_};
        reread_mesh_ = true;
        context.perform("lesion-mesh", {path->string()});
        reread_mesh_ = false;
    }
    while (const auto arguments = workspace_.context.take_ready()) {
        InterfaceContext context{interface_, workspace_, *this, layout_, now_};
        reread_mesh_ = true;
        context.perform("context", *arguments);
        reread_mesh_ = false;
    }
    while (const auto error = workspace_.take_error()) {
        tell(*error);
        // What cannot be recovered now may be thrown away, or left for later.
        if (!std::exchange(recovering_, std::filesystem::path()).empty()) interface_.recovery.open = true;
    }
}

void Viewer::take_pick() {
    if (!pick_pending_) return;
    const auto pick = sheets_.poll_pick();
    if (!pick) return;
    pick_pending_ = false;
    const int hovered =
        pointer_over_picture_ && !mouse_.dragging() && points_at_branches() ? pick->branch : tree::kNoBranch;
    if (hovered != interface_.hovered) shake();
    interface_.hovered = hovered;
}

void Viewer::ask_pick() {
    if (!pick_wanted_ || mouse_.held()) return;
    pick_wanted_ = false;
    pointer_over_picture_ = over_picture(pointer_);
    interface_.tooltip = pointer_over_picture_ && points_at_branches();
    if (!interface_.tooltip) {
        if (interface_.hovered != tree::kNoBranch) shake();
        interface_.hovered = tree::kNoBranch;
        return;
    }
    sheets_.request_pick(in_picture(pointer_));
    pick_pending_ = true;
}

// Nobody looks on while a script runs or a picture of the window is made.
void Viewer::camera_leapt() {
    if (!unhurried())
        glide_ = Glide{render::with_projection(shown_camera_, workspace_.document.session().camera.orthographic), now_};
}

// Slow at both ends. A picture that is asked for is never one on the way: see draw_for_keeping().
render::Camera Viewer::camera_on_its_way() {
    const render::Camera& there = workspace_.document.session().camera;
    if (!glide_) return there;
    const double t = (now_ - glide_->since) / kGlideSeconds;
    if (t < 1.0 && t >= 0.0) return render::interpolated(glide_->from, there, t * t * (3.0 - 2.0 * t));
    glide_.reset();
    return there;
}

bool Viewer::draw(double now, unsigned framebuffer) {
    now_ = now;
    layout_ = layout_of(layout_.window, scale_, interface_.panel_open, interface_.overview.wanted_height(),
                        interface_.panel_points);
    take_news();
    layout_.panes_at.clear();
    for (const ComparedPane& pane : panes()) layout_.panes_at.push_back(pane.at);
    layout_.pane_size = picture_size();
    // Of the picture that is there: where nothing else moves, this very frame shows what the pointer came to.
    ask_pick();
    take_pick();

    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(layout_.window.x), static_cast<float>(layout_.window.y)};
    io.DeltaTime = 1.0F / 60.0F;
    interface_waits_ = !input_.apply(io);
    ImGui::NewFrame();
    const int listed = interface_.listed;
    interface_.tool_drawing =
        interface_.tool ? interface_.tool->drawing(pointing(tool_mouse_.modifiers())) : ToolDrawing{};
    InterfaceContext context{interface_, workspace_, *this, layout_, now};
    if (controls_) controls_->clear();
    widgets::note_controls(controls_ ? &*controls_ : nullptr);
    draw_interface(context);
    widgets::note_controls(nullptr);
    ImGui::Render();
    if (listed != interface_.listed) shake();
    if (frames_left_ > 0) --frames_left_;
    if (std::exchange(dialog_was_open_, interface_.dialog_open()) != interface_.dialog_open()) {
        frames_left_ = kDialogFrames;
        pick_wanted_ = true; // what is under a dialog is not under the pointer
    }

    const std::vector<ComparedPane> all_panes = panes();
    const bool compares = !all_panes.front().title.empty();
    SheetViewing sheet_viewing{.blend = interface_.tried_blend};
    if (compares) sheet_viewing.heading_top = static_cast<int>(std::round(kToolBarHeight * scale_));
    const ShownSurfaces surfaces = workspace_.surfaces();
    render::Sheet sheet =
        compose_sheet(workspace_.document.session(), workspace_.current_assets(), surfaces, viewing(), sheet_viewing);
    const mesh::Method own_kind = workspace_.document.marks().options.method;
    shown_camera_ = camera_on_its_way();
    render::Frame& frame = sheet.panes.front().frame; // the others are seen as quickly as it is
    frame.camera = shown_camera_;
    if (all_panes.front().surface == own_kind && pace_.slow(frame) && !cast_) {
        workspace_.await_preview();
        frame.mesh = workspace_.shown().mesh;
    }
    frame.surface_awaited = !compares && workspace_.surface_awaited();
    const bool better_to_come = workspace_.shown().provisional || frame.surface_awaited;
    render::Quality quality = pace_.quality(frame, mouse_.dragging() || glide_, better_to_come, now);
    // A picture that shows already what is wanted does not give way to the surface before.
    awaits_ = cast_ && frame.surface_awaited;
    if (awaits_) quality = render::Quality::kInteractive;
    for (std::size_t i = 0; i < sheet.panes.size(); ++i) {
        render::Frame& one = sheet.panes[i].frame;
        one.camera = shown_camera_;
        one.quality = quality;
        one.preview = surfaces.preview_of(all_panes[i].surface);
        if (all_panes[i].surface != own_kind) continue;
        one.mesh = workspace_.shown().mesh;
        one.preview = workspace_.shown().preview;
    }
    if (interface_.overview.open || layout_.panel_width > 0) {
        const auto own = std::ranges::find(all_panes, own_kind, &ComparedPane::surface);
        const render::Frame& looks =
            own == all_panes.end() ? frame : sheet.panes[static_cast<std::size_t>(own - all_panes.begin())].frame;
        PictureLook look{looks.colours, looks.hovered, looks.hovered_dependents, looks.lost};
        if (look != interface_.picture) shake();
        interface_.picture = std::move(look);
    }
    const auto drawn = sheets_.draw(sheet, kUploadBudget, unhurried() ? render::kUntilDone : kDrawingSeconds);
    const render::DrawStatistics done = drawn.value_or(render::DrawStatistics{});
    // Said once; the interface goes on without a picture.
    const std::string problem = drawn ? std::string() : drawn.error().message();
    if (std::exchange(drawing_problem_, problem) != problem && !problem.empty()) say(problem);
    if (done.geometry && done.quality == quality) pace_.drawn(frame, done.seconds);
    if (done.geometry) cast_ = done.cones > 0;
    const bool as_wanted = cast_ || !frame.surface_awaited;
    if (drawn && !done.unfinished)
        pictured_width_ = as_wanted ? frame.width : static_cast<float>(workspace_.shown().request.options.width);
    quality_ = drawn ? quality : render::Quality::kFull;
    if (done.coarse && std::exchange(told_coarse_, frame.mesh) != frame.mesh)
        say("The surface is more than graphics memory holds: a coarser one is shown");
    upload_pending_ = done.pending;
    unfinished_ = done.unfinished;
    if (done.shaded) pick_wanted_ = true;
    ask_pick();

    const std::uint64_t looks = fingerprint(*ImGui::GetDrawData());
    if (done.geometry && !cast_ && quality == render::Quality::kFull) full_seconds_ = done.seconds;
    if (done.shaded) refines_ = keeps_files_ && full_seconds_ < kSlowToRefine; // somebody is there to see it
    if (done.shaded || looks != drawn_ || !resting()) stirred_at_ = now;
    const bool finer = refines_ && now >= stirred_at_ + kRefiningRest && refine(sheet);
    if (!done.shaded && !finer && looks == drawn_) return false;
    drawn_ = looks;
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glDisable(GL_SCISSOR_TEST);
    glClearColor(theme::kPanel.x, theme::kPanel.y, theme::kPanel.z, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    sheets_.present(framebuffer, layout_.view_at.x, layout_.window.y - layout_.view_at.y - layout_.view_size.y);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    imgui_->draw(*ImGui::GetDrawData());
    return true;
}

bool Viewer::refine(const render::Sheet& sheet) {
    const auto done = sheets_.refine(sheet, kDrawingSeconds);
    refines_ = done && done->more;
    return done && done->changed;
}

double Viewer::wait_seconds(double now) const {
    if (frames_left_ > 0 || glide_ || interface_.fly.playing || interface_waits_ || pick_wanted_ || upload_pending_ ||
        unfinished_)
        return 0.0;
    double wait = std::numeric_limits<double>::infinity();
    if (pick_pending_) wait = std::min(wait, kPollSeconds);
    if (workspace_.busy()) wait = std::min(wait, kProgressSeconds);
    if (quality_ != render::Quality::kFull && !awaits_)
        wait = std::min(wait, std::max(0.0, pace_.rests_at() - now) + 1e-3);
    if (refines_) wait = std::min(wait, std::max(0.0, stirred_at_ + kRefiningRest - now));
    if (now < interface_.notice.until) wait = std::min(wait, interface_.notice.until - now + 1e-3);
    return wait;
}

bool Viewer::resting() const {
    return !workspace_.busy() && frames_left_ == 0 && !interface_waits_ && !pick_wanted_ && !pick_pending_ &&
           !upload_pending_ && !unfinished_ && !glide_ && quality_ == render::Quality::kFull;
}

std::string Viewer::title() const {
    const Document& document = workspace_.document;
    if (!document.tree()) return "ramus";
    std::string text(document.modified() ? "*" : "");
    text += document.session().tree.path.filename().string();
    text += " \xE2\x80\x93 ramus";
    return text;
}

std::shared_ptr<const render::PagedMesh> Viewer::picture_mesh() const { return workspace_.shown().mesh; }

// As `ramus render` draws the session: without what the pointer is doing.
Result<void> Viewer::draw_for_keeping(const render::Camera& camera, glm::ivec2 size) {
    Job job;
    (void)load_context(workspace_.assets, workspace_.document.marks(),
                       job); // waits for what a window leaves to a worker
    render::Frame frame = compose(workspace_.document.session(), workspace_.current_assets(), picture_mesh(),
                                  {.size = size, .pixel_ratio = scale_});
    frame.camera = camera;
    if (const auto drawn = renderer_.draw(frame); !drawn) return tl::unexpected(drawn.error());
    shake();
    drawn_ = 0;
    return {};
}

Result<void> Viewer::write_picture(const std::filesystem::path& path) {
    Job job;
    (void)load_context(workspace_.assets, workspace_.document.marks(), job); // as above
    const render::Sheet sheet =
        compose_sheet(workspace_.document.session(), workspace_.current_assets(), workspace_.surfaces(),
                      {.size = layout_.view_size, .pixel_ratio = scale_});
    if (const auto drawn = sheets_.draw(sheet); !drawn) return tl::unexpected(drawn.error());
    if (const auto finer = sheets_.refine(sheet, keeping_seconds()); !finer) return tl::unexpected(finer.error());
    shake();
    drawn_ = 0;
    return render::write_png(sheets_.read_image(), path);
}

Result<render::Image> Viewer::draw_picture(const render::Camera& camera, glm::ivec2 size) {
    if (auto drawn = draw_for_keeping(camera, size); !drawn) return tl::unexpected(drawn.error());
    (void)renderer_.refine(keeping_seconds());
    return renderer_.read_image();
}

Result<render::BranchPicture> Viewer::branch_picture() {
    if (auto drawn = draw_for_keeping(workspace_.document.session().camera, picture_size()); !drawn)
        return tl::unexpected(drawn.error());
    return renderer_.read_branches();
}

void Viewer::say(const std::string& sentence) {
    interface_.tell(sentence, now_);
    shake();
}

Result<void> Viewer::toggle(std::string_view part) {
    if (part == "help")
        interface_.help_open = !interface_.help_open;
    else if (part == "overview")
        interface_.overview.open = !interface_.overview.open;
    else if (part == "fly-along")
        interface_.fly.open = interface_.fly.playing = false;
    else if (part == "panel")
        interface_.panel_open = !interface_.panel_open;
    else
        interface_.planning = part == "plan" || (part == "other" && !interface_.planning), interface_.panel_open = true;
    shake();
    return {};
}

Result<void> Viewer::arrange(std::string_view part, std::string_view setting) {
    shake();
    if (part == "name") {
        const int id = std::stoi(std::string(setting));
        const BranchNames& names = workspace_.document.marks().names;
        interface_.rename.show(id, names.contains(id) ? names.at(id) : std::string{});
        return {};
    }
    if (part == "fly-along") {
        interface_.fly.open = true;
        interface_.fly.playing = false;
        interface_.fly.branch = std::stoi(std::string(setting));
        interface_.fly.fraction = 0.0;
        interface_.fly.selection = workspace_.document.marks().selection;
        return {};
    }
    if (part != "overview") return toggle(part);
    interface_.overview.open = setting != "off";
    if (setting == "generation") interface_.overview.depth = OverviewDepth::kGeneration;
    if (setting == "distance") interface_.overview.depth = OverviewDepth::kDistance;
    return {};
}

bool Viewer::shows(std::string_view part) const {
    if (part == "fly-along") return interface_.fly.open;
    return part == "overview" ? interface_.overview.open
           : part == "help"   ? interface_.help_open
                              : interface_.panel_open;
}

void Viewer::flew(int branch, double fraction) {
    if (interface_.fly.open && branch != interface_.fly.branch) interface_.fly.playing = false;
    interface_.fly.branch = branch;
    interface_.fly.fraction = fraction;
    shake();
}

bool Viewer::dismiss() {
    if (interface_.dismiss()) return true;
    if (!interface_.tool) return false;
    if (!interface_.tool->escape()) (void)use_tool(kNavigate);
    return true;
}

Result<void> Viewer::use_tool(std::string_view name) {
    const ToolKind* kind = find_tool(name);
    if (kind == nullptr) return fail("there is no tool " + std::string(name));
    interface_.tool_kind = kind;
    interface_.tool = kind->make != nullptr ? kind->make() : nullptr;
    tool_mouse_.abandon();
    pick_wanted_ = true;
    shake();
    return {};
}

} // namespace ramus::app
