// The state of OpenGL that passes share. Each begins with what it needs; a picture ends with OpenGL's own defaults.
#pragma once

#include "render/renderer/targets.h"

namespace ramus::render {

// Whatever others have left, before a pass: depths from 0 to 1, and viewports of `size`.
void begin_passes(glm::ivec2 size);
// OpenGL's own defaults, for whoever draws next, and wherever a picture stops.
void end_passes();

// Front faces of closed surfaces, by reversed depth.
void draw_front_faces(bool write_depth);
// The same, into the samples of opaque surfaces; `values`: and into those of their values, which are there.
void draw_opaque_into(const SampleTarget& target, bool values = false);
// Ids and depths of what is bound: nothing is there.
void clear_samples();

// Premultiplied colours laid over or under what is there, or added to it.
enum class Blending { kOver, kUnder, kAdded };
void begin_blending(Blending how);

} // namespace ramus::render
