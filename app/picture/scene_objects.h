// The objects of the scene in a frame. scene_objects.cpp has a function for each kind.
#pragma once

#include "app/picture/compose.h"
#include "app/session/session.h"
#include "render/scene/frame.h"

namespace ramus::app {

struct Assets; // app/assets/assets.h

// What drawing an object may read, and the frame that it adds to: camera, size and pixel ratio are set.
struct SceneDrawing {
    render::Frame& frame;
    const Assets& assets;
    const Viewing& viewing;
};

// All that are visible. What has not been read yet is left out. Lesions and measurements need a tree.
void draw_objects(const SceneDrawing& drawing, const Marks& marks);

} // namespace ramus::app
