// The menu of the right button.
#pragma once

#include "app/picture/scene_objects.h"
#include "core/tree/vessel_tree.h"

#include <optional>

namespace ramus::app {

struct ContextMenu {
    bool wanted = false, open = false, close = false; // to be opened; open; to be closed
    int branch = tree::kNoBranch;                     // that it is about; kNoBranch: an object, or the view
    std::optional<ObjectPlace> object{};              // that it is about
};

} // namespace ramus::app
