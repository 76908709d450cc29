#include "app/window/loop_watch.h"

#include <ctime>

namespace ramus::app {

LoopWatch::Moment LoopWatch::now() {
    const auto seconds = [](clockid_t clock) {
        timespec time{};
        clock_gettime(clock, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    };
    return {seconds(CLOCK_MONOTONIC), seconds(CLOCK_THREAD_CPUTIME_ID)};
}

void LoopWatch::looked() {
    begun_ = last_ = now();
    longest_step_ = 0.0;
    step_ = "";
}

void LoopWatch::did(const char* step) {
    const Moment at = now();
    const double took = at.processor - last_.processor;
    if (took >= longest_step_) longest_step_ = took, step_ = step;
    last_ = at;
}

void LoopWatch::looks(const std::string& command) {
    const Moment at = now();
    if (at.processor - begun_.processor <= longest_.processor_seconds) return;
    longest_ = {at.clock - begun_.clock, at.processor - begun_.processor, step_, command};
}

} // namespace ramus::app
