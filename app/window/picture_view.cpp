#include "app/window/picture_view.h"

#include "app/panels/contacts_panel.h"
#include "app/panels/doctor_panel.h"
#include "app/panels/fly_panel.h"
#include "app/panels/overview.h"
#include "app/panels/units_panel.h"
#include "app/picture/deviation_colours.h"
#include "app/picture/figures.h"
#include "app/picture/fit.h"
#include "app/picture/other_session.h"
#include "app/window/render_process.h"
#include "render/gl/gl_context.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ramus::app {

PictureView::PictureView(ViewerState& state, render::Renderer& renderer, DrawingThread& thread)
    : state_(state), drawer_(renderer, thread), pace_(render::is_software_rasteriser()) {
    state.workspace.want_cones(render::is_software_rasteriser());
}

Viewing PictureView::viewing() {
    const Interface& interface = state_.interface;
    Viewing viewing{.size = state_.layout.view_size, .pixel_ratio = state_.scale, .hovered = interface.hovered};
    viewing.ground = interface.settings.ground;
    if (interface.listed != tree::kNoBranch) viewing.hovered = interface.listed;
    viewing.glass = interface.tried_glass;
    viewing.territories_opacity = interface.tried_territories;
    viewing.objects = interface.tried_objects;
    viewing.options = state_.workspace.tried_options();
    viewing.notes = interface.left_is<Doctor>() && interface.of<Doctor>().mark;
    viewing.note = interface.of<Doctor>().current;
    if (const auto& tree = state_.workspace.document().tree(); tree && interface.left_is<UnitsPanel>())
        viewing.axes = interface.of<UnitsPanel>().axes(tree->claims, state_.workspace.document().marks().reading);
    if (interface.tool)
        if (const auto moved = interface.tool->moved_measurement())
            viewing.measurement = state_.workspace.document().marks().measurements[*moved].id;
    viewing.planes = planes_.planes(state_.workspace.document().session(), state_.workspace.current_assets());
    viewing.context_awaited = state_.workspace.awaited(WorkKind::kContext);
    viewing.lesion = interface.listed_lesion;
    viewing.contact = interface.left_is<ContactList>() ? interface.of<ContactList>().current : -1;
    return viewing;
}

std::vector<render::ScanPlane> PictureView::scan_planes() const {
    if (sheet_.viewports.empty() || sheet_.viewports.front().slice) return {};
    return sheet_.viewports.front().frame.planes;
}

void PictureView::move_camera(const render::Camera& camera) {
    glide_.reset();
    state_.workspace.document().set_camera(camera);
}

// No animation while a script runs or for a picture of the window.
void PictureView::camera_leapt() {
    if (!state_.watched()) return;
    const bool orthographic = state_.workspace.document().session().camera.orthographic;
    glide_ = Glide{render::with_projection(shown_camera_, orthographic), state_.now};
}

void PictureView::flew(int branch, double fraction) {
    Fly& fly = state_.interface.of<Fly>();
    if (fly.open && branch != fly.branch) fly.playing = false;
    fly.branch = branch;
    fly.fraction = fraction;
    fly.camera = state_.workspace.document().session().camera;
    state_.redraw();
}

// Eases in and out. Saved pictures never show a camera in between; see draw_for_keeping().
render::Camera PictureView::camera_on_its_way() {
    const render::Camera& there = state_.workspace.document().session().camera;
    if (!glide_) return there;
    const double t = (state_.now - glide_->since) / kGlideSeconds;
    if (t < 1.0 && t >= 0.0) return render::interpolated(glide_->from, there, t * t * (3.0 - 2.0 * t));
    glide_.reset();
    return there;
}

