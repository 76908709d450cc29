// Thick vessels in the caster's pictures: those that take many pixels across are drawn by the triangles that they have
// at rest, in place of their cones. No cone follows a surface to the pixel where wide vessels meet or where segments
// are far shorter than they are wide; and as the mesh has so many triangles around a vessel however wide it is, wide
// ones are few triangles.
//
// Vessels that go on as glass stay cones: those tell what is inside of what. So do all where surfaces have values,
// which cones have along their axes.
#pragma once

#include "render/caster/cast_types.h"
#include "render/caster/vessel_cones.h"
#include "render/scene/paged_mesh.h"

#include <glm/mat4x4.hpp>
#include <vector>

namespace ramus::render::caster {

// The vessels' surface, before the eye of a picture.
struct Surface {
    const PagedMesh& mesh;
    const glm::dmat4& to_eye;  // from mm, depth as +z
    const glm::dmat4& to_clip; // from positions relative to the mesh's origin
};

// Takes the cones of thick vessels off the list and appends their triangles, in the mesh's order: of the widest vessels
// first, as long as they are not more than can be drawn quickly.
void draw_thick_vessels(const Surface& surface, const View& view, ConeList& list, std::vector<Triangle>& triangles);

} // namespace ramus::render::caster
