// Progress bars of commands, and cancelling commands by signals.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <type_traits>

namespace ramus::app {

// Handles SIGINT and SIGTERM. The first signal cancels the running job, so that the command ends with a message. If no
// job runs, if cancelling takes longer than 0.6 s, or at the second signal, the process ends by the signal
// (core/base/leftovers.h). Must be called once, before any command and before other threads are started.
void handle_interrupts();

// Makes an interrupt cancel `job` during its lifetime. Objects may be nested: the innermost job is cancelled.
class CancelOnInterrupt {
public:
    explicit CancelOnInterrupt(Job& job);
    ~CancelOnInterrupt();
    CancelOnInterrupt(const CancelOnInterrupt&) = delete;
    CancelOnInterrupt& operator=(const CancelOnInterrupt&) = delete;

private:
    Job* before_;
};

// Shows the progress of a job on standard error during its lifetime, from 0.3 s on. Shows nothing if standard error is
// not a terminal. With RAMUS_PROGRESS=lines in the environment it prints lines such as "progress 0.370 surface"
// instead, ten times a second, for a program that runs ramus. The job must outlive the object.
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

// Runs `work(job)` with a progress bar, and returns its result. An interrupt cancels the job. For work that itself
// fails when it is cancelled. A result that comes after cancelling is kept, since files may already be written.
template <class Work> std::invoke_result_t<Work, Job&> write_with_progress(const std::string& what, const Work& work) {
    Job job;
    const CancelOnInterrupt cancel(job);
    const ProgressBar bar(what, job);
    return work(job);
}

// The same for any work: if the job was cancelled, the result is the error `cancelled`.
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
