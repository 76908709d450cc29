// LoopWatch: how long a window did not look at its events, and what it did meanwhile. For --status, so that journeys
// can hold the window to it. The time that the window's own thread was on a processor tells what it did even where
// other programs have the machine; waiting for a software rasteriser's threads is in the clock's time alone. What is
// written for --status is not counted: nobody else pays for it.
#pragma once

#include <deque>
#include <string>

namespace ramus::app {

class LoopWatch {
public:
    struct Gap {
        double ended = 0.0;             // the monotonic clock when it was over
        double seconds = 0.0;           // by the clock, without waiting for events
        double processor_seconds = 0.0; // of the thread that looks
        std::string doing;              // the step that took the processor longest
        std::string waiting;            // the step that took longest by the clock
        std::string command;            // the last one when it was over
    };

    void waits();                                                 // events are looked at now, and waited for
    void did(const char* step);                                   // what has been done since waits() or the last did()
    void spare();                                                 // what has been done since then does not count
    void ends(const std::string& command);                        // the gap is over
    [[nodiscard]] const Gap& longest() const { return longest_; } // by the thread's processor time
    [[nodiscard]] const std::deque<Gap>& latest() const { return latest_; } // those that may be felt

private:
    static constexpr double kFelt = 0.02, kFeltByClock = 0.1; // seconds
    static constexpr std::size_t kKept = 100;

    struct Moment {
        double clock = 0.0, processor = 0.0; // seconds
    };
    [[nodiscard]] static Moment now();

    Moment last_;
    Gap gap_, longest_;
    double longest_step_ = 0.0, longest_by_clock_ = 0.0; // seconds
    const char *step_ = "", *step_by_clock_ = "";
    bool waiting_ = false;
    std::deque<Gap> latest_;
};

} // namespace ramus::app
