// Farther, longer, larger than anything that is measured.
#pragma once

#include <limits>

namespace ramus {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

} // namespace ramus
