// Line levels: how many of its points the line of a branch needs in a view. A level leaves out points as far as lines
// stay near the whole ones (Centerlines::thinned()); each branch gets the coarsest whose error nobody can see, and none
// where it is not in the picture. What a view draws then follows what it shows, not how finely the tree was traced.
#pragma once

#include "render/scene/camera.h"
#include "render/scene/centerlines.h"

#include <cstdint>
#include <vector>

namespace ramus::render {

inline constexpr int kLineLevels = 6;       // the last has every point
inline constexpr double kLinePixels = 0.25; // that lines may be off by

// How far lines of a level may be from the whole ones, in mm. `extent_mm`: Centerlines::extent_mm().
[[nodiscard]] double level_mm(int level, double extent_mm);

// A ball around the points of a branch; of a branch without a line the radius is below 0.
struct LineBall {
    glm::dvec3 centre{0.0}; // mm
    double radius_mm = -1.0;
};
[[nodiscard]] std::vector<LineBall> line_balls(const Centerlines& lines); // by branch

// By branch, its level in a picture of `size` pixels; kNotInPicture where no point of its ball is within a few pixels
// of the picture.
inline constexpr std::int8_t kNotInPicture = -1;
[[nodiscard]] std::vector<std::int8_t> line_levels(const std::vector<LineBall>& balls, double extent_mm,
                                                   const Camera& camera, glm::ivec2 size);

} // namespace ramus::render
