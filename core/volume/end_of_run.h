// Where values end to be equal: neighbours in masks are alike as a rule, so that going through them run by run is
// quick.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace ramus::volume {

// The first value behind `first` that is not the one there, or `end`; eight bytes at a time.
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
