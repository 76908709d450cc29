// Stopwatch: seconds for people and statistics, by a clock that nobody sets.
#pragma once

#include <chrono>
#include <utility>

namespace ramus {

class Stopwatch {
public:
    // Seconds since the last call, or since it was made.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
    }

    // Likewise, and the watch goes on.
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace ramus
