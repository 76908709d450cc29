#include "render/renderer/refinement.h"

#include "core/base/stopwatch.h"
#include "render/gl/gl_context.h"

#include <algorithm>

namespace ramus::render {

Refinement::Refinement(Card& card, const Frame& frame, const std::vector<Layer>& layers)
    : card_(card), frame_(frame), layers_(layers) {
    targets_.view = card.targets.view;
    mean_.make(targets_.view.size);
    card.passes.mean.add(targets_.view, card.targets.picture(), mean_);
}

Result<bool> Refinement::add_view(double seconds) {
    if (!targets_.fit(targets_.view.size, targets_.view.samples)) targets_.make(targets_.view.samples);
    card_.passes.begin(targets_.view);
    if (!next_) {
        targets_.view.shift = mean_.views;
        next_ = std::make_unique<PartialView>(card_.passes, card_.scene, targets_, frame_, layers_, false);
    }
    if (!next_->draw_on(seconds)) return false;
    if (const auto& drawn = next_->triangles(); !drawn) return tl::unexpected(drawn.error());
    if (auto shaded = card_.passes.shade.draw_all(next_->subject(), targets_); !shaded)
        return tl::unexpected(shaded.error());
    card_.passes.mean.add(targets_.view, targets_.picture(), mean_);
    next_.reset();
    return true;
}

Result<bool> Refinement::add_views(double seconds) {
    const Stopwatch watch;
    bool any = false;
    do {
        auto added = add_view(seconds - watch.seconds());
        if (!added) return added;
        any |= *added;
    } while (!whole() && watch.seconds() < seconds);
    return any;
}

// A software rasteriser works sequentially for all contexts: presenting a picture waits for all queued parts, so only
// one is queued.
bool PartialView::draw_on(double seconds) {
    const Stopwatch watch;
    Fence& before = is_software_rasteriser() ? fences_.back() : fences_.front();
    const bool at_once = seconds == kUntilDone;
    bool worked = false;
    while (!whole_) {
        if (worked && watch.seconds() >= seconds) return false;
        if (!at_once && !before.passed(seconds - watch.seconds())) return false;
        whole_ = !drawing_.resume();
        worked = true;
        if (at_once) continue;
        std::rotate(fences_.begin(), fences_.begin() + 1, fences_.end());
        fences_.back().put();
    }
    if (at_once) return true;
    for (Fence& fence : fences_)
        if (!fence.passed(seconds - watch.seconds())) return false;
    return !worked || watch.seconds() < seconds; // shading is a separate part
}

} // namespace ramus::render
