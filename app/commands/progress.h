// What a command tells while it works, and how it is stopped.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <type_traits>

namespace ramus::app {

// Ctrl-C and a polite kill, while a command works: the first one cancels the work that runs, so that the command ends
// with a word. Where nothing can be cancelled, where that takes more than a moment, or at the second one, the process
// ends by the signal (core/base/leftovers.h), whatever it waits for or computes.

// Once, before any command and any other thread.
void handle_interrupts();

// While it lives, an interrupt cancels `job`; then again the job that it would have cancelled before.
class CancelOnInterrupt {
public:
    explicit CancelOnInterrupt(Job& job);
    ~CancelOnInterrupt();
    CancelOnInterrupt(const CancelOnInterrupt&) = delete;
    CancelOnInterrupt& operator=(const CancelOnInterrupt&) = delete;

private:
    Job* before_;
};

// A line on a terminal that follows a Job; silent where standard error is no terminal, and for the first moments, so
// that quick work leaves no trace. Goes away when it is destroyed. With RAMUS_PROGRESS=lines in the environment it says
// "progress 0.37 surface" on a line of its own, ten times a second, for a program that started this one.
class ProgressBar {
public:
    ProgressBar(std::string what, const Job& job);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

private:
    void follow();
    void say_lines();

    std::string what_;
    const Job& job_;
    std::mutex mutex_;
    std::condition_variable done_changed_;
    bool done_ = false;
    std::thread thread_;
};

// What `work(job)` gives, with a bar that follows it; an interrupt cancels the job. For work that fails where it is
// cancelled: what comes too late changes nothing, for files may be in their places.
template <class Work> std::invoke_result_t<Work, Job&> write_with_progress(const std::string& what, const Work& work) {
    Job job;
    const CancelOnInterrupt cancel(job);
    const ProgressBar bar(what, job);
    return work(job);
}

// The same for any work: once it is cancelled, its result is the error `cancelled`.
template <class Work>
std::invoke_result_t<Work, Job&> with_progress(const std::string& what, const Work& work,
                                               const char* cancelled = "cancelled") {
    return write_with_progress(what, [&](Job& job) {
        auto result = work(job);
        if (job.cancelled()) result = fail(cancelled);
        return result;
    });
}
inline constexpr const char* kNothingWritten = "cancelled; nothing was written";

} // namespace ramus::app
