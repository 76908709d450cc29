// Changes the topology of a grown skeleton: merges two forks, and removes segments.
#pragma once

#include "core/tree/grow/clearance.h"
#include "core/tree/grow/skeleton.h"

#include <span>

namespace ramus::tree::growth {

inline constexpr int kRoot = 0;
inline constexpr int kHilum = 1;
inline constexpr double kNarrowFork = 0.8; // largest cosine between the children of a fork

// Merges two forks that are close to each other into one with three children, which changes the parity of the number of
// branches. Returns false if no pair of forks fits.
[[nodiscard]] bool merge_one_fork(Skeleton& tree, Clearance& clearance);

// Removes segments and their descendants, except for the two segments that the hilum must have.
[[nodiscard]] Skeleton without_segments(const Skeleton& tree, std::span<const int> segments);

} // namespace ramus::tree::growth
