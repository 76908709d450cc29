#include "app/window/drawing_thread.h"

namespace ramus::app {

DrawingThread::DrawingThread(std::function<bool()> enter, std::function<void()> leave, std::function<void()> wake)
    : enter_(std::move(enter)), leave_(std::move(leave)), wake_(std::move(wake)) {
    std::promise<bool> entered;
    auto can = entered.get_future();
    thread_ = std::thread([this, entered = std::move(entered)]() mutable { work(std::move(entered)); });
    if (!can.get()) thread_.join();
}

DrawingThread::~DrawingThread() {
    if (!has_thread()) return;
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void DrawingThread::do_next(std::function<void()> task) {
    if (!has_thread()) return task();
    {
        const std::lock_guard lock(mutex_);
        todo_.push_back(std::move(task));
    }
    changed_.notify_all();
}

void DrawingThread::work(std::promise<bool> entered) {
    const bool can = enter_();
    entered.set_value(can);
    while (can) {
        std::function<void()> task;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return ending_ || !todo_.empty(); });
            if (todo_.empty()) break;
            task = std::move(todo_.front());
            todo_.pop_front();
        }
        task();
        task = nullptr;
        if (wake_wanted_.exchange(false)) wake_();
    }
    if (can) leave_();
}

} // namespace ramus::app
