// Default sizes for planning, lesions and thin vessels.
#pragma once

#include "app/session/session.h"

namespace ramus::app {

struct UsualSizes {
    Planning planning;
    double thin_mm = 2.0;           // the diameter below which vessels are thin
    double lesion_radius_mm = 10.0; // of a lesion placed by a click
};
// Sizes for a tree: suited to a human organ, scaled down to round numbers for smaller trees. A lesion's radius is at
// most a twentieth of the diagonal of the tree's box. If the widest margin would be half of that diagonal or more, as
// for a mouse, the other sizes shrink as lesions do. A file of unknown unit may have any size.
[[nodiscard]] UsualSizes usual_sizes(const tree::VesselTree& tree);

} // namespace ramus::app
