// InParts: a coroutine with a result that suspends after every part, so that a window can answer in between. Use
// finish() to run it at once.
#pragma once

#include <coroutine>
#include <exception>
#include <optional>
#include <utility>

namespace ramus::render {

template <class T> class [[nodiscard]] InParts {
public:
    struct promise_type { // NOLINT(readability-identifier-naming): what C++ calls it
        std::optional<T> result;
        std::exception_ptr thrown;

        InParts get_return_object() { return InParts(Handle::from_promise(*this)); }
        static std::suspend_always initial_suspend() noexcept { return {}; }
        static std::suspend_always final_suspend() noexcept { return {}; }
        void return_value(T value) { result = std::move(value); }
        void unhandled_exception() { thrown = std::current_exception(); }
    };

    InParts(InParts&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
    InParts& operator=(InParts&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~InParts() {
        if (handle_) handle_.destroy();
    }

    // Runs the next part; false: it was the last. Rethrows exceptions of the work.
    bool resume() {
        handle_.resume();
        if (handle_.promise().thrown) std::rethrow_exception(std::exchange(handle_.promise().thrown, nullptr));
        return !handle_.done();
    }
    // Runs all remaining parts.
    T& finish() {
        while (resume()) {
        }
        return result();
    }
    [[nodiscard]] T& result() { return *handle_.promise().result; } // after the last part

private:
    using Handle = std::coroutine_handle<promise_type>;
    explicit InParts(Handle handle) : handle_(handle) {}
    Handle handle_;
};

// Ends a part: `co_await kPartEnds`.
inline constexpr std::suspend_always kPartEnds{};

} // namespace ramus::render
