// How many things of a kind a session may have. Pictures, tables and undo take time and memory for each (a cut 60 kB in
// a picture, measured), and nobody plans with as many.
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"

namespace ramus::app {

inline constexpr std::size_t kMostMarks = 10'000;

// Fails when there are more lesions, lesion meshes, context shapes, cuts or measurements; names them.
[[nodiscard]] Result<void> check_counts(const Marks& marks);

} // namespace ramus::app
