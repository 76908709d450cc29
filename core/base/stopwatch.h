// Stopwatch: elapsed time in seconds, by the monotonic clock.
#pragma once

#include <chrono>
#include <utility>

namespace ramus {

class Stopwatch {
public:
    // Seconds since the last lap() or the construction. Starts a new lap.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
    }

    // The same without a new lap.
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace ramus
