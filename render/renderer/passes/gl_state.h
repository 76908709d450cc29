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
// Cuts away what the frame cuts away, until end_cut(), for the program in use. Positions p of the program are at
// `origin` + `scale` p, mm.
void begin_cut(const Frame& frame, const glm::dvec3& origin, double scale = 1.0);
void end_cut();
// Caps of one closed surface, in two steps. kCount counts in the stencil how often a ray through the cut is inside.
// kMark, where that is not 0, marks the samples as the cap of the nearest back face. clear_caps() comes before.
enum class CapStep { kCount, kMark };
void clear_caps(const SampleTarget& target);
void begin_caps(const SampleTarget& target, CapStep step, bool values = false);
void end_caps();
// For programs of opaque surfaces, with or without caps.
void use_cap_normal(const Frame& frame, const ViewSetup& view);
void use_no_caps();
// Clears ids and depths of the bound framebuffer to "nothing".
void clear_samples();

// Blends premultiplied colours over or under the existing ones, or adds them.
enum class Blending { kOver, kUnder, kAdded };
void begin_blending(Blending how);

} // namespace ramus::render
