// Draws the objects of the scene into a frame; scene_objects.cpp has one function per kind.
#pragma once

#include "app/picture/compose.h"
#include "app/session/session.h"
#include "render/scene/frame.h"

namespace ramus::app {

struct Assets; // app/assets/assets.h

// Inputs of drawing an object, and the frame to add to; its camera, size and pixel ratio are set.
struct SceneDrawing {
    render::Frame& frame;
    const Assets& assets;
    const Viewing& viewing;
};

// Draws all visible objects; files that are not read yet are omitted. Lesions and measurements need a tree.
void draw_objects(const SceneDrawing& drawing, const Marks& marks);

} // namespace ramus::app
