// What the mouse's moves make of a camera. Each is about a point `at` in mm that a person points at, on a surface or
// elsewhere: it stays where it is in the picture while the view turns and zooms, and with the pointer while the view is
// moved. The focal point comes to its depth, so that what is reckoned there (mm_per_pixel(), another projection) holds
// for what was pointed at last. Pixels as in camera.h. A point that is not before the eye leaves a perspective camera
// as it is.
#pragma once

#include "render/scene/camera.h"

namespace ramus::render {

// Along the line of sight, mm from the eye.
[[nodiscard]] double depth_of(const Camera& camera, const glm::dvec3& at);
// Millimetres that one pixel spans at a depth; in parallel projection at every one.
[[nodiscard]] double mm_per_pixel_at(const Camera& camera, glm::ivec2 size, double depth_mm);

// By angles in degrees (azimuth moves the viewer to the right, elevation upward).
[[nodiscard]] Camera turned_about(const Camera& camera, const glm::dvec3& at, double azimuth_deg, double elevation_deg);
// A drag as in 3D Slicer: 200 degrees per picture width, azimuth about view-up, then elevation.
[[nodiscard]] Camera rotated(const Camera& camera, glm::ivec2 size, const glm::dvec3& at, glm::dvec2 from,
                             glm::dvec2 to);
// So that what lay under `from` at the depth of the point lies under `to`.
[[nodiscard]] Camera panned(const Camera& camera, glm::ivec2 size, const glm::dvec3& at, glm::dvec2 from,
                            glm::dvec2 to);
// The point comes nearer by `factor` (> 1 magnifies), but not nearer than to a depth of `least_mm`: the eye moves along
// the line to it, which nothing is on that is not hidden. In parallel projection the picture becomes as large as it
// would be seen at that depth, and no larger.
[[nodiscard]] Camera zoomed_about(const Camera& camera, const glm::dvec3& at, double factor, double least_mm);
// By how much a drag of the right button magnifies: upward comes nearer, as in 3D Slicer.
[[nodiscard]] double zoom_of_drag(glm::ivec2 size, glm::dvec2 from, glm::dvec2 to);

} // namespace ramus::render
