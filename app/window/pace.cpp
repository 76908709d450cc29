#include "app/window/pace.h"

#include <algorithm>

namespace ramus::app {

bool Pace::slow(const render::Frame& frame) const {
    if (!frame.mesh || full_seconds_ == 0.0) return software_ && frame.mesh;
    const double more = static_cast<double>(frame.mesh->triangle_count()) / full_triangles_;
    return full_seconds_ * std::max(1.0, more) > kSlowSeconds;
}

render::Quality Pace::quality(const render::Frame& frame, bool moving, bool provisional, double now) {
    View view{frame.mesh, frame.camera, frame.size, frame.states, {}, 0.0F};
    if (frame.surface_awaited) view.awaited = frame.centerlines, view.awaited_width = frame.width;
    // Highlighting shades what is there already.
    for (render::BranchState& state : view.states)
        if (state == render::BranchState::kHighlighted) state = render::BranchState::kNormal;
    if (view != last_) {
        last_ = std::move(view);
        changed_at_ = now;
    }
    provisional_ = provisional;
    const bool resting = now >= rests_at();
    return !resting && (moving || slow(frame)) ? render::Quality::kInteractive : render::Quality::kFull;
}

void Pace::drawn(const render::Frame& frame, double seconds) {
    if (frame.quality != render::Quality::kFull || !frame.mesh) return;
    full_seconds_ = seconds;
    full_triangles_ = std::max(1.0, static_cast<double>(frame.mesh->triangle_count()));
}

} // namespace ramus::app
