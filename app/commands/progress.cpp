#include "app/commands/progress.h"

#include "app/session/progress_lines.h"
#include "core/base/leftovers.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace ramus::app {

namespace {

std::mutex running_mutex;
Job* running = nullptr;

Job* exchange_running(Job* job) {
    const std::lock_guard lock(running_mutex);
    return std::exchange(running, job);
}

bool cancel_running() {
    const std::lock_guard lock(running_mutex);
    if (running != nullptr) running->cancel();
    return running != nullptr;
}

// Waits for signals, forever. The signals must be blocked in all threads.
void wait_for(const sigset_t interrupts) {
    constexpr timespec kGrace{.tv_sec = 0, .tv_nsec = 600'000'000};
    int number = 0;
    if (::sigwait(&interrupts, &number) != 0) return;
    if (cancel_running())
        if (const int again = ::sigtimedwait(&interrupts, nullptr, &kGrace); again > 0) number = again;
    end_by_signal(number);
}

} // namespace

void handle_interrupts() {
    sigset_t interrupts;
    sigemptyset(&interrupts);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        ::sigaction(number, nullptr, &before);
        // A process that was started to ignore a signal (nohup) goes on ignoring it.
        if (before.sa_handler != SIG_IGN) sigaddset(&interrupts, number);
    }
    ::pthread_sigmask(SIG_BLOCK, &interrupts, nullptr);
    std::thread(wait_for, interrupts).detach();
}

CancelOnInterrupt::CancelOnInterrupt(Job& job) : before_(exchange_running(&job)) {}
CancelOnInterrupt::~CancelOnInterrupt() { exchange_running(before_); }

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
