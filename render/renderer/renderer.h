// Renderer: draws a Frame into its own framebuffer, identically with and without a window, and answers what lies under
// a pixel. It keeps meshes on the graphics card and sends only pages that changed. A change of states, colours, hover
// or selection draws no triangle again, and planes of a scan move without shading again; a frame equal to the last one
// draws nothing.
//
// All calls, including the destructor, need the same current GL context: that of create(), or after create_later() that
// of the first draw(). Pixels count from the top left. For the call order see draw(), refine() and request_pick().
#pragma once

#include "render/renderer/card.h"
#include "render/renderer/depth_request.h"
#include "render/renderer/drawn.h"
#include "render/renderer/picking.h"
#include "render/renderer/picture_state.h"
#include "render/renderer/refinement.h"

#include <memory>
#include <optional>
#include <vector>

namespace ramus::render {

class Renderer {
public:
    [[nodiscard]] static Result<std::unique_ptr<Renderer>> create(std::size_t glass_bytes = kGlassBytes,
                                                                  std::size_t surface_bytes = kMostOfGraphicsMemory);
    // The same, but compiles no shader: draw() builds the programs that it needs and reports their errors.
    [[nodiscard]] static std::unique_ptr<Renderer> create_later(std::size_t glass_bytes = kGlassBytes,
                                                                std::size_t surface_bytes = kMostOfGraphicsMemory);
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    [[nodiscard]] std::size_t surface_bytes() const { return card_.scene.surface_bytes(); } // limit for surfaces

    // Makes the picture of `frame` the current one. Fails for an invalid size or if memory runs out. With a limit in
    // seconds a picture may take several calls, and a long part may exceed the limit. A picture in full quality
    // continues where the last call stopped as long as camera, surface, states and size stay the same. The caster works
    // on its own thread: while the view moves, some pictures are skipped, but each shown picture is complete and the
    // last one is always shown.
    [[nodiscard]] Result<DrawStatistics> draw(const Frame& frame, std::size_t upload_budget = kUploadAll,
                                              double seconds = kUntilDone);

    // Refines the current picture if it is a full one drawn by OpenGL: sixteen samples per pixel instead of four for
    // edges and occlusion. Takes the time of three more pictures, over any number of calls. Picks are unaffected. The
    // next draw() of another frame starts anew. Without enough memory the picture stays as it is; if even showing it
    // again fails, returns an error and there is no picture.
    [[nodiscard]] Result<Refined> refine(double seconds = kUntilDone);

    // By default draw() ignores the time limit for the first picture. This lets the first picture come in parts, too,
    // for callers that show nothing until it is complete.
    void draw_first_in_parts() { first_in_parts_ = true; }
    [[nodiscard]] bool draws_first_in_parts() const { return first_in_parts_; }

    [[nodiscard]] bool has_picture() const { return last_.has_value(); }
    // The current picture. Straight alpha when the background is transparent.
    [[nodiscard]] Image read_image() const { return card_.picture.read(); }
    // The same as a texture: sRGB, premultiplied, rows from below. A draw() with another size replaces the texture.
    [[nodiscard]] unsigned texture() const { return card_.picture.colour; }
    // The branch at every pixel of the current picture, as pick() finds it; waits for the GPU.
    [[nodiscard]] BranchPicture read_branches();
    // Copies the current picture into `framebuffer` (0: the window's), its lower left corner at (x, y), y from below.
    // While a picture of size `filled` is still being drawn, scales the current one as PictureTarget::present() does.
    // Leaves `framebuffer` bound for drawing. The copy does not change the renderer's picture: draw user interfaces
    // into the copy.
    void present(unsigned framebuffer, int x, int y, glm::ivec2 filled) const {
        card_.picture.present(framebuffer, x, y, filled);
    }
    [[nodiscard]] glm::ivec2 picture_size() const { return card_.picture.size; } // of texture()

    // Nearest vessel within the pick radius of pixel (x, y) of the current picture; waits for the GPU.
    [[nodiscard]] Pick pick(double x, double y);
    // The same in the picture with this number(), if its ids are still there: people point at the picture that was
    // shown, which may not be the current one. Otherwise picks in the current picture; none if its size is not `size`,
    // that of the picture pointed at.
    [[nodiscard]] std::optional<Pick> pick(double x, double y, int of, glm::ivec2 size);
    // Number of the current picture; changes when it shows something else or from elsewhere. 0: no picture.
    [[nodiscard]] int number() const { return last_ ? number_ : 0; }
    // Asynchronous pick, for hovering: request it, then poll every frame. A newer request replaces an older one.
    void request_pick(double x, double y);
    [[nodiscard]] std::optional<Pick> poll_pick();

