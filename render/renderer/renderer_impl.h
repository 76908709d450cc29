// The renderer's inside: what it has on the card, the state of its picture, and what leads from a frame to the next.
#pragma once

#include "render/renderer/card.h"
#include "render/renderer/picking.h"
#include "render/renderer/picture_state.h"
#include "render/renderer/refinement.h"

#include <memory>
#include <optional>
#include <vector>

namespace ramus::render {

class Renderer::Impl {
public:
    Impl(std::size_t glass_bytes, std::size_t surface_bytes) : card_(glass_bytes, surface_bytes) {}
    Result<void> initialise() { return card_.passes.make(); }
    [[nodiscard]] std::size_t surface_bytes() const { return card_.scene.surface_bytes(); }
    [[nodiscard]] const PictureTarget& picture() const { return card_.picture; }

    Result<DrawStatistics> draw(const Frame& wanted, std::size_t upload_budget, double seconds);
    Refined refine(double seconds);
    BranchPicture read_branches();
    Pick pick(double x, double y);
    void request_pick(double x, double y);
    std::optional<Pick> poll_pick();

private:
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
        kShade,   // the passes, from the shading on
        kDraw,    // all passes
    };

    Result<DrawStatistics> draw_all(const Frame& wanted, std::size_t upload_budget, double seconds);
    [[nodiscard]] Plan plan_for(const Frame& wanted, const Frame& frame, const std::vector<Layer>& layers) const;
    [[nodiscard]] bool moves(const Frame& wanted, const Frame& frame) const;
    Result<void> resize(const Frame& frame, Plan plan);
    std::uint64_t cast(const Subject& subject);
    void begin(const Frame& wanted, const Frame& frame, const std::vector<Layer>& layers);
    Result<bool> draw_parts(double seconds, DrawStatistics& done);
    Result<Region> shade(const Subject& subject, Plan plan);
    void show(const Subject& subject, const Region& region);
    Result<void> begin_refinement();
    [[nodiscard]] ViewSetup shown_view() const;
    void finish();  // what is on its way
    void give_up(); // that, or further views of what is shown
    tl::unexpected<Error> failed(const Error& error);
    void let_go();
    [[nodiscard]] Subject subject_of(const Frame& frame, const std::vector<Layer>& layers) {
        return {frame, layers, card_.scene.mesh(), card_.scene};
    }

    Card card_;
    PictureState state_;
    std::unique_ptr<Unfinished> unfinished_; // while the state is partial
    std::unique_ptr<Refinement> refinement_; // while it is refining
    std::optional<Frame> last_;              // the frame that is shown; none: the state is kEmpty
    std::vector<Layer> last_layers_;
    std::shared_ptr<const PagedMesh> wanted_mesh_; // of the last frame that triangles were drawn for, there or not
    PickRequest request_;
};

} // namespace ramus::render
