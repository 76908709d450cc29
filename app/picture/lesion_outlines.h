// Outlines of lesions, for pictures in which clear context lies around them: a lesion inside an organ is seen through
// it only faintly. An outline is drawn over the context, fainter where vessels hide it, so that it says where the
// lesion is and not that it lies before anything.
#pragma once

#include "app/session/session.h"
#include "render/scene/frame.h"

#include <vector>

namespace ramus::app {

struct Assets; // app/assets/assets.h

// Adds the outlines of the frame's spheres, and of the session's meshes. Nothing without clear context. `frame` has its
// camera, size, lesions and context.
void outline_lesions(render::Frame& frame, const Assets& assets, const Marks& marks);

// Closed polylines in the plane through `middle` that faces the eye: where the mesh ends in the picture. Steps are as
// large as a hundredth of the mesh, and at least a pixel. Empty where a part of the mesh lies behind the eye.
[[nodiscard]] std::vector<std::vector<glm::dvec3>> silhouette(const mesh::TriangleMesh& mesh, const glm::dvec3& middle,
                                                              const render::Camera& camera, glm::ivec2 size);

} // namespace ramus::app
