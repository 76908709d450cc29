// Refinement: replaces a picture by the mean of several views while nothing else is to do, which is finer than four
// samples per pixel. Further views, each shifted by less than a quarter of a pixel, are drawn into targets of their
// own. The first view's targets remain, and answer picks.
#pragma once

#include "render/renderer/card.h"

#include <array>
#include <memory>

namespace ramus::render {

// PartialView: a view drawn in parts, so that a window can answer in between.
class PartialView {
public:
    // Draws into `targets`. References must outlive the object. `moving`: see Passes::draw_view().
    PartialView(Passes& passes, SceneOnCard& scene, ViewTargets& targets, Frame frame, std::vector<Layer> layers,
                bool moving)
        : frame_(std::move(frame)), layers_(std::move(layers)), subject_{frame_, layers_, scene.mesh(), scene},
          drawing_(passes.draw_view(subject_, targets, moving)) {}
    PartialView(const PartialView&) = delete;
    PartialView& operator=(const PartialView&) = delete;

    [[nodiscard]] const Frame& frame() const { return frame_; }
    [[nodiscard]] const std::vector<Layer>& layers() const { return layers_; }
    [[nodiscard]] const Subject& subject() const { return subject_; }
    void shade_as(const Frame& frame) { frame_ = frame; } // must have the same geometry

    // Draws at least one part, until the time is over. True: only the shading is left, and there is time for it.
    [[nodiscard]] bool draw_on(double seconds);
    [[nodiscard]] const Result<std::uint64_t>& triangles() {
        return drawing_.result();
    } // after draw_on() returned true

private:
    Frame frame_;
    std::vector<Layer> layers_;
    Subject subject_;
    InParts<Result<std::uint64_t>> drawing_;
    bool whole_ = false;
    std::array<Fence, 3> fences_; // after the last parts, to limit how many are queued
};

class Refinement {
public:
    // Starts with the shaded view of `frame` in `card` as the first of the sum. References must outlive the object.
    // Throws OutOfGraphicsMemory, as add_views() does.
    Refinement(Card& card, const Frame& frame, const std::vector<Layer>& layers);

    // Continues with further views, at least one part. True: the sum has one more view. Errors leave the picture
    // unchanged.
    [[nodiscard]] Result<bool> add_views(double seconds);
    [[nodiscard]] bool whole() const { return mean_.views == kFineViews; }
    [[nodiscard]] const MeanTarget& mean() const { return mean_; }

private:
    [[nodiscard]] Result<bool> add_view(double seconds);

    Card& card_;
    const Frame& frame_;
    const std::vector<Layer>& layers_;
    MeanTarget mean_;
    ViewTargets targets_; // of the next view
    std::unique_ptr<PartialView> next_;
};

} // namespace ramus::render
