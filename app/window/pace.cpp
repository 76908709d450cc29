#include "app/window/pace.h"

#include <algorithm>

namespace ramus::app {

namespace {

double triangles_of(const render::Frame& frame) {
    double count = frame.mesh ? static_cast<double>(frame.mesh->triangle_count()) : 0.0;
    for (const render::ContextMesh& item : frame.context)
        if (item.shown()) count += static_cast<double>(item.mesh->triangles.size());
    return count;
}

} // namespace

bool Pace::slow(const render::Frame& frame) const {
    const double triangles = triangles_of(frame);
    if (triangles == 0.0 || full_seconds_ == 0.0) return software_ && triangles > 0.0;
    const double more = triangles / full_triangles_;
    return full_seconds_ * std::max(1.0, more) > kSlowSeconds;
}

render::Quality Pace::quality(const render::Frame& frame, bool moving, bool provisional, double now) {
    View view{frame.mesh, frame.camera, frame.size, frame.states, {}, 0.0F};
    if (frame.surface_awaited) view.awaited = frame.centerlines, view.awaited_width = frame.width;
    // Highlighting only shades again.
    for (tree::BranchState& state : view.states)
        if (state == tree::BranchState::kHighlighted) state = tree::BranchState::kNormal;
    if (view != last_) {
        last_ = std::move(view);
        changed_at_ = now;
    }
    provisional_ = provisional;
    const bool resting = now >= rests_at();
    return !resting && (moving || slow(frame)) ? render::Quality::kInteractive : render::Quality::kFull;
}

void Pace::drawn(const render::Frame& frame, double seconds) {
    const double triangles = triangles_of(frame);
    if (frame.quality != render::Quality::kFull || triangles == 0.0) return;
    full_seconds_ = seconds;
    full_triangles_ = triangles;
}

} // namespace ramus::app
