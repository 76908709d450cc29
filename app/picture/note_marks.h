// Marks places that reading a tree repaired or suspects with rings in the picture.
#pragma once

#include "render/scene/frame.h"

namespace ramus::app {

inline constexpr std::size_t kMostNoteMarks = 500; // more would hide what they mark

// Adds a ring per note with a place, facing the eye and large enough to be visible at any distance: amber for repairs,
// pink for suspicions. `current`: index into the tree's notes, emphasised and labelled; -1: none. `frame` must have
// camera, size and pixel ratio. Beyond kMostNoteMarks places only the first ones and the current one are marked.
void mark_notes(render::Frame& frame, const tree::VesselTree& tree, int current);

} // namespace ramus::app
