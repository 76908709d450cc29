// PictureView: the picture in the window. It draws the current document in interactive quality while something moves,
// in full quality once it rests, and refines it while nothing happens. It answers what is at a pixel. Times in seconds.
#pragma once

#include "app/picture/plane_pictures.h"
#include "app/tools/aim.h"
#include "app/window/pace.h"
#include "app/window/picture_drawer.h"
#include "app/window/viewer_state.h"
#include "render/renderer/sheet.h"

#include <memory>
#include <optional>
#include <string>

namespace ramus::app {

class PictureView final : public PictureHost {
public:
    PictureView(ViewerState& state, render::Renderer& renderer, DrawingThread& thread);

    // `dragging`: the user drags the view. True if the picture changed.
    bool draw(bool dragging);
    // Refines the last picture after a while without events. `stirred`: an event has just occurred.
    bool refine(bool stirred);
    void present(unsigned framebuffer);

    void move_camera(const render::Camera& camera); // by the user: without animation
    void stop_gliding() { glide_.reset(); }
    [[nodiscard]] bool gliding() const { return glide_.has_value(); }
    [[nodiscard]] const render::Camera& shown_camera() const { return shown_camera_; } // of the last picture

    // Pixels of the picture as displayed, which may still have another size than the last one drawn. pick() refers to
    // the picture shown now (none: no longer known); the answer to request_pick() arrives a frame or two later.
    [[nodiscard]] Deferred<std::optional<render::Pick>> pick(glm::dvec2 at) { return drawer_.pick(in_shown(at)); }
    void request_pick(glm::dvec2 at) { drawer_.request_pick(in_shown(at)); }
    [[nodiscard]] std::optional<render::Pick> poll_pick() { return drawer_.poll_pick(); }

    // The point under the pointer. point(): sets the pointer's pixel in the picture and in its viewport.
    [[nodiscard]] Aim& aim() { return aim_; }
    void point(glm::dvec2 at, glm::dvec2 in_viewport);
    // The point that the current drag turns about or zooms to; none: no such drag.
    void hold_pivot(const std::optional<glm::dvec3>& pivot) { pivot_ = pivot; }
    // Slices among the vessels, as in the last picture.
    [[nodiscard]] std::vector<render::ScanPlane> scan_planes() const;
    [[nodiscard]] const std::optional<render::ScaleBar>& scale_bar() const { return scale_bar_; } // of the last picture

    [[nodiscard]] int pictures() const { return pictures_; } // how many were shown, without those that refine
    [[nodiscard]] int waits() const {
        return drawer_.waits();
    }                                                    // how often the window waited for drawing longer than a frame
    [[nodiscard]] double wait_seconds(double now) const; // until the next draw(); infinite: only on events
    [[nodiscard]] bool resting() const;                  // full quality, of the current state
    [[nodiscard]] bool refines() const { return refines_; }
    [[nodiscard]] bool under_way() const {
        return drawer_.busy();
    } // a picture is in progress; the window wakes when it is ready
    // Whether the last picture shows the document's tree; false for a while after an edit.
    [[nodiscard]] bool shows_tree() const { return shown_tree_ == state_.workspace.document().tree(); }
    // Whether the ray caster drew the last picture, and its kernel width, perhaps of a surface still in progress.
    [[nodiscard]] bool cast() const { return cast_; }
    [[nodiscard]] float pictured_width() const { return pictured_width_; }

    // PictureHost
    [[nodiscard]] glm::ivec2 picture_size() const override { return state_.viewport_size(); }
    [[nodiscard]] std::shared_ptr<const render::PagedMesh> picture_mesh() const override;
    [[nodiscard]] Result<std::shared_ptr<const render::PagedMesh>> current_mesh() override;
    // What was composed last: shown, or on its way.
    [[nodiscard]] const render::Sheet& sheet() const { return sheet_; }
    Result<render::BranchPicture> branch_picture() override { return deferred_branch_picture().take(); }
    [[nodiscard]] Deferred<Result<render::BranchPicture>> deferred_branch_picture() override;
    [[nodiscard]] std::optional<Deferred<Result<render::Image>>> deferred_picture() override;
    Result<void> write_picture(const std::filesystem::path& path) override;
    Result<void> write_figure(const FigureRequest& request, Job& job) override;
    [[nodiscard]] glm::ivec2 whole_size() const override { return state_.layout.view_size; }
    // Runs `ramus render` in a separate process.
    [[nodiscard]] Result<std::function<Result<void>(Job&)>>
    detached_work(const std::vector<std::string>& words) override;
    Result<render::Image> draw_picture(const Session& session, glm::ivec2 size, const FigureOptions& options) override;
    void camera_leapt() override;
    [[nodiscard]] std::optional<glm::dvec3> looked_at() override {
        return aim_.in_middle(state_.workspace.document().session().camera);
    }
    void flew(int branch, double fraction) override;

private:
    [[nodiscard]] glm::dvec2 in_shown(glm::dvec2 at) const {
        return render::PictureTarget::pixel_presented(drawer_.shown_size(), state_.layout.view_size, at);
    }
    static constexpr float kToolBarHeight = 48.0F; // height of the tool bar over the picture, points
    static constexpr double kGlideSeconds = 0.35;
    static constexpr double kPatience = 0.03;     // seconds per frame that the window waits for a picture
    static constexpr double kUntilTold = 0.25;    // seconds until the window announces that a picture is in progress
    static constexpr double kSlowToRefine = 3.0;  // full pictures that take more seconds are not refined
    static constexpr double kRefiningRest = 0.5;  // seconds without events before refining
    static constexpr double kPollSeconds = 0.004; // interval of polling for depths

