#include "app/window/tick_watch.h"

#include <ctime>

namespace ramus::app {

TickWatch::Moment TickWatch::now() {
    const auto seconds = [](clockid_t clock) {
        timespec time{};
        clock_gettime(clock, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    };
    return {seconds(CLOCK_MONOTONIC), seconds(CLOCK_THREAD_CPUTIME_ID)};
}

void TickWatch::waits() {
    last_ = now();
    gap_ = {};
    longest_step_ = longest_by_clock_ = 0.0;
    step_ = step_by_clock_ = "";
    waiting_ = true;
}

// Events are handled at the end of a wait: only the processor time of a wait counts.
void TickWatch::did(const char* step) {
    const Moment at = now();
    const double took = at.processor - last_.processor;
    gap_.processor_seconds += took;
    const double by_clock = waiting_ ? took : at.clock - last_.clock;
    gap_.seconds += by_clock;
    waiting_ = false;
    if (by_clock >= longest_by_clock_) longest_by_clock_ = by_clock, step_by_clock_ = step;
    if (took >= longest_step_) longest_step_ = took, step_ = step;
    last_ = at;
}

void TickWatch::spare() { last_ = now(); }

void TickWatch::ends(const std::string& command) {
    if (gap_.processor_seconds < kFelt && gap_.seconds < kFeltByClock) return;
    gap_.ended = now().clock;
    gap_.doing = step_;
    gap_.waiting = step_by_clock_;
    gap_.command = command;
    if (gap_.processor_seconds > longest_.processor_seconds) longest_ = gap_;
    latest_.push_back(gap_);
    if (latest_.size() > kKept) latest_.pop_front();
}

} // namespace ramus::app