bool PictureView::draw(bool dragging) {
    state_.follow_tree();
    if (!state_.watched() && state_.workspace.between_trees()) state_.workspace.await_tree();
    take_depths();
    const std::vector<Viewport> viewports = state_.viewports();
    const ShownSurfaces surfaces = state_.workspace.surfaces();
    compose_window(viewports, surfaces);
    const render::Quality quality = quality_now(dragging);
    dress(viewports, surfaces, quality);
    tell_panels(viewports);
    state_.did("compose");
    Taken taken;
    take_picture(0.0, taken); // of an earlier frame
    const bool watched = state_.watched();
    const bool between = watched && state_.workspace.between_trees(); // the last picture stays
    if (!drawer_.busy() && !between) {
        begun_tree_ = state_.workspace.document().tree();
        begun_subject_ = subject_of(state_.workspace.document().session());
        drawer_.draw(sheet_, kUploadBudget, watched ? kDrawingSeconds : render::kUntilDone);
        begun_at_ = state_.now;
        take_picture(watched ? patience() : render::kUntilDone, taken);
    }
    tell_preparing();
    state_.did("picture");
    ask_depths(taken.geometry);
    tell_nothing_in_view();
    state_.did("depths");
    return taken.shaded;
}

// Seconds that this frame waits for a picture drawn on another thread. After a change of size a software rasteriser
// finishes no sooner than the next frame.
double PictureView::patience() const {
    const bool resized = drawer_.has_picture() && drawer_.shown_size() != sheet_.size;
    if (resized && render::is_software_rasteriser()) return 0.0;
    return std::max(0.0, kPatience - state_.frame.seconds());
}

void PictureView::take_picture(double seconds, Taken& taken) {
    const auto made = drawer_.take(seconds);
    if (!made) return;
    if (made->finer) {
        refines_ = refines_ && made->finer->more;
        finer_ |= made->finer->changed;
        return;
    }
    take(*made);
    taken.shaded |= made->drawn && made->drawn->shaded;
    if (made->drawn && made->drawn->shaded) ++pictures_;
    taken.geometry |= made->drawn && made->drawn->geometry;
}

bool PictureView::shows_other_case() const {
    const Document& document = state_.workspace.document();
    return drawer_.has_picture() && document.has_scene() && shown_subject_ != subject_of(document.session());
}

void PictureView::tell_preparing() {
    const bool waits = drawer_.drawing() && state_.now >= begun_at_ + kUntilTold;
    const Preparing tells = shows_other_case()      ? Preparing::kOtherCase
                            : !waits                ? Preparing::kNothing
                            : drawer_.has_picture() ? Preparing::kPicture
                                                    : Preparing::kFirstPicture;
    if (std::exchange(state_.interface.preparing, tells) != tells) state_.redraw();
}

void PictureView::point(glm::dvec2 at, glm::dvec2 in_viewport) {
    if (sheet_.viewports.empty()) return aim_.point_nowhere();
    aim_.point(render::SheetRenderer::viewport_at(sheet_, at), in_viewport,
               render::kPickRadius * std::max(1.0, double(state_.scale)));
}

void PictureView::take_depths() {
    if (!depths_pending_) return;
    auto depths = drawer_.poll_depths();
    if (!depths) return;
    depths_pending_ = false;
    if (depths->maps) aim_.see(std::move(*depths->maps), state_.workspace.document().session().camera);
}

// Waits for pending depths first, so that some picture's depths arrive while the view moves.
void PictureView::ask_depths(bool drawn) {
    depths_wanted_ |= drawn;
    // The first request creates programs and buffers, so it is postponed after the first picture, which was slow
    // already.
    depths_put_off_ = drawn && !std::exchange(has_drawn_, true);
    if (depths_put_off_ || !depths_wanted_ || depths_pending_) return;
    depths_pending_ = drawer_.request_depths();
    depths_wanted_ = !depths_pending_;
}

// Transparent context is visible but cannot be picked.
void PictureView::tell_nothing_in_view() {
    const render::Frame& frame = sheet_.viewports.front().frame;
    const bool nothing = resting() && !sheet_.viewports.front().slice && frame.mesh &&
                         frame.mesh->triangle_count() > 0 && aim_.sees_nothing() && !context_in_view(frame);
    if (nothing != state_.interface.nothing_in_view) state_.redraw();
    state_.interface.nothing_in_view = nothing;
}

