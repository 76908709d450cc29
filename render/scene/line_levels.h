// Line levels: levels of detail of centerlines. Each level omits points within a tolerance (Centerlines::thinned()). A
// branch gets the coarsest level whose error is invisible, and none outside the picture. The cost of a view thus
// depends on what it shows, not on how finely the tree was traced.
#pragma once

#include "render/scene/camera.h"
#include "render/scene/centerlines.h"

#include <cstdint>
#include <vector>

namespace ramus::render {

inline constexpr int kLineLevels = 6;       // the last has every point
inline constexpr double kLinePixels = 0.25; // largest error of a line

// Tolerance of a level, in mm. `extent_mm`: Centerlines::extent_mm().
[[nodiscard]] double level_mm(int level, double extent_mm);

// A ball around the points of a branch; the radius is negative if the branch has no line.
struct LineBall {
    glm::dvec3 centre{0.0}; // mm
    double radius_mm = -1.0;
};
[[nodiscard]] std::vector<LineBall> line_balls(const Centerlines& lines); // by branch

// Level of each branch in a picture of `size` pixels; kNotInPicture if its ball is more than a few pixels outside.
inline constexpr std::int8_t kNotInPicture = -1;
[[nodiscard]] std::vector<std::int8_t> line_levels(const std::vector<LineBall>& balls, double extent_mm,
                                                   const Camera& camera, glm::ivec2 size);

} // namespace ramus::render