    // Requests the depths of the current picture. False: not possible now; ask again after the next draw().
    bool request_depths();
    [[nodiscard]] std::optional<DepthMap> poll_depths() { return depths_.poll(); }
    [[nodiscard]] std::optional<DepthMap> read_depths(); // waits for the GPU

private:
    Renderer(std::size_t glass_bytes, std::size_t surface_bytes) : card_(glass_bytes, surface_bytes) {}

    // A picture that is being drawn.
    struct Unfinished {
        Frame wanted; // the argument of draw()
        PartialView view;
        double seconds; // time taken so far
    };
    // How to get the picture of a frame.
    enum class Plan {
        kNothing, // it is shown already
        kGoOn,    // continue the picture in progress
        kCast,    // let the caster draw it
        kShow,    // draw only the overlays again
        kSlice,   // put other planes among what was shaded
        kShade,   // run the passes from the shading on
        kDraw,    // run all passes
    };

    Result<DrawStatistics> draw_all(const Frame& wanted, std::size_t upload_budget, double seconds);
    [[nodiscard]] Plan plan_for(const Frame& wanted, const Frame& frame, const std::vector<Layer>& layers) const;
    [[nodiscard]] bool moves(const Frame& wanted, const Frame& frame) const;
    // Creates the programs and targets that the plan needs. Returns whether targets were created.
    Result<bool> resize(const Frame& frame, Plan plan);
    Result<void> fit_picture(glm::ivec2 size);
    [[nodiscard]] ViewSetup cast_view(const Subject& subject) const;
    std::uint64_t cast(const Subject& subject);
    // Shows the picture that the caster finishes within the time, perhaps of an earlier frame, and starts the subject's
    // if that differs. False: nothing new is shown.
    Result<bool> cast_in_time(const Subject& subject, double seconds, DrawStatistics& done);
    Result<void> show_cast(CastPass::Made made);
    Result<void> back_to_cast();
    // Creates the plan's targets and starts the drawing. True: creating them took as long as a part.
    Result<bool> make_room(Plan plan, const Frame& wanted, const Frame& frame, const std::vector<Layer>& layers);
    void go_on_or_give_up(Plan plan, const Frame& wanted, const Frame& frame);
    void begin(const Frame& wanted, const Frame& frame, const std::vector<Layer>& layers);
    Result<bool> draw_parts(double seconds, DrawStatistics& done);
    Result<Region> shade(const Subject& subject, Plan plan);
    void show(const Subject& subject, const Region& region);
    Result<void> begin_refinement();
    Result<bool> add_views(double seconds); // to the refinement; true: one more view
    Result<void> show_mean();               // of the refinement's views
    // Runs `work()`. If memory runs out, releases everything and returns an error.
    template <class Work> auto or_release(const Work& work) -> decltype(work());
    void finish();  // the picture in progress
    void give_up(); // discards the picture in progress, or the refinement
    tl::unexpected<Error> failed(const Error& error);
    void release();
    [[nodiscard]] Subject subject_of(const Frame& frame, const std::vector<Layer>& layers) {
        return {frame, layers, card_.scene.mesh(), card_.scene};
    }

    // Identifies a picture whose ids and depths still exist, for picks.
    struct PickSource {
        int number = 0; // 0: none
        ViewSetup view;
        Camera camera;
        float pixel_ratio = 1.0F;
        std::vector<ScanPlane> planes;
    };
    [[nodiscard]] static Pick pick_in(const PickSource& source, const ResolvedTarget& from, double x, double y);
    [[nodiscard]] Pick pick_in_cast(const PickSource& source, double x, double y) const;
    [[nodiscard]] PickSource next_pick_source(const Frame& frame, const ViewSetup& view);
    void keep_pick_source();

    Card card_;
    PictureState state_;
    int number_ = 0;
    PickSource in_targets_, in_kept_, in_cast_; // in the targets, in kept_, in the caster
    KeptTarget kept_;
    std::unique_ptr<Unfinished> unfinished_; // not null while the state is partial
    std::unique_ptr<Refinement> refinement_; // not null while it is refining
    std::optional<Frame> last_;              // the shown frame; none: the state is kEmpty
    std::vector<Layer> last_layers_;
    bool first_in_parts_ = false;
    ViewSetup shown_view_;                         // view of the shown frame; the targets may have the next one
    std::shared_ptr<const PagedMesh> wanted_mesh_; // of the last frame drawn with triangles, whether sent or not
    PickRequest request_;
    DepthRequest depths_;
};

} // namespace ramus::render