// In perspective a length holds at one depth: at the pivot, at the point under the pointer, or at the visible middle.
std::optional<render::Scale> PictureView::scale_now() const {
    const glm::ivec2 size = state_.viewport_size();
    if (pivot_) return render::scale_at(shown_camera_, size, *pivot_, render::Scale::At::kPivot);
    const auto target = aim_.target(shown_camera_);
    if (!target) return {};
    if (target->on == Aim::On::kPointer)
        return render::scale_at(shown_camera_, size, target->at, render::Scale::At::kPointer);
    return render::scale_of(shown_camera_, size, *aim_.visible());
}

// The first viewport determines the quality of all.
void PictureView::compose_window(const std::vector<Viewport>& viewports, const ShownSurfaces& surfaces) {
    Workspace& workspace = state_.workspace;
    const bool compares = !viewports.front().title.empty();
    SheetViewing sheet_viewing{.blend = state_.interface.tried_blend, .wipe = state_.interface.tried_wipe};
    const bool slices = workspace.document().session().slices.layout != SliceLayout::kPicture;
    if (compares || slices) sheet_viewing.heading_top = static_cast<int>(std::round(kToolBarHeight * state_.scale));
    sheet_ =
        compose_sheet(workspace.document().session(), workspace.current_assets(), surfaces, viewing(), sheet_viewing);
    shown_camera_ = camera_on_its_way();
    render::Frame& first = sheet_.viewports.front().frame;
    first.camera = shown_camera_;
    if (first.mesh && shows_own(viewports.front()) && pace_.slow(first) && !cast_) {
        workspace.await_preview();
        first.mesh = workspace.shown().mesh;
    }
    first.surface_awaited = !compares && workspace.surface_awaited();
}

render::Quality PictureView::quality_now(bool dragging) {
    const render::Frame& first = sheet_.viewports.front().frame;
    const bool better_to_come = state_.workspace.shown().provisional || first.surface_awaited;
    const render::Quality quality = pace_.quality(first, dragging || glide_, better_to_come, state_.now);
    // A picture that already shows the requested surface is not replaced by the previous surface.
    awaits_ = cast_ && first.surface_awaited;
    return awaits_ ? render::Quality::kInteractive : quality;
}

void PictureView::dress(const std::vector<Viewport>& viewports, const ShownSurfaces& surfaces,
                        render::Quality quality) {
    const ReadySurface& shown = state_.workspace.shown();
    const auto scale = scale_now();
    for (std::size_t i = 0; i < sheet_.viewports.size(); ++i) {
        render::Frame& frame = sheet_.viewports[i].frame;
        frame.camera = shown_camera_;
        if (scale || state_.workspace.document().tree()) frame.overlays.scale = scale;
        frame.quality = quality;
        frame.preview = surfaces.preview_of(viewports[i].surface);
        if (!shows_own(viewports[i])) continue;
        put_surface(frame, state_.workspace.assets().deviation, shown.mesh, shown.preview);
    }
}

// The overview and the list show branches as the picture does.
void PictureView::tell_panels(const std::vector<Viewport>& viewports) {
    Interface& interface = state_.interface;
    if (!interface.of<Overview>().open && state_.layout.panel_width == 0) return;
    const auto own = std::ranges::find_if(viewports, [this](const Viewport& each) { return shows_own(each); });
    const auto index = own == viewports.end() ? 0 : own - viewports.begin();
    const render::Frame& frame = sheet_.viewports[static_cast<std::size_t>(index)].frame;
    PictureLook look{frame.colours, frame.hovered, frame.hovered_dependents, frame.lost};
    if (look != interface.picture) state_.redraw();
    interface.picture = std::move(look);
}

