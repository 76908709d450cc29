// LoopWatch: the longest time in which a window did not look at its events, and what it did meanwhile. For --status, so
// that journeys can hold the window to it. The time that the window's own thread was on a processor tells what it did
// even where other programs have the machine; waiting for a software rasteriser's threads is in the clock's time alone.
#pragma once

#include <string>

namespace ramus::app {

class LoopWatch {
public:
    struct Gap {
        double seconds = 0.0;           // by the clock
        double processor_seconds = 0.0; // of the thread that looks
        std::string doing;              // the step that took longest
        std::string command;            // the last one when it was over
    };

    void looked();                                                // events were looked at: a gap begins
    void did(const char* step);                                   // what has been done since looked() or the last did()
    void looks(const std::string& command);                       // the gap is over
    [[nodiscard]] const Gap& longest() const { return longest_; } // by the thread's processor time

private:
    struct Moment {
        double clock = 0.0, processor = 0.0; // seconds
    };
    [[nodiscard]] static Moment now();

    Moment begun_, last_;
    double longest_step_ = 0.0;
    const char* step_ = "";
    Gap longest_;
};

} // namespace ramus::app
