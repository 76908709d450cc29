// Camera moves of the mouse. Each has an anchor `at` in mm that a person points at, on a surface or elsewhere. The
// anchor keeps its place in the picture during rotation and zoom, and follows the pointer during panning. The focal
// point moves to the anchor's depth, so that mm_per_pixel() and a change of projection refer to what was pointed at
// last. Pixels as in camera.h. An anchor behind the eye leaves a perspective camera unchanged.
#pragma once

#include "render/scene/camera.h"

namespace ramus::render {

// Depth of a point: mm from the eye along the line of sight.
[[nodiscard]] double depth_of(const Camera& camera, const glm::dvec3& at);
// Millimetres that one pixel spans at a depth; in parallel projection independent of the depth.
[[nodiscard]] double mm_per_pixel_at(const Camera& camera, glm::ivec2 size, double depth_mm);

// Rotates by angles in degrees (azimuth moves the viewer to the right, elevation upward).
[[nodiscard]] Camera turned_about(const Camera& camera, const glm::dvec3& at, double azimuth_deg, double elevation_deg);
// Rotates by a drag as in 3D Slicer: 200 degrees per picture width, azimuth about view-up, then elevation.
[[nodiscard]] Camera rotated(const Camera& camera, glm::ivec2 size, const glm::dvec3& at, glm::dvec2 from,
                             glm::dvec2 to);
// Pans so that what was under `from`, at the anchor's depth, is under `to`.
[[nodiscard]] Camera panned(const Camera& camera, glm::ivec2 size, const glm::dvec3& at, glm::dvec2 from,
                            glm::dvec2 to);
// Zooms by `factor` (> 1 magnifies), but brings the anchor no nearer than `least_mm`: the eye moves on the line to the
// anchor, which is free if the anchor is visible. In parallel projection the magnification is limited to that of this
// depth.
[[nodiscard]] Camera zoomed_about(const Camera& camera, const glm::dvec3& at, double factor, double least_mm);
// The zoom factor of a drag with the right button: upward magnifies, as in 3D Slicer.
[[nodiscard]] double zoom_of_drag(glm::ivec2 size, glm::dvec2 from, glm::dvec2 to);

} // namespace ramus::render