void PictureView::take(const PictureDrawer::Made& made) {
    const render::Frame& frame = made.sheet.viewports.front().frame;
    const Result<render::DrawStatistics>& drawn = made.drawn;
    const render::Quality quality = frame.quality;
    const render::DrawStatistics done = drawn.value_or(render::DrawStatistics{});
    // Reported once; the interface continues without a picture.
    const std::string problem = drawn ? std::string() : drawn.error().message();
    if (std::exchange(drawing_problem_, problem) != problem && !problem.empty())
        state_.warn(Warning{drawn.error().what, drawn.error().where, drawn.error().hint});
    if (done.geometry && done.quality == quality) pace_.drawn(frame, done.seconds);
    if (done.geometry) cast_ = done.cones > 0;
    if (!done.of_before) {
        shown_tree_ = begun_tree_;
        shown_subject_ = begun_subject_;
    }
    const bool as_wanted = cast_ || !frame.surface_awaited;
    if (drawn && !done.unfinished)
        pictured_width_ = as_wanted ? frame.width : static_cast<float>(state_.workspace.shown().request.options.width);
    quality_ = drawn ? quality : render::Quality::kFull;
    if (done.coarse && std::exchange(told_coarse_, frame.mesh) != frame.mesh)
        state_.warn(Warning{"The surface is more than graphics memory holds: a coarser one is shown",
                            {},
                            "lower the detail, or hide what is not needed; files that are exported have all of it"});
    scale_bar_ = made.scale_bar;
    if (!done.of_before) {
        std::vector<render::Legend> legends;
        for (const auto& viewport : made.sheet.viewports)
            if (!viewport.frame.overlays.legend.title.empty()) legends.push_back(viewport.frame.overlays.legend);
        if (legends != state_.interface.legends) state_.redraw();
        state_.interface.legends = std::move(legends);
    }
    upload_pending_ = done.pending;
    unfinished_ = done.unfinished;
    if (done.geometry && !cast_ && quality == render::Quality::kFull) full_seconds_ = done.seconds;
    if (!drawn) refines_ = false;                                                       // nothing to refine
    if (done.shaded) refines_ = state_.persons_window && full_seconds_ < kSlowToRefine; // only for a person
}

bool PictureView::refine(bool stirred) {
    if (stirred) stirred_at_ = state_.now;
    if (refines_ && !drawer_.busy() && state_.now >= stirred_at_ + kRefiningRest) {
        drawer_.refine(sheet_, kDrawingSeconds);
        Taken none;
        take_picture(patience(), none);
    }
    return std::exchange(finer_, false);
}

// A picture of one case next to the panel of another would be misleading.
void PictureView::present(unsigned framebuffer) {
    if (shows_other_case()) return;
    const Layout& layout = state_.layout;
    const int below = layout.window.y - layout.view_at.y - layout.view_size.y;
    drawer_.present(framebuffer, {layout.view_at.x, below}, layout.view_size);
}

double PictureView::wait_seconds(double now) const {
    if (drawer_.busy()) { // the window wakes when it is ready
        const double told_at = begun_at_ + kUntilTold;
        return drawer_.drawing() && now < told_at ? told_at - now + 1e-3 : std::numeric_limits<double>::infinity();
    }
    if (state_.watched() && state_.workspace.between_trees()) // the window wakes when there is something to draw
        return std::numeric_limits<double>::infinity();
    if (glide_ || upload_pending_ || unfinished_ || depths_put_off_) return 0.0;
    double wait = std::numeric_limits<double>::infinity();
    if (quality_ != render::Quality::kFull && !awaits_)
        wait = std::min(wait, std::max(0.0, pace_.rests_at() - now) + 1e-3);
    if (depths_pending_) wait = std::min(wait, kPollSeconds);
    if (refines_) wait = std::min(wait, std::max(0.0, stirred_at_ + kRefiningRest - now));
    return wait;
}

bool PictureView::resting() const {
    return !drawer_.drawing() && !state_.workspace.between_trees() && !upload_pending_ && !unfinished_ && !glide_ &&
           !depths_pending_ && !depths_put_off_ && quality_ == render::Quality::kFull;
}

std::shared_ptr<const render::PagedMesh> PictureView::picture_mesh() const { return state_.workspace.shown().mesh; }

Result<std::shared_ptr<const render::PagedMesh>> PictureView::current_mesh() {
    if (state_.workspace.surface_ready()) return picture_mesh();
    return fail("the surface is being computed", {}, "try again when it is there");
}

// As `ramus render` draws the session: without hovering.
render::Frame PictureView::frame_for_keeping(const render::Camera& camera, glm::ivec2 size) {
    state_.follow_tree();
    Workspace& workspace = state_.workspace;
    if (workspace.between_trees()) workspace.await_tree();
    Job job;
    (void)load_context(workspace.assets(), workspace.document().marks(),
                       job); // waits for what a window leaves to a worker
    render::Frame frame =
        compose(workspace.document().session(), workspace.current_assets(), picture_mesh(), viewing_for_keeping(size));
    frame.camera = camera;
    state_.present_again();
    return frame;
}

