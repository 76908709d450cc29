// Finds the end of a run of equal values. Neighbouring values of masks are mostly equal, so processing them run by run
// is fast.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace ramus::volume {

// The index of the first value after `first` that differs from it, or `end`. Compares eight bytes at a time.
template <class T> [[nodiscard]] std::size_t end_of_run(const T* values, std::size_t first, std::size_t end) {
    constexpr std::size_t kWordBytes = 8, kAtOnce = kWordBytes / sizeof(T);
    std::array<T, kAtOnce> alike;
    alike.fill(values[first]);
    const auto pattern = std::bit_cast<std::uint64_t>(alike);
    std::size_t n = first + 1;
    for (std::uint64_t word = 0; n + kAtOnce <= end; n += kAtOnce) {
        std::memcpy(&word, values + n, sizeof(word));
        if (word != pattern) break;
    }
    while (n < end && values[n] == values[first]) ++n;
    return n;
}

} // namespace ramus::volume
