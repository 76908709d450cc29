// Renderer: draws a Frame into a framebuffer of its own, the same way for the window and without one, and answers what
// lies under a pixel. It keeps the last frame's meshes on the graphics card and sends only pages that changed; a change
// of states, colours, hover or selection draws no triangle again, a frame equal to the last one draws nothing.
//
// All calls need the GL context current that was current at create(), the destructor too; after create_later(), that of
// the first draw(). Pixels have their origin at the top left.
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
    // The same, but draw() makes the programs that it needs, and fails where that does: no shader is compiled here.
    [[nodiscard]] static std::unique_ptr<Renderer> create_later(std::size_t glass_bytes = kGlassBytes,
                                                                std::size_t surface_bytes = kMostOfGraphicsMemory);
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    [[nodiscard]] std::size_t surface_bytes() const { return card_.scene.surface_bytes(); } // that surfaces may take

    // Makes the picture of `frame` the current one. Fails on an impossible size or when memory runs out. With a limit
    // in seconds a picture may take several calls. One in full quality goes on where the call before stopped as long as
    // camera, surface, states and size stay; the limit is passed by a part that takes long. The caster's is made on a
    // thread of its own: of a view that moves on some pictures are shown, each whole, and the last.
    [[nodiscard]] Result<DrawStatistics> draw(const Frame& frame, std::size_t upload_budget = kUploadAll,
                                              double seconds = kUntilDone);

    // Makes the current picture finer, where it is a full one that OpenGL has drawn: edges and occlusion of sixteen
    // samples a pixel in place of four, in the time of three more pictures, as many calls as that takes. What is under
    // its pixels stays as it is. The next draw() of another frame begins anew. Where there is no memory for that the
    // picture stays as it is; fails where there is none to show it again, and then there is no picture.
    [[nodiscard]] Result<Refined> refine(double seconds = kUntilDone);

    // The first picture, for which draw() takes the time that it needs, comes in parts, too: for who shows nothing
    // until it is there.
    void let_first_wait() { first_waits_ = true; }
    [[nodiscard]] bool first_waits() const { return first_waits_; }

    [[nodiscard]] bool has_picture() const { return last_.has_value(); }
    // The current picture. Straight alpha when the background is transparent.
    [[nodiscard]] Image read_image() const { return card_.picture.read(); }
    // The same as a texture: sRGB, premultiplied, rows from below. It is another one after a draw() of another size.
    [[nodiscard]] unsigned texture() const { return card_.picture.colour; }
    // What every pixel of the current picture shows, as pick() sees it; waits for the GPU.
    [[nodiscard]] BranchPicture read_branches();
    // Copies the current picture into `framebuffer` (0 = the window's), its lower left corner at (x, y) in GL's sense;
    // as PictureTarget::present() where that shall be filled, and the next picture of that size is on its way. Changes
    // the bound draw framebuffer to that one. The picture's own pixels stay as they are: draw the interface there.
    void present(unsigned framebuffer, int x, int y, glm::ivec2 filled) const {
        card_.picture.present(framebuffer, x, y, filled);
    }
    [[nodiscard]] glm::ivec2 picture_size() const { return card_.picture.size; } // of what texture() has

    // Nearest vessel within the pick radius of pixel (x, y) of the current picture; waits for the GPU.
    [[nodiscard]] Pick pick(double x, double y);
    // The same in the picture that number() said this of, which may be the one before, or one that is not whole since:
    // a person pointed at what was shown. Of an older one, that of the caster perhaps: in the current picture. None:
    // that has another size than `size`, that of the picture that was pointed at.
    [[nodiscard]] std::optional<Pick> pick(double x, double y, int of, glm::ivec2 size);
    // Of the current picture; another one where it shows something else, or from elsewhere. 0: there is none.
    [[nodiscard]] int number() const { return last_ ? number_ : 0; }
    // The same without waiting, for hovering: ask now, look every frame until an answer is there. A newer request
    // replaces an older one.
    void request_pick(double x, double y);
    [[nodiscard]] std::optional<Pick> poll_pick();

    // How far away all is that the current picture shows. False: it cannot tell now; ask again after the next draw().
    bool request_depths();
    [[nodiscard]] std::optional<DepthMap> poll_depths() { return depths_.poll(); }
    [[nodiscard]] std::optional<DepthMap> read_depths(); // waits for the GPU

