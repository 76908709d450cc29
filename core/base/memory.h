// The memory limit of the process and how much of it is in use, in bytes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ramus {

[[nodiscard]] double memory_limit(double asked); // `asked`, or half of the machine's memory if `asked` is 0
[[nodiscard]] double process_memory();           // resident now; 0 if the system does not tell
[[nodiscard]] double process_file_memory();      // the part of process_memory() that is pages of files
[[nodiscard]] double memory_left(double asked);  // memory_limit() less process_memory(); at least 1

[[nodiscard]] std::string megabytes(double bytes); // "12 MB"
// "the surface takes 12 MB of memory; 5 MB are left to it"
[[nodiscard]] std::string takes_too_much(std::string_view what, double bytes, double left);

// Returns the memory that the allocators keep for later arrays (large_array.h) to the system. Takes a fraction of a
// second, so it pays off only after work on at least kWorthReleasing triangles.
void release_unused_memory();
inline constexpr std::size_t kWorthReleasing = 10'000'000;

} // namespace ramus
