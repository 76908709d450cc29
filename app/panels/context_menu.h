// The menu of the right button.
#pragma once

#include "app/picture/scene_objects.h"
#include "core/slice/pixel_grid.h"
#include "core/tree/vessel_tree.h"

#include <optional>

namespace ramus::app {

// A place on a slice, mm (RAS).
struct SliceSpot {
    slice::Direction direction = slice::Direction::kAxial;
    glm::dvec3 place{0.0};
};

struct ContextMenu {
    bool wanted = false, open = false, close = false; // to be opened; open; to be closed
    int branch = tree::kNoBranch;                     // that it is about; kNoBranch: an object, or the view
    std::optional<ObjectPlace> object{};              // that it is about
    std::optional<SliceSpot> slice{};                 // where it was opened, if over a slice
};

} // namespace ramus::app
