// The surface near the eye: where the straight edges of its triangles can be told from a smooth outline, its triangles
// are divided, with corners where the surface bends to between them (bent_edge.h). Only edges whose middle moves in the
// picture are, which are those along outlines; and triangles that share an edge divide it alike, so that nothing opens
// between them. Vertices stay where they are, branches end where they did, no vessel joins another.
#pragma once

#include "render/scene/camera.h"
#include "render/scene/paged_mesh.h"

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

namespace ramus::render {

// Where the surface is looked at from. Positions relative to its origin.
struct NearView {
    glm::vec3 eye, forward;
    float pixels; // of a mm, at a depth of 1 mm when perspective
    bool flat;    // parallel projection
    glm::dmat4 to_clip;
};
// Of a picture `height` pixels high.
[[nodiscard]] NearView near_view(const Camera& camera, const glm::dvec3& origin, const glm::dmat4& to_clip, int height);

// What stands for some pages of a surface. Its origin is 0: positions are relative to that of the surface.
struct NearSurface {
    std::shared_ptr<const PagedMesh> mesh; // null: nothing does
    std::vector<std::uint8_t> replaced;    // by triangle page of the surface: 1 where all of it is in `mesh`
};

// Pixels that the middle of an edge may be off its outline in a picture. Four samples a pixel tell a quarter.
inline constexpr float kMostOffOutline = 0.2F;

// Triangles: that are made, and those that may have an edge to divide, which all take time.
struct NearLimits {
    std::size_t made, looked_at;
};
// The triangles of pages in the picture that have an edge to divide. Pictures with more triangles get coarser outlines
// instead.
[[nodiscard]] NearSurface near_surface(const PagedMesh& mesh, const NearView& view, const NearLimits& most);

} // namespace ramus::render
