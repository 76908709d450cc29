#include "app/commands/interrupt.h"

#include "core/io/output_file.h"

#include <atomic>
#include <csignal>

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

CancelOnInterrupt::CancelOnInterrupt(Job& job) { running.store(&job); }
CancelOnInterrupt::~CancelOnInterrupt() { running.store(nullptr); }

} // namespace ramus::app
