// The menu of the right button.
#pragma once

#include "core/tree/vessel_tree.h"

namespace ramus::app {

struct ContextMenu {
    bool wanted = false, open = false, close = false; // to be opened; open; to be closed
    int branch = tree::kNoBranch;                     // that it is about; kNoBranch: the view
};

} // namespace ramus::app
