// The places that reading a tree repaired, or that look wrong, as rings in the picture.
#pragma once

#include "render/scene/frame.h"

namespace ramus::app {

inline constexpr std::size_t kMostNoteMarks = 500; // more would hide what they mark

// Adds a ring for each note that has a place, facing the eye and wide enough to be seen from anywhere: amber for a
// repair, pink for what is suspect. `current`: an index into the tree's notes, drawn stronger and named; -1: none. The
// frame has its camera, size and pixel ratio. Beyond kMostNoteMarks places only the first are marked, and the current.
void mark_notes(render::Frame& frame, const tree::VesselTree& tree, int current);

} // namespace ramus::app
