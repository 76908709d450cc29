// Refinement: a picture as the mean of several views, once nothing else is to be done: finer than four samples a pixel.
// Further views, each shifted by less than a quarter of a pixel, are drawn beside the picture, into targets of their
// own. What the first view was drawn into stays, for whoever points at it meanwhile.
#pragma once

#include "render/renderer/partial_view.h"

#include <memory>

namespace ramus::render {

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
