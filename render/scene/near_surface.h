// The surface near the eye: where the straight edges of its triangles can be told from a smooth outline, or the crease
// between two vessels from a clean line, its triangles are divided (near_division.h). Branches end where they did.
#pragma once

#include "render/scene/near_view.h"
#include "render/scene/paged_mesh.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ramus::render {

// What stands for some pages of a surface. Its origin is 0: positions are relative to that of the surface.
struct NearSurface {
    std::shared_ptr<const PagedMesh> mesh; // null: nothing does
    std::vector<std::uint8_t> replaced;    // by triangle page of the surface: 1 where all of it is in `mesh`
};

// Pixels that the middle of an edge may be off its outline in a picture. Four samples a pixel tell a quarter.
inline constexpr float kMostOffOutline = 0.15F;

// Triangles: that are made, and those that may have an edge to divide, which all take time.
struct NearLimits {
    std::size_t made, looked_at;
};
// The triangles of pages in the picture that have an edge to divide. Where more would have to be looked at, those of
// the pages that are smallest in the picture stay as they are; where more would be made, outlines are coarser.
[[nodiscard]] NearSurface near_surface(const PagedMesh& mesh, const NearView& view, const NearLimits& most);

} // namespace ramus::render
