// OpenGL state that passes share. Each pass sets what it needs; after a picture OpenGL has its default state.
#pragma once

#include "render/renderer/targets.h"

namespace ramus::render {

// Call before a pass, whatever state OpenGL is in: sets depths from 0 to 1, and viewports of `size`.
void begin_passes(glm::ivec2 size);
// Restores OpenGL's defaults; call it wherever drawing stops.
void end_passes();

// Draws front faces of closed surfaces with reversed depth.
void draw_front_faces(bool write_depth);
// The same into the samples of opaque surfaces; `values`: also into those of their values, which must exist.
void draw_opaque_into(const SampleTarget& target, bool values = false);
// Clears ids and depths of the bound framebuffer to "nothing".
void clear_samples();

// Blends premultiplied colours over or under the existing ones, or adds them.
enum class Blending { kOver, kUnder, kAdded };
void begin_blending(Blending how);

} // namespace ramus::render