private:
    Renderer(std::size_t glass_bytes, std::size_t surface_bytes) : card_(glass_bytes, surface_bytes) {}

    // A picture that is on its way.
    struct Unfinished {
        Frame wanted; // as draw() was given it
        PartialView view;
        double seconds; // that it has taken
    };
    // What makes a picture of a frame.
    enum class Plan {
        kNothing, // it is the one that is shown
        kGoOn,    // the one that is on its way
        kCast,    // the caster
        kShow,    // what is there, with other pictures over it
        kShade,   // the passes, from the shading on
        kDraw,    // all passes
    };

    Result<DrawStatistics> draw_all(const Frame& wanted, std::size_t upload_budget, double seconds);
    [[nodiscard]] Plan plan_for(const Frame& wanted, const Frame& frame, const std::vector<Layer>& layers) const;
    [[nodiscard]] bool moves(const Frame& wanted, const Frame& frame) const;
    // Makes what the plan needs, unless it is there: programs, and what passes draw into. Whether the latter was made.
    Result<bool> resize(const Frame& frame, Plan plan);
    Result<void> fit_picture(glm::ivec2 size);
    [[nodiscard]] ViewSetup cast_view(const Subject& subject) const;
    std::uint64_t cast(const Subject& subject);
    // What the caster has made on its thread within the time, perhaps of a frame before, is shown; what the subject
    // shows is begun where that is another. False: nothing new is shown.
    Result<bool> cast_in_time(const Subject& subject, double seconds, DrawStatistics& done);
    Result<void> show_cast(CastPass::Made made);
    Result<void> back_to_cast();
    // What the plan draws into, and its first part begun. True: making it took as long as a part.
    Result<bool> make_room(Plan plan, const Frame& wanted, const Frame& frame, const std::vector<Layer>& layers);
    void go_on_or_give_up(Plan plan, const Frame& wanted, const Frame& frame);
    void begin(const Frame& wanted, const Frame& frame, const std::vector<Layer>& layers);
    Result<bool> draw_parts(double seconds, DrawStatistics& done);
    Result<Region> shade(const Subject& subject, Plan plan);
    void show(const Subject& subject, const Region& region);
    Result<void> begin_refinement();
    Result<bool> add_views(double seconds); // to it; true: there is one more
    Result<void> show_mean();               // of these views
    // `work()`, which makes part of a picture; where memory runs out nothing is kept, and it is an error.
    template <class Work> auto or_let_go(const Work& work) -> decltype(work());
    void finish();  // what is on its way
    void give_up(); // that, or further views of what is shown
    tl::unexpected<Error> failed(const Error& error);
    void let_go();
    [[nodiscard]] Subject subject_of(const Frame& frame, const std::vector<Layer>& layers) {
        return {frame, layers, card_.scene.mesh(), card_.scene};
    }

    // A picture whose ids and depths are still there.
    struct Under {
        int number = 0; // 0: none
        ViewSetup view;
        Camera camera;
        float pixel_ratio = 1.0F;
    };
    [[nodiscard]] static Pick pick_in(const Under& under, const ResolvedTarget& from, double x, double y);
    [[nodiscard]] Pick pick_in_cast(const Under& under, double x, double y) const;
    [[nodiscard]] Under next_under(const Frame& frame, const ViewSetup& view);
    void keep_under();

    Card card_;
    PictureState state_;
    int number_ = 0;
    Under in_targets_, in_kept_, in_cast_; // what the targets hold, what was kept of them, and the caster shown
    KeptTarget kept_;
    std::unique_ptr<Unfinished> unfinished_; // while the state is partial
    std::unique_ptr<Refinement> refinement_; // while it is refining
    std::optional<Frame> last_;              // the frame that is shown; none: the state is kEmpty
    std::vector<Layer> last_layers_;
    bool first_waits_ = false;
    ViewSetup shown_view_;                         // that it was drawn from; targets may have another one already
    std::shared_ptr<const PagedMesh> wanted_mesh_; // of the last frame that triangles were drawn for, there or not
    PickRequest request_;
    DepthRequest depths_;
};

} // namespace ramus::render
