#include "render/renderer/partial_view.h"

#include "core/base/stopwatch.h"

#include <algorithm>

namespace ramus::render {

bool PartialView::draw_on(double seconds) {
    const Stopwatch watch;
    const bool at_once = seconds == kUntilDone;
    bool worked = false;
    while (!whole_) {
        if (worked && watch.seconds() >= seconds) return false;
        if (!at_once && !fences_[0].passed(seconds - watch.seconds())) return false;
        whole_ = !drawing_.resume();
        worked = true;
        if (at_once) continue;
        std::rotate(fences_.begin(), fences_.begin() + 1, fences_.end());
        fences_.back().put();
    }
    if (at_once) return true;
    for (Fence& fence : fences_)
        if (!fence.passed(seconds - watch.seconds())) return false;
    return !worked || watch.seconds() < seconds; // the shading is a part by itself
}

} // namespace ramus::render
