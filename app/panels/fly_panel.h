// The bar for flying along the vessels.
#pragma once

#include "core/tree/vessel_tree.h"
#include "render/scene/camera.h"

#include <vector>

namespace ramus::app {

struct Fly {
    bool open = false;
    bool playing = false;
    bool inside = false;
    int branch = tree::kNoBranch; // flies to its end
    double fraction = 0.0;
    double last = 0.0;          // seconds of draw_interface() when it flew last
    render::Camera camera;      // as the flight left it
    std::vector<int> selection; // the one that `branch` is from
    void close() { open = playing = false; }
};

} // namespace ramus::app
