// Draws vessels that are many pixels wide with the triangles of the picture at rest, in place of their cones. Where
// wide vessels meet, or where segments are far shorter than wide, cones deviate visibly from the surface. The mesh has
// the same number of triangles around a vessel of any width, so wide vessels have few.
//
// Vessels that continue as glass stay cones, which tell inside from outside. So do all vessels when surfaces have
// values, since cones interpolate values along their axes.
#pragma once

#include "render/caster/cast_types.h"
#include "render/caster/vessel_cones.h"
#include "render/scene/paged_mesh.h"

#include <glm/mat4x4.hpp>
#include <vector>

namespace ramus::render::caster {

// The vessels' surface with its transforms for one picture.
struct Surface {
    const PagedMesh& mesh;
    const glm::dmat4& to_eye;  // from mm, depth as +z
    const glm::dmat4& to_clip; // from positions relative to the mesh's origin
};

// Removes the cones of thick vessels from the list and appends their triangles, in the mesh's order. Takes the widest
// vessels first, up to a number of triangles that can be drawn quickly.
void draw_thick_vessels(const Surface& surface, const View& view, ConeList& list, std::vector<Triangle>& triangles);

} // namespace ramus::render::caster
