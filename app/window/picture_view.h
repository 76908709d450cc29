// PictureView: the picture in the window. It draws the document as it is now, quickly while something moves and in full
// as soon as it rests, and then finer while nothing happens; and it answers what a pixel shows.
#pragma once

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

    // `dragging`: somebody turns the view by hand. True when the picture is another one than before.
    bool draw(bool dragging);
    // Makes the picture that was drawn last finer once nothing has happened for a while; `stirred`: something just has.
    bool refine(bool stirred);
    void present(unsigned framebuffer);

    void move_camera(const render::Camera& camera); // by hand: at once
    void stop_gliding() { glide_.reset(); }
    [[nodiscard]] bool gliding() const { return glide_.has_value(); }
    [[nodiscard]] const render::Camera& shown_camera() const { return shown_camera_; } // of the last picture

    // Pixels of the picture as it is in the window, which may show one of another size yet. The first is of the one
    // that is shown now, or none where it is not known any more; the answer to the second comes a frame or two later.
    [[nodiscard]] Deferred<std::optional<render::Pick>> pick(glm::dvec2 at) { return drawer_.pick(in_shown(at)); }
    void request_pick(glm::dvec2 at) { drawer_.request_pick(in_shown(at)); }
    [[nodiscard]] std::optional<render::Pick> poll_pick() { return drawer_.poll_pick(); }

    // What is pointed at, and a pixel of the picture that the pointer is on, which is `in_viewport` of its viewport.
    [[nodiscard]] Aim& aim() { return aim_; }
    void point(glm::dvec2 at, glm::dvec2 in_viewport);
    // A drag turns the view about this point, or comes nearer to it; none: none does.
    void hold_pivot(const std::optional<glm::dvec3>& pivot) { pivot_ = pivot; }
    [[nodiscard]] const std::optional<render::ScaleBar>& scale_bar() const { return scale_bar_; } // of the last picture

    [[nodiscard]] int waits() const { return drawer_.waits(); } // of the window for what is drawn, beyond a frame's
    [[nodiscard]] double wait_seconds(double now) const; // until it wants to be drawn again; infinite: not by itself
    [[nodiscard]] bool resting() const;                  // full, and of what is known now
    [[nodiscard]] bool refines() const { return refines_; }
    [[nodiscard]] bool under_way() const { return drawer_.busy(); } // a picture is; when it is there the window wakes
    // Whether the last picture is of the document's tree: not yet after an edit.
    [[nodiscard]] bool shows_tree() const { return shown_tree_ == state_.workspace.document().tree(); }
    // What the last picture was made of, and the kernel's width in it: maybe of a surface that is not there yet.
    [[nodiscard]] bool cast() const { return cast_; }
    [[nodiscard]] float pictured_width() const { return pictured_width_; }

    // PictureHost
    [[nodiscard]] glm::ivec2 picture_size() const override { return state_.viewport_size(); }
    [[nodiscard]] std::shared_ptr<const render::PagedMesh> picture_mesh() const override;
    Result<render::BranchPicture> branch_picture() override { return deferred_branch_picture().take(); }
    [[nodiscard]] Deferred<Result<render::BranchPicture>> deferred_branch_picture() override;
    [[nodiscard]] std::optional<Deferred<Result<render::Image>>> deferred_picture() override;
    Result<void> write_picture(const std::filesystem::path& path) override;
    Result<void> write_figure(const FigureRequest& request, Job& job) override;
    [[nodiscard]] glm::ivec2 whole_size() const override { return state_.layout.view_size; }
    // `ramus render` does it, in a process of its own.
    [[nodiscard]] Result<std::function<Result<void>(Job&)>>
    done_elsewhere(const std::vector<std::string>& words) override;
    Result<render::Image> draw_picture(const render::Camera& camera, glm::ivec2 size,
                                       const FigureOptions& options) override;
    void camera_leapt() override;
    [[nodiscard]] std::optional<glm::dvec3> looked_at() override {
        return aim_.in_middle(state_.workspace.document().session().camera);
    }
    void flew(int branch, double fraction) override;