render::Sheet PictureView::sheet_for_keeping(glm::ivec2 size) {
    state_.follow_tree();
    Workspace& workspace = state_.workspace;
    if (workspace.between_trees()) workspace.await_tree();
    Job job;
    (void)load_context(workspace.assets(), workspace.document().marks(), job); // as above
    state_.present_again();
    return compose_sheet(workspace.document().session(), workspace.current_assets(), workspace.surfaces(),
                         viewing_for_keeping(size));
}

Viewing PictureView::viewing_for_keeping(glm::ivec2 size) {
    return {.size = size,
            .pixel_ratio = state_.scale,
            .planes = planes_.planes(state_.workspace.document().session(), state_.workspace.current_assets())};
}

Deferred<Result<render::Image>> PictureView::picture_for_keeping() {
    const auto draw = [sheet = sheet_for_keeping(state_.layout.view_size), seconds = keeping_seconds()](
                          render::Renderer&, render::SheetRenderer& sheets) -> Result<render::Image> {
        if (const auto drawn = sheets.draw_with_scale(sheet); !drawn) return tl::unexpected(drawn.error());
        if (const auto finer = sheets.refine(sheet, seconds); !finer) return tl::unexpected(finer.error());
        return sheets.read_image();
    };
    return drawer_.later(draw);
}

Result<void> PictureView::write_picture(const std::filesystem::path& path) {
    RAMUS_TRY(image, picture_for_keeping().take());
    return render::write_png(image, path);
}

// A script continues after the file is written.
std::optional<Deferred<Result<render::Image>>> PictureView::deferred_picture() {
    if (!state_.watched()) return {};
    return picture_for_keeping();
}

Result<void> PictureView::write_figure(const FigureRequest& request, Job& job) {
    const auto compose_sized = [this](glm::ivec2 size) -> Result<render::Sheet> { return sheet_for_keeping(size); };
    return drawer_.with([&](render::Renderer& renderer, render::SheetRenderer&) {
        render::SheetRenderer alone(renderer); // as below
        return app::write_figure(alone, compose_sized, whole_size(), request, job);
    });
}

Result<std::function<Result<void>(Job&)>> PictureView::detached_work(const std::vector<std::string>& words) {
    if (!state_.watched()) return std::function<Result<void>(Job&)>();
    const Document& document = state_.workspace.document();
    return render_process_work(document.session(), words, render::is_software_rasteriser());
}

Result<render::Image> PictureView::draw_picture(const Session& session, glm::ivec2 size, const FigureOptions& options) {
    render::Frame frame = frame_for_keeping(session.camera, size);
    const Workspace& workspace = state_.workspace;
    if (session.marks != workspace.document().marks()) {
        Job job;
        RAMUS_TRY(other, compose_as(session, workspace.document(), workspace.assets(), picture_mesh(),
                                    viewing_for_keeping(size), job));
        frame = std::move(other);
    }
    render::Sheet sheet = render::sheet_of(std::move(frame));
    app::dress(sheet, options);
    return drawer_.with([&](render::Renderer& renderer, render::SheetRenderer&) -> Result<render::Image> {
        render::SheetRenderer alone(renderer); // those of other viewports keep what they have
        if (const auto drawn = alone.draw_with_scale(sheet); !drawn) return tl::unexpected(drawn.error());
        if (const auto finer = alone.refine(sheet, keeping_seconds()); !finer) return tl::unexpected(finer.error());
        return alone.read_image();
    });
}

Deferred<Result<render::BranchPicture>> PictureView::deferred_branch_picture() {
    const auto draw = [frame = frame_for_keeping(state_.workspace.document().session().camera, picture_size())](
                          render::Renderer& renderer, render::SheetRenderer&) -> Result<render::BranchPicture> {
        if (const auto drawn = renderer.draw(frame); !drawn) return tl::unexpected(drawn.error());
        return renderer.read_branches();
    };
    return drawer_.later(draw);
}

} // namespace ramus::app
