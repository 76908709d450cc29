// Sizes that are offered before anybody chooses any.
#pragma once

#include "app/session/session.h"

namespace ramus::app {

struct UsualSizes {
    Planning planning;
    double thin_mm = 2.0;           // the diameter below which vessels are thin
    double lesion_radius_mm = 10.0; // that a click gives to a lesion
};
// Of a tree: those of an organ of a person; in a smaller one less, and round numbers. A lesion's radius is at most a
// twentieth of the diagonal of the tree's box. Where the widest margin would be half of that diagonal or more,
// as of a mouse, the others shrink as lesions do. A file of unknown units may have any size.
[[nodiscard]] UsualSizes usual_sizes(const tree::VesselTree& tree);

} // namespace ramus::app
