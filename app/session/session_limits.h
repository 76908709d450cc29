// Limits on the number of marks in a session. Pictures, tables and undo take time and memory for each mark (measured: a
// cut takes 60 kB in a picture).
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"
#include "core/organ/resect/resection.h"

namespace ramus::app {

inline constexpr std::size_t kMostMarks = 10'000;

// Each shape is a file that a separate process reads (measured: 20 ms). A body has about a hundred organs.
inline constexpr std::size_t kMostShapes = 500;
// Each edit computes the tree anew (measured: 6 ms for 6,000 points).
inline constexpr std::size_t kMostEdits = 1'000;

inline constexpr std::size_t kMostResections = organ::kMostResections; // of a plan
inline constexpr std::size_t kMostPlans = 20;                          // a table of more columns cannot be read

inline constexpr std::size_t kMostScans = 20; // each takes up to gigabytes

inline constexpr std::size_t kMostViews = 100; // saved ones; a menu of more cannot be read

inline constexpr std::size_t kMostBands = 20; // margins around lesions; more colours cannot be distinguished

// Fails if a list of `marks` is longer than its row allows (app/session/marks_table.h), and names the list.
[[nodiscard]] Result<void> check_counts(const Marks& marks);

} // namespace ramus::app
