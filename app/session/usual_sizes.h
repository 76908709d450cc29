// Sizes that are offered before anybody chooses any.
#pragma once

#include "app/session/session.h"

namespace ramus::app {

struct UsualSizes {
    Planning planning;
    double thin_mm = 2.0; // the diameter below which vessels are thin
};
// Of a tree: those of an organ of a person; where the widest margin would be half of its box's diagonal or more, as of
// a mouse, less in proportion, and round numbers. A file of unknown units may have any size.
[[nodiscard]] UsualSizes usual_sizes(const tree::VesselTree& tree);

} // namespace ramus::app
