// level_lines(): the lines of a plane along which a field, such as the distance from a lesion, has given values.
//
// The field is taken at the pixels of a grid and is linear between them. Blocks of pixels that no line can cross are
// skipped, since the field changes by at most `steepest` per mm. Guarantees: the ends of open lines are at the border
// of the grid; values below the level are on the right of a line. The result does not depend on threads.
#pragma once

#include "core/slice/section.h"

#include <functional>
#include <span>
#include <vector>

namespace ramus::slice {

// `field`: of a place in mm; called by several threads at once. The lines of each level, in the order of `levels`.
[[nodiscard]] std::vector<std::vector<Loop>> level_lines(const PixelGrid& grid, std::span<const double> levels,
                                                         const std::function<double(const glm::dvec3&)>& field,
                                                         double steepest = 1.0);

} // namespace ramus::slice
