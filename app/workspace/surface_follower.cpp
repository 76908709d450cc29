#include "app/workspace/surface_follower.h"

#include <algorithm>

namespace ramus::app {

void SurfaceFollower::open(std::shared_ptr<SurfaceMaker> maker, ReadySurface shown) {
    worker_.cancel();
    maker_ = std::move(maker);
    shown_ = std::move(shown);
    cached_.clear();
    requested_.reset();
    problem_.clear();
    just_shown_ = true;
    changed_ = true;
}

void SurfaceFollower::show(ReadySurface surface) {
    shown_ = std::move(surface);
    changed_ = true;
    just_shown_ = shown_.provisional;
    preview_awaited_ = false;
    if (shown_.provisional) return;
    std::erase_if(cached_, [&](const ReadySurface& cached) { return cached.request == shown_.request; });
    cached_.push_front(shown_);
    if (cached_.size() > kCachedSurfaces) cached_.pop_back();
}

void SurfaceFollower::follow(const SurfaceRequest& request, bool tried) {
    if (requested_ == request) {
        // What is only being tried is about to change: its preview is enough.
        const bool refine = shown_.provisional && shown_.request == request && !tried;
        if (refine && !worker_.busy() && problem_.empty()) {
            refining_ = true;
            make_next(request);
        }
        return;
    }
    if (worker_.busy() && worth_finishing(request)) return;
    const bool small_change =
        requested_ && requested_->options == request.options && shown_.mesh && !shown_.provisional;
    refining_ = false;
    requested_ = request;
    problem_.clear();
    worker_.cancel();
    changed_ = true;
    if (shown_.mesh && !shown_.provisional && shown_.request == request) return;
    for (const ReadySurface& surface : cached_) {
        if (surface.request != request) continue;
        shown_ = surface;
        return;
    }
    make_next(request);
    if (!small_change) return;
    worker_.wait(kPatience);
    worker_.drain();
}

void SurfaceFollower::await_preview() {
    if (!shown_.preview_follows || !worker_.busy() || std::exchange(preview_awaited_, true)) return;
    worker_.wait(kPreviewPatience);
    worker_.drain();
}

// When only other branches are hidden, what is being made is the way to what is requested now. And while somebody drags
// a slider, previews that never get finished would show nothing.
bool SurfaceFollower::worth_finishing(const SurfaceRequest& request) const {
    if (requested_ && requested_->options == request.options) return true;
    return !refining_ && std::chrono::steady_clock::now() - started_ < kShort;
}

void SurfaceFollower::make_next(const SurfaceRequest& request) {
    started_ = std::chrono::steady_clock::now();
    worker_.start("Computing the surface", [this, request, maker = maker_](Job& job, const Worker::Post& post) {
        for (bool more = true; more;) {
            const auto made = maker->next(request, job);
            if (job.cancelled()) return;
            more = made && made->preview_follows;
            post([this, made] {
                if (made)
                    show(*made);
                else
                    problem_ = made.error().message();
                changed_ = true;
            });
        }
    });
}

void SurfaceFollower::give_up(std::string why) {
    worker_.cancel();
    problem_ = std::move(why);
}

void SurfaceFollower::give_up(const SurfaceRequest& request, std::string why) {
    requested_ = request;
    give_up(std::move(why));
}

std::string SurfaceFollower::take_failure() {
    std::string failure = worker_.take_failure();
    if (!failure.empty()) problem_ = "the work was given up: " + failure;
    return failure;
}

} // namespace ramus::app
