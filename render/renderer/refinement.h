// Refinement: a picture as the mean of several views, once nothing else is to be done: finer than four samples a pixel.
// Further views, each shifted by less than a quarter of a pixel, are drawn beside the picture, into targets of their
// own. What the first view was drawn into stays, for whoever points at it meanwhile.
#pragma once

#include "render/renderer/card.h"

#include <array>
#include <memory>

namespace ramus::render {

// PartialView: a view that is drawn in parts, so that a window can answer in between.
class PartialView {
public:
    // Into `targets`, which with `passes` and `scene` outlive it. `moving` as for Passes::draw_view().
    PartialView(const Passes& passes, SceneOnCard& scene, ViewTargets& targets, Frame frame, std::vector<Layer> layers,
                bool moving)
        : frame_(std::move(frame)), layers_(std::move(layers)), subject_{frame_, layers_, scene.mesh(), scene},
          drawing_(passes.draw_view(subject_, targets, moving)) {}
    PartialView(const PartialView&) = delete;
    PartialView& operator=(const PartialView&) = delete;

    [[nodiscard]] const Frame& frame() const { return frame_; }
    [[nodiscard]] const std::vector<Layer>& layers() const { return layers_; }
    [[nodiscard]] const Subject& subject() const { return subject_; }
    void shade_as(const Frame& frame) { frame_ = frame; } // of the same geometry

    // Draws parts, one at least, until the time is over. True: only the shading is left, and there is time for it.
    [[nodiscard]] bool draw_on(double seconds);
    [[nodiscard]] const Result<std::uint64_t>& triangles() { return drawing_.result(); } // after that

private:
    Frame frame_;
    std::vector<Layer> layers_;
    Subject subject_;
    InParts<Result<std::uint64_t>> drawing_;
    bool whole_ = false;
    std::array<Fence, 3> fences_; // behind the last parts: more would only queue up
};

class Refinement {
public:
    // Of the view in `card`, of `frame`, which has been shaded and is the first of the sum. All of them outlive it.
    // Throws OutOfGraphicsMemory, as add_views() does.
    Refinement(Card& card, const Frame& frame, const std::vector<Layer>& layers);

    // Draws on at further views, one part at least; true: there is one more in the sum. Whatever stops it leaves the
    // picture as it is.
    [[nodiscard]] Result<bool> add_views(double seconds);
    [[nodiscard]] bool whole() const { return mean_.views == kFineViews; }
    [[nodiscard]] const MeanTarget& mean() const { return mean_; }

private:
    [[nodiscard]] Result<bool> add_view(double seconds);

    Card& card_;
    const Frame& frame_;
    const std::vector<Layer>& layers_;
    MeanTarget mean_;
    ViewTargets targets_; // that the next view is drawn into
    std::unique_ptr<PartialView> next_;
};

} // namespace ramus::render
