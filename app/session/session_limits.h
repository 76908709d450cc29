// How many marks of a kind a session may have. Pictures, tables and undo take time and memory for each (60 kB in a
// picture for a cut, measured).
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"

namespace ramus::app {

inline constexpr std::size_t kMostMarks = 10'000;

// Each is a file that a process of its own reads: 20 ms, measured. A body has a hundred organs.
inline constexpr std::size_t kMostShapes = 500;
// Each computes the tree anew: 6 ms for 6,000 points, measured.
inline constexpr std::size_t kMostEdits = 1'000;

inline constexpr std::size_t kMostBands = 20; // margins around lesions; more colours cannot be distinguished

// Fails when a list of `marks` is longer than its row of the table allows (app/session/marks_table.h); names the list.
[[nodiscard]] Result<void> check_counts(const Marks& marks);

} // namespace ramus::app
