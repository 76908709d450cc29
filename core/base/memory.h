// How much memory may be used, and how much of it this process has. In bytes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ramus {

[[nodiscard]] double memory_limit(double asked); // what is asked for, or half of the machine's when that is 0
[[nodiscard]] double process_memory();           // resident now; 0 where the system does not tell
[[nodiscard]] double process_file_memory();      // of it, pages of files
[[nodiscard]] double memory_left(double asked);  // what the process may still take of memory_limit(); 1 at the least

[[nodiscard]] std::string megabytes(double bytes); // "12 MB"
// "the surface takes 12 MB of memory; 5 MB are left to it"
[[nodiscard]] std::string takes_too_much(std::string_view what, double bytes, double left);

// Gives back to the system what is kept for arrays to come (large_array.h). It takes a fraction of a second, which work
// on so many triangles is worth.
void release_unused_memory();
inline constexpr std::size_t kWorthReleasing = 10'000'000;

} // namespace ramus
