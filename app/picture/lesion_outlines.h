// Draws outlines of lesions in pictures with transparent context, through which a lesion is only faintly visible. An
// outline is drawn over the context but fainter behind vessels, so that it does not seem to be in front of them.
#pragma once

#include "app/session/session.h"
#include "render/scene/frame.h"

#include <vector>

namespace ramus::app {

struct Assets; // app/assets/assets.h

// Adds outlines of the frame's spheres and the session's lesion meshes; nothing without transparent context. `frame`
// must have camera, size, lesions and context.
void outline_lesions(render::Frame& frame, const Assets& assets, const Marks& marks);

// The silhouette of a mesh: closed polylines in the plane through `middle` that faces the eye. The step is a hundredth
// of the mesh's size, at least a pixel. Empty if part of the mesh is behind the eye.
[[nodiscard]] std::vector<std::vector<glm::dvec3>> silhouette(const mesh::TriangleMesh& mesh, const glm::dvec3& middle,
                                                              const render::Camera& camera, glm::ivec2 size);

} // namespace ramus::app
