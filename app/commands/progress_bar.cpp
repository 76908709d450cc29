#include "app/commands/progress_bar.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <unistd.h>

namespace ramus::app {

ProgressBar::ProgressBar(std::string what, const Job& job) : what_(std::move(what)), job_(job) {
    if (::isatty(STDERR_FILENO) != 0) thread_ = std::thread([this] { follow(); });
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
