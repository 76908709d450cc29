// How many things of a kind a session may have. Pictures, tables and undo take time and memory for each (a cut 60 kB in
// a picture, measured), and nobody plans with as many.
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"

namespace ramus::app {

inline constexpr std::size_t kMostMarks = 10'000;

// A file each, which takes a process to read: 20 ms, measured, and a body has a hundred organs.
inline constexpr std::size_t kMostShapes = 500;
// Each computes the tree anew: 6 ms where it has 6,000 points, measured.
inline constexpr std::size_t kMostEdits = 1'000;

inline constexpr std::size_t kMostBands = 20; // margins around lesions; the colours of more cannot be distinguished

// Fails when there are more lesions, lesion meshes, context shapes, cuts, measurements or edits; names them.
[[nodiscard]] Result<void> check_counts(const Marks& marks);

} // namespace ramus::app
