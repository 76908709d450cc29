// A line on a terminal that follows a Job; silent where standard error is no terminal, and for the first moments, so
// that quick work leaves no trace. Goes away when it is destroyed.
#pragma once

#include "core/base/job.h"

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace ramus::app {

class ProgressBar {
public:
    ProgressBar(std::string what, const Job& job);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

private:
    void follow();

    std::string what_;
    const Job& job_;
    std::mutex mutex_;
    std::condition_variable done_changed_;
    bool done_ = false;
    std::thread thread_;
};

} // namespace ramus::app
