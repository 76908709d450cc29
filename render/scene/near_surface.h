// Replaces pages of a surface near the eye by finer triangles: where straight edges would be visible on smooth outlines
// or along the crease between two vessels (near_division.h). Borders between branches stay in place.
#pragma once

#include "render/scene/near_view.h"
#include "render/scene/paged_mesh.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ramus::render {

// Finer triangles that replace pages of a surface. Positions are relative to the surface's origin; the mesh's own
// origin is 0.
struct NearSurface {
    std::shared_ptr<const PagedMesh> mesh; // null: nothing is replaced
    std::vector<std::uint8_t> replaced;    // by triangle page of the surface: 1 if `mesh` replaces it
};

// Largest error of an edge's middle at an outline, in pixels. Four samples per pixel show errors of a quarter.
inline constexpr float kMostOffOutline = 0.15F;

// Limits in triangles: of the result, and of the triangles examined, which cost time.
struct NearLimits {
    std::size_t made, looked_at;
};
// Divides pages in the picture that need it. If more than `looked_at` triangles would have to be examined, the pages
// that are smallest in the picture stay; if more than `made` would result, the tolerance is increased.
[[nodiscard]] NearSurface near_surface(const PagedMesh& mesh, const NearView& view, const NearLimits& most);

} // namespace ramus::render
