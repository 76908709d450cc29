// Worker: one thread for slow work and one queue back. A task runs on the thread with its own Job; what it posts is run
// by drain() on the thread that owns the Worker (the window's), to which it gives way. The newest task wins: starting
// another cancels the one that runs, and nothing that a cancelled task posts is ever run.
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

    // `wake` is called on the worker's thread whenever there is something to drain.
    explicit Worker(std::function<void()> wake);
    ~Worker(); // cancels and waits
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    void start(std::string title, Task task);
    void cancel();
    void drain();
    // Waits until there is something to drain, at most so long.
    void wait(std::chrono::milliseconds most);

    [[nodiscard]] bool busy() const { return current_ != nullptr; }
    [[nodiscard]] const std::string& title() const { return title_; } // of the running task
    [[nodiscard]] float progress() const { return current_ ? current_->progress() : 1.0F; }
    // Why a task ended by an exception, once; empty: none did.
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
