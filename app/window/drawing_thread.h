// DrawingThread: pictures are drawn here, one thing after the other, so that the window's thread goes on looking at its
// events: a graphics driver compiles a shader when something is drawn with it for the first time, which takes it up to
// a second and cannot be stopped. Without a thread the same is done at once by who asks for it: pictures without a
// window, and drivers that give one context only.
//
// It knows no OpenGL: whoever makes it says how the thread gets a context, and what it does with it.
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
    DrawingThread() = default; // none
    // `enter` is the first that the thread does; false: it cannot, and there is none. `leave` is the last. `wake` is
    // called on it when something is done that done() was asked for in vain.
    DrawingThread(std::function<bool()> enter, std::function<void()> leave, std::function<void()> wake);
    ~DrawingThread(); // what was asked for is done first
    DrawingThread(const DrawingThread&) = delete;
    DrawingThread& operator=(const DrawingThread&) = delete;

    // The rest is for one thread, which owns this.
    [[nodiscard]] bool apart() const { return thread_.joinable(); }
    // Nothing is being done: run() does not wait for what was asked for before.
    [[nodiscard]] bool idle() const { return tasks_ == 0; }

    // Does `work` after all that was asked for before. Its result, or what it throws, is in the future.
    template <class Work> [[nodiscard]] auto begin(Work work) {
        using Value = std::invoke_result_t<Work&>;
        auto promise = std::make_shared<std::promise<Value>>();
        auto future = promise->get_future();
        ++tasks_;
        do_next(
            [this, promise, its = std::make_shared<std::optional<Work>>(std::move(work))] { fulfil(*promise, *its); });
        return future;
    }
    // The same, for who looks whether it is there; any thread may take it.
    template <class Work> [[nodiscard]] auto later(Work work) -> Deferred<std::invoke_result_t<Work&>> {
        const auto future = std::make_shared<std::future<std::invoke_result_t<Work&>>>(begin(std::move(work)));
        return {[this, future] { return done(*future, 0.0); }, [future] { return future->get(); }};
    }
    // The same, and waits for it.
    template <class Work> auto run(Work work) {
        if (!idle()) ++waits_;
        return begin(std::move(work)).get();
    }
    // How often that waited for something else, too.
    [[nodiscard]] int waits() const { return waits_; }
    // The same, and nobody wants to know: `work` throws nothing.
    template <class Work> void let(Work work) { (void)begin(std::move(work)); }

    // Whether the result is there, after waiting for so long at most. If not, `wake` is called when the next is.
    template <class Value> [[nodiscard]] bool done(const std::future<Value>& future, double seconds) {
        const auto is_there = [&](double within) {
            return future.wait_for(std::chrono::duration<double>(within)) == std::future_status::ready;
        };
        if (is_there(seconds)) return true;
        wake_wanted_ = true;
        return is_there(0.0); // since then
    }

private:
    // What `work` holds is let go, and the thread idle, before the result is known.
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
    std::atomic<int> tasks_{0}; // that are not done
    int waits_ = 0;
    std::atomic<bool> wake_wanted_{false};

    std::mutex mutex_; // guards what follows
    std::condition_variable changed_;
    std::deque<std::function<void()>> todo_;
    bool ending_ = false;

    std::thread thread_; // last: it uses all of the above
};

} // namespace ramus::app
