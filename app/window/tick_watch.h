// TickWatch: measures how long the window did not handle events, and what it did meanwhile; for --status, so that tests
// can limit it. Measures the processor time of the window's thread, which is independent of other programs, and the
// clock's time, which includes waiting for threads of a software rasteriser. Writing --status itself is excluded.
#pragma once

#include <deque>
#include <string>

namespace ramus::app {

class TickWatch {
public:
    struct Gap {
        double ended = 0.0;             // monotonic clock at its end, seconds
        double seconds = 0.0;           // clock time without waiting for events
        double processor_seconds = 0.0; // of the window's thread
        std::string doing;              // the step with the most processor time
        std::string waiting;            // the step with the most clock time
        std::string command;            // the last command at its end
    };

    void waits();                                                 // events are handled and awaited now
    void did(const char* step);                                   // names the work since waits() or the last did()
    void spare();                                                 // excludes the work since then
    void ends(const std::string& command);                        // ends the gap
    [[nodiscard]] const Gap& longest() const { return longest_; } // by processor time
    [[nodiscard]] const std::deque<Gap>& latest() const { return latest_; } // the noticeable ones

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
