// Changes of a grown skeleton as a whole: two forks made one, and segments cut out.
#pragma once

#include "core/tree/grow/clearance.h"
#include "core/tree/grow/skeleton.h"

#include <span>

namespace ramus::tree::growth {

inline constexpr int kRoot = 0;
inline constexpr int kHilum = 1;
inline constexpr double kNarrowFork = 0.8; // largest cosine between the children of a fork

// Makes one fork of two that stand close together: a threefold fork changes the parity of the number of branches. False
// where none fits.
[[nodiscard]] bool merge_one_fork(Skeleton& tree, Clearance& clearance);

// Without these segments and all that hangs on them, but for the two that the hilum must have.
[[nodiscard]] Skeleton without_segments(const Skeleton& tree, std::span<const int> segments);

} // namespace ramus::tree::growth
