// Worker: one thread for slow work, and a queue of results for its owner. A task runs on the worker's thread, with low
// priority (thread_priority.h) and its own Job. It posts results; drain() runs them on the thread that owns the Worker
// (the window's). The newest task wins: start() cancels the running task, and results of a cancelled task are
// discarded. All public members are for the owner's thread.
#pragma once

#include "core/base/job.h"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace ramus {

class Worker {
public:
    using Result = std::function<void()>;
    using Post = std::function<void(Result)>; // callable on the worker's thread
    using Task = std::function<void(Job&, const Post&)>;

    // The worker's thread calls `wake` whenever there is a result to drain.
    explicit Worker(std::function<void()> wake);
    ~Worker(); // cancels and waits
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    void start(std::string title, Task task);
    void cancel();
    void drain();
    // Waits until there is a result to drain, at most `most`.
    void wait(std::chrono::milliseconds most);

    [[nodiscard]] bool busy() const { return current_ != nullptr; }
    [[nodiscard]] const std::string& title() const { return title_; } // of the running task
    [[nodiscard]] float progress() const { return current_ ? current_->progress() : 1.0F; }
    // The message of the exception that ended the last failed task, and forgets it. Empty: no task failed.
    [[nodiscard]] std::string take_failure() { return std::exchange(failure_, {}); }

private:
    struct Order {
        std::shared_ptr<Job> job;
        Task task;
    };
    struct Delivery {
        std::shared_ptr<Job> job;
        Result result; // empty: the task ended
    };
    void work();
    void deliver(Delivery delivery);

    std::function<void()> wake_;
    std::shared_ptr<Job> current_; // the owner's thread only
    std::string title_;
    std::string failure_; // the owner's thread only

    std::mutex mutex_; // guards what follows
    std::condition_variable changed_, delivered_;
    std::optional<Order> order_;
    std::vector<Delivery> deliveries_;
    bool ending_ = false;

    std::thread thread_; // last: it uses all of the above
};

} // namespace ramus
