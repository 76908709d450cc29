// DrawingThread: a worker thread with a GL context that draws pictures one after the other, so that the window's thread
// keeps handling events: a graphics driver may compile a shader on first use, which takes up to a second and cannot be
// interrupted. Without a thread, work runs at once on the caller's thread: for headless pictures, and for drivers with
// one context only.
//
// It knows no OpenGL: the constructor's functions provide the context.
#pragma once

#include "app/actions/hosts.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>

namespace ramus::app {

class DrawingThread {
public:
    DrawingThread() = default; // without a thread
    // `enter` runs first on the thread; false: it failed, and there is no thread. `leave` runs last. `wake`: called on
    // the thread when a result is ready for which done() returned false.
    DrawingThread(std::function<bool()> enter, std::function<void()> leave, std::function<void()> wake);
    ~DrawingThread(); // finishes all queued work first
    DrawingThread(const DrawingThread&) = delete;
    DrawingThread& operator=(const DrawingThread&) = delete;

    // Everything below must be called from one thread, the owner's.
    [[nodiscard]] bool has_thread() const { return thread_.joinable(); }
    // No work is queued or running: run() will not wait for earlier work.
    [[nodiscard]] bool idle() const { return tasks_ == 0; }

    // Queues `work`. The future gets its result or its exception.
    template <class Work> [[nodiscard]] auto begin(Work work) {
        using Value = std::invoke_result_t<Work&>;
        auto promise = std::make_shared<std::promise<Value>>();
        auto future = promise->get_future();
        ++tasks_;
        do_next(
            [this, promise, its = std::make_shared<std::optional<Work>>(std::move(work))] { fulfil(*promise, *its); });
        return future;
    }
    // The same as a Deferred, for polling; any thread may take the result.
    template <class Work> [[nodiscard]] auto later(Work work) -> Deferred<std::invoke_result_t<Work&>> {
        const auto future = std::make_shared<std::future<std::invoke_result_t<Work&>>>(begin(std::move(work)));
        return {[this, future] { return done(*future, 0.0); }, [future] { return future->get(); }};
    }
    // Queues `work` and waits for its result.
    template <class Work> auto run(Work work) {
        if (!idle()) ++waits_;
        return begin(std::move(work)).get();
    }
    // How often run() had to wait for earlier work.
    [[nodiscard]] int waits() const { return waits_; }
    // Queues `work` and ignores its result; it must not throw.
    template <class Work> void post(Work work) { (void)begin(std::move(work)); }

    // Whether the result is ready, after waiting at most `seconds`. If not, `wake` is called when the next result is
    // ready.
    template <class Value> [[nodiscard]] bool done(const std::future<Value>& future, double seconds) {
        const auto is_there = [&](double within) {
            return future.wait_for(std::chrono::duration<double>(within)) == std::future_status::ready;
        };
        if (is_there(seconds)) return true;
        wake_wanted_ = true;
        return is_there(0.0); // it may have become ready meanwhile
    }

private:
    // Releases `work` and marks the thread as idle before the result becomes visible.
    template <class Value, class Work> void fulfil(std::promise<Value>& promise, std::optional<Work>& work) {
        const auto end = [&] {
            work.reset();
            --tasks_;
        };
        try {
            if constexpr (std::is_void_v<Value>) {
                (*work)();
                end();
                promise.set_value();
            } else {
                Value value = (*work)();
                end();
                promise.set_value(std::move(value));
            }
        } catch (...) {
            end();
            promise.set_exception(std::current_exception());
        }
    }
    void do_next(std::function<void()> task);
    void work(std::promise<bool> entered);

    std::function<bool()> enter_;
    std::function<void()> leave_, wake_;
    std::atomic<int> tasks_{0}; // queued or running
    int waits_ = 0;
    std::atomic<bool> wake_wanted_{false};

    std::mutex mutex_; // guards what follows
    std::condition_variable changed_;
    std::deque<std::function<void()>> todo_;
    bool ending_ = false;

    std::thread thread_; // last: it uses all of the above
};

} // namespace ramus::app
