#include "core/base/worker.h"

#include "core/base/thread_priority.h"

namespace ramus {

Worker::Worker(std::function<void()> wake) : wake_(std::move(wake)), thread_([this] { work(); }) {}

Worker::~Worker() {
    cancel();
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
        order_.reset();
    }
    changed_.notify_all();
    thread_.join();
}

void Worker::start(std::string title, Task task) {
    cancel();
    current_ = std::make_shared<Job>();
    title_ = std::move(title);
    {
        const std::lock_guard lock(mutex_);
        order_ = Order{current_, std::move(task)};
    }
    changed_.notify_all();
}

void Worker::cancel() {
    if (current_) current_->cancel();
    current_.reset();
}

void Worker::drain() {
    std::vector<Delivery> deliveries;
    {
        const std::lock_guard lock(mutex_);
        deliveries.swap(deliveries_);
    }
    for (Delivery& delivery : deliveries) {
        if (delivery.job != current_) continue; // cancelled, or replaced by a result before this one
        if (delivery.result)
            delivery.result();
        else
            current_.reset();
    }
}

void Worker::wait(std::chrono::milliseconds most) {
    std::unique_lock lock(mutex_);
    delivered_.wait_for(lock, most, [this] { return !deliveries_.empty(); });
}

void Worker::deliver(Delivery delivery) {
    {
        const std::lock_guard lock(mutex_);
        if (ending_) return;
        deliveries_.push_back(std::move(delivery));
    }
    delivered_.notify_all();
    if (wake_) wake_();
}

void Worker::work() {
    lower_thread_priority();
    const LowPriorityHelpers helpers;
    for (;;) {
        Order order;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return ending_ || order_.has_value(); });
            if (ending_) return;
            order = std::move(*order_);
            order_.reset();
        }
        try {
            if (!order.job->cancelled())
                order.task(*order.job, [&](Result result) { deliver({order.job, std::move(result)}); });
        } catch (const std::exception& exception) { // ends the task, not the program
            deliver({order.job, [this, what = std::string(exception.what())] { failure_ = what; }});
        }
        deliver({order.job, {}});
    }
}

} // namespace ramus
