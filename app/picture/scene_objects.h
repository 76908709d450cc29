// How the objects of the scene are drawn: a function for each kind. compose() calls them for all objects that are
// visible.
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

// What has not been read yet is left out. Lesions and measurements take a tree.
void draw_object(const SceneDrawing& drawing, const Lesion& lesion);
void draw_object(const SceneDrawing& drawing, const ContextItem& item);
void draw_object(const SceneDrawing& drawing, const Measurement& measurement);

void draw_objects(const SceneDrawing& drawing, const Marks& marks);

} // namespace ramus::app
