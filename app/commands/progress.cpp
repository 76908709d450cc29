#include "app/commands/progress.h"

#include "app/session/progress_lines.h"
#include "core/io/output_file.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <unistd.h>

namespace ramus::app {

namespace {

std::atomic<Job*> running{nullptr};
static_assert(std::atomic<Job*>::is_always_lock_free, "used in a signal handler");

extern "C" void on_interrupt(int number) {
    if (Job* job = running.exchange(nullptr); job != nullptr) {
        job->cancel();
        return;
    }
    io::remove_unfinished_files();
    std::signal(number, SIG_DFL);
    std::raise(number);
}

} // namespace

void handle_interrupts() {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        // A process that was started to ignore a signal (nohup) goes on ignoring it.
        if (std::signal(number, on_interrupt) == SIG_IGN) std::signal(number, SIG_IGN);
    }
}

CancelOnInterrupt::CancelOnInterrupt(Job& job) : before_(running.exchange(&job)) {}
CancelOnInterrupt::~CancelOnInterrupt() { running.store(before_); }

ProgressBar::ProgressBar(std::string what, const Job& job) : what_(std::move(what)), job_(job) {
    const char* wanted = std::getenv(kProgressVariable);
    if (wanted != nullptr && std::string_view(wanted) == kProgressLines)
        thread_ = std::thread([this] { say_lines(); });
    else if (::isatty(STDERR_FILENO) != 0)
        thread_ = std::thread([this] { follow(); });
}

ProgressBar::~ProgressBar() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        done_ = true;
    }
    done_changed_.notify_one();
    thread_.join();
}

void ProgressBar::say_lines() {
    using namespace std::chrono_literals;
    std::unique_lock lock(mutex_);
    while (!done_changed_.wait_for(lock, 100ms, [this] { return done_; })) {
        std::fprintf(stderr, "%s%.3f %s\n", kProgressLine, static_cast<double>(job_.progress()), what_.c_str());
        std::fflush(stderr);
    }
}

void ProgressBar::follow() {
    using namespace std::chrono_literals;
    constexpr int kWidth = 30;
    bool shown = false;
    std::unique_lock lock(mutex_);
    for (auto pause = 300ms; !done_changed_.wait_for(lock, pause, [this] { return done_; }); pause = 100ms) {
        const float done = std::clamp(job_.progress(), 0.0F, 1.0F);
        const auto filled = static_cast<std::size_t>(done * kWidth);
        const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
        std::fprintf(stderr, "\r%s [%s] %3.0f %%", what_.c_str(), bar.c_str(), static_cast<double>(done) * 100.0);
        std::fflush(stderr);
        shown = true;
    }
    if (shown) std::fputs("\r\033[K", stderr);
}

} // namespace ramus::app
