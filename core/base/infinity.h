// kInfinity: infinity in double precision, as the start value of a minimum.
#pragma once

#include <limits>

namespace ramus {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

} // namespace ramus
