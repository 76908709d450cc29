// SurfaceFollower: the surface that is shown, which follows what is requested. It is made on a worker, better and
// better; a few surfaces are cached, so that undo finds the one that was there before. For one thread, its owner's.
#pragma once

#include "app/workspace/surface_maker.h"
#include "core/base/worker.h"

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace ramus::app {

class SurfaceFollower {
public:
    explicit SurfaceFollower(std::function<void()> wake) : worker_(std::move(wake)) {}

    // Another tree, and what is shown of it at first.
    void open(std::shared_ptr<SurfaceMaker> maker, ReadySurface shown);
    // What was made elsewhere.
    void show(ReadySurface surface);
    // Takes what was made, and nothing more.
    void drain() { worker_.drain(); }
    // Starts what is requested; of what is only being tried (while a slider is held) a preview is enough. Waits a
    // moment for a small change.
    void follow(const SurfaceRequest& request, bool tried);
    // Waits a moment for the preview of what is shown, when it is about to come.
    void await_preview();

    [[nodiscard]] const ReadySurface& shown() const { return shown_; }
    // Whether something is on its way, or about to be, that shall take the place of what is shown.
    [[nodiscard]] bool awaited(const SurfaceRequest& request) const {
        return shown_.mesh && problem_.empty() && (shown_.provisional || shown_.request != request);
    }
    // Why what was requested could not be made; empty: it could, or is being made.
    [[nodiscard]] const std::string& problem() const { return problem_; }
    // Nothing more is made for what was requested last, or for this request, until something else is or retry().
    void give_up(std::string why);
    void give_up(const SurfaceRequest& request, std::string why);
    void retry() { requested_.reset(); }
    // Whether something provisional came since the last call: it is drawn before something better is begun, as both
    // want the whole machine.
    [[nodiscard]] bool take_just_shown() { return std::exchange(just_shown_, false); }
    [[nodiscard]] bool take_changed() { return std::exchange(changed_, false); }

    [[nodiscard]] const Worker& worker() const { return worker_; }
    // Why the last task ended by an exception, once; empty: none did.
    [[nodiscard]] std::string take_failure();

private:
    static constexpr std::size_t kCachedSurfaces = 3;
    // A branch that is hidden is gone from the surface within a frame or two: then the next picture is the right one.
    static constexpr std::chrono::milliseconds kPatience{25};
    static constexpr std::chrono::milliseconds kPreviewPatience{80};
    static constexpr std::chrono::milliseconds kShort{500}; // what is being made is let finish

    void make_next(const SurfaceRequest& request);
    [[nodiscard]] bool worth_finishing(const SurfaceRequest& request) const;

    std::shared_ptr<SurfaceMaker> maker_;
    ReadySurface shown_;
    std::deque<ReadySurface> cached_; // newest first
    std::optional<SurfaceRequest> requested_;
    std::chrono::steady_clock::time_point started_; // the worker's task
    bool refining_ = false;                         // it makes a surface whose preview is shown
    bool preview_awaited_ = false;                  // of what is shown: waited for once
    bool just_shown_ = false;                       // something provisional, not drawn yet
    bool changed_ = false;
    std::string problem_;
    Worker worker_; // last: its thread ends first
};

} // namespace ramus::app
