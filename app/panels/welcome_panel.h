// The panel of a first start.
#pragma once

namespace ramus::app {

struct Welcome {
    bool shown = false; // in the last frame
};

} // namespace ramus::app