    // Time for refining a saved picture while the window waits; pictures of large surfaces stay coarser.
    [[nodiscard]] double keeping_seconds() const { return state_.watched() ? 1.0 : render::kUntilDone; }
    [[nodiscard]] Viewing viewing();
    [[nodiscard]] bool shows_own(const Viewport& viewport) const {
        return is_own(viewport.surface, state_.workspace.document().marks().options);
    }
    [[nodiscard]] render::Camera camera_on_its_way();
    void compose_window(const std::vector<Viewport>& viewports, const ShownSurfaces& surfaces);
    [[nodiscard]] render::Quality quality_now(bool dragging);
    void dress(const std::vector<Viewport>& viewports, const ShownSurfaces& surfaces, render::Quality quality);
    void tell_panels(const std::vector<Viewport>& viewports);
    // How the shown picture changed: its pixels, its geometry.
    struct Taken {
        bool shaded = false, geometry = false;
    };
    void take_picture(double seconds, Taken& taken);
    [[nodiscard]] double patience() const;
    void take(const PictureDrawer::Made& made);
    void tell_preparing();
    [[nodiscard]] bool shows_other_case() const; // the picture still shows the previous document
    void take_depths();
    void ask_depths(bool drawn);
    void tell_nothing_in_view();
    [[nodiscard]] std::optional<render::Scale> scale_now() const;
    [[nodiscard]] render::Sheet sheet_for_keeping(glm::ivec2 size);
    [[nodiscard]] Deferred<Result<render::Image>> picture_for_keeping();
    [[nodiscard]] Viewing viewing_for_keeping(glm::ivec2 size);
    [[nodiscard]] render::Frame frame_for_keeping(const render::Camera& camera, glm::ivec2 size);

    ViewerState& state_;
    PictureDrawer drawer_;
    PlanePictures planes_;
    render::Sheet sheet_; // of the last picture, or of the one in progress
    int pictures_ = 0;
    double begun_at_ = 0.0;                                           // start of that picture
    bool finer_ = false;                                              // the shown picture has been refined
    std::shared_ptr<const tree::VesselTree> begun_tree_, shown_tree_; // of the picture in progress; of the shown one
    std::filesystem::path begun_subject_, shown_subject_;             // the same
    // Animation to a camera that a command has set.
    struct Glide {
        render::Camera from;
        double since;
    };
    std::optional<Glide> glide_;
    render::Camera shown_camera_;
    Aim aim_;
    std::optional<glm::dvec3> pivot_;
    std::optional<render::ScaleBar> scale_bar_;
    bool depths_wanted_ = false, depths_pending_ = false; // to be requested; requested
    bool depths_put_off_ = false, has_drawn_ = false;     // until the next frame; a picture was drawn
    Pace pace_;
    render::Quality quality_ = render::Quality::kFull; // of the last picture
    bool cast_ = false;                                // drawn by the ray caster, not from a mesh
    float pictured_width_ = 0.0F;
    bool awaits_ = false;                                  // the picture stays until the surface is ready
    std::shared_ptr<const render::PagedMesh> told_coarse_; // the user knows that its preview is shown
    std::string drawing_problem_;                          // why the last picture failed; empty: it did not
    bool upload_pending_ = false;                          // the surface is not completely on the graphics card
    bool unfinished_ = false;                              // the picture at rest is being drawn in parts
    double full_seconds_ = 0.0;                            // time of the last full picture
    double stirred_at_ = 0.0;                              // time of the last event
    bool refines_ = false;                                 // the picture will be refined
};

} // namespace ramus::app
