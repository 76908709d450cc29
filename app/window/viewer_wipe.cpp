// The part of ViewerInput that is about the line of a wipe.
#include "app/session/numbers.h"
#include "app/window/viewer_input.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ramus::app {

bool ViewerInput::on_wipe_line() const {
    const Comparison& comparison = state_.workspace.document().marks().comparison;
    if (comparison.mode != Comparison::Mode::kWipe || !state_.workspace.document().tree() || !over_picture(pointer_))
        return false;
    constexpr double kGrip = 6.0; // pixels to either side, at a pixel ratio of 1
    return std::abs(in_picture(pointer_).x - comparison.wipe * state_.layout.view_size.x) <=
           kGrip * static_cast<double>(state_.scale);
}

void ViewerInput::drag_wipe_line() {
    const double width = std::max(1, state_.layout.view_size.x);
    state_.interface.tried_wipe = std::clamp((in_picture(pointer_).x - wipe_grip_) / width, 0.0, 1.0);
}

void ViewerInput::drop_wipe_line() {
    state_.interface.wipe_held = false;
    if (const auto there = std::exchange(state_.interface.tried_wipe, std::nullopt))
        state_.perform("compare-wipe", {digits(*there, 4)});
    pick_wanted_ = true;
}

} // namespace ramus::app