private:
    [[nodiscard]] glm::dvec2 in_shown(glm::dvec2 at) const {
        return render::PictureTarget::pixel_presented(drawer_.shown_size(), state_.layout.view_size, at);
    }
    static constexpr float kToolBarHeight = 48.0F; // points at the top of the picture that the tools' bar takes
    static constexpr double kGlideSeconds = 0.35;
    static constexpr double kPatience = 0.03;     // seconds of a frame: until then it waits for a picture
    static constexpr double kUntilTold = 0.25;    // seconds after which a person is told that there is one to come
    static constexpr double kSlowToRefine = 3.0;  // seconds of a full picture; one that takes more is fine enough
    static constexpr double kRefiningRest = 0.5;  // seconds that nothing happens before the picture gets finer
    static constexpr double kPollSeconds = 0.004; // between looks for depths that are on their way

    // A picture that is kept may take so long to get finer while the window waits; of a large surface it stays coarser.
    [[nodiscard]] double keeping_seconds() const { return state_.watched() ? 1.0 : render::kUntilDone; }
    [[nodiscard]] Viewing viewing() const;
    [[nodiscard]] bool shows_own(const Viewport& viewport) const {
        return is_own(viewport.surface, state_.workspace.document().marks().options);
    }
    [[nodiscard]] render::Camera camera_on_its_way();
    void compose_window(const std::vector<Viewport>& viewports, const ShownSurfaces& surfaces);
    [[nodiscard]] render::Quality quality_now(bool dragging);
    void dress(const std::vector<Viewport>& viewports, const ShownSurfaces& surfaces, render::Quality quality);
    void tell_panels(const std::vector<Viewport>& viewports);
    // What has come of a picture: another one to be shown, with another geometry.
    struct Taken {
        bool shaded = false, geometry = false;
    };
    void take_picture(double seconds, Taken& taken);
    [[nodiscard]] double patience() const;
    void take(const PictureDrawer::Made& made);
    void tell_preparing();
    [[nodiscard]] bool shows_other_case() const; // the picture is still of what was open before
    void take_depths();
    void ask_depths(bool drawn);
    void tell_nothing_in_view();
    [[nodiscard]] std::optional<render::Scale> scale_now() const;
    [[nodiscard]] render::Sheet sheet_for_keeping(glm::ivec2 size);
    [[nodiscard]] Deferred<Result<render::Image>> picture_for_keeping();
    [[nodiscard]] render::Frame frame_for_keeping(const render::Camera& camera, glm::ivec2 size);

    ViewerState& state_;
    PictureDrawer drawer_;
    render::Sheet sheet_;   // of the last picture, or of the one that is on its way
    double begun_at_ = 0.0; // when that was begun
    bool finer_ = false;    // what is shown, since refine() said so
    std::shared_ptr<const tree::VesselTree> begun_tree_, shown_tree_; // of that; of the one that is shown
    std::filesystem::path begun_subject_, shown_subject_;             // in the same way
    // The picture's way to a camera that a command has set.
    struct Glide {
        render::Camera from;
        double since;
    };
    std::optional<Glide> glide_;
    render::Camera shown_camera_;
    Aim aim_;
    std::optional<glm::dvec3> pivot_;
    std::optional<render::ScaleBar> scale_bar_;
    bool depths_wanted_ = false, depths_pending_ = false; // of a picture that has been drawn; they are on their way
    bool depths_put_off_ = false, has_drawn_ = false;     // until the next frame; any picture
    Pace pace_;
    render::Quality quality_ = render::Quality::kFull; // of the last picture
    bool cast_ = false;                                // it was made along centerlines, not of a mesh
    float pictured_width_ = 0.0F;
    bool awaits_ = false;                                  // it stays until the surface comes
    std::shared_ptr<const render::PagedMesh> told_coarse_; // the surface that is shown by its preview
    std::string drawing_problem_;                          // why the last picture could not be drawn; empty: it was
    bool upload_pending_ = false;                          // not all of the surface is on the graphics card
    bool unfinished_ = false;                              // the picture at rest is being made, a part at a time
    double full_seconds_ = 0.0;                            // that the last full picture took
    double stirred_at_ = 0.0;                              // when anything last happened
    bool refines_ = false;                                 // then, the picture gets finer
};

} // namespace ramus::app
