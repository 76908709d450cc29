// The borders of labelled parts of an organ (territories) as one triangle mesh. Each triangle knows the labels on its
// two sides, so the closed surface of a label is a selection of triangles, and neighbours share their border vertex by
// vertex.
//
// Method: surface nets (S. F. F. Gibson, Constrained Elastic Surface Nets, MICCAI 1998) for several labels. Each cell
// of eight voxel centres has a vertex for each connected piece of border in it, and each pair of neighbouring voxels
// with different labels has a polygon. Vertices move to a surface of least bending within their cells
// (surfaces/relax_net.h), then along the normals until the labels have their volumes (surfaces/fit_volumes.h).
//
// Guaranteed, for any labels:
// - surface_of() is closed, oriented outward, and every edge has two triangles, every vertex one ring of them.
// - Each vertex is within half a voxel, along each axis, of the border between voxels.
// - The volume of each label differs from that of its voxels by less than 1 %, whatever their number.
// - Where four voxels around an edge touch crosswise, the two of one label are connected: those of the only label that
//   is there twice, else those of the organ, else those of the lower label.
// - The same bits for any number of threads.
// Not guaranteed: that triangles do not intersect, where a label is only one voxel thick.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"
#include "core/organ/organ.h"

#include <span>
#include <vector>

namespace ramus::organ {

inline constexpr int kOutside = -2; // the label of everything that is not of the organ

struct Sides {
    int inside = kOutside, outside = kOutside; // labels; the triangle is counter-clockwise seen from `outside`
    bool operator==(const Sides&) const = default;
};

struct LabelSurfaces {
    mesh::TriangleMesh mesh;  // positions (mm, RAS) and triangles
    std::vector<Sides> sides; // by triangle; `inside` is the lower label, but never kOutside
};

// `labels`: by voxel of the organ, at least -1 (voxel_groups()). Fails on more borders than 32-bit indices can count,
// and when cancelled (what == "cancelled").
[[nodiscard]] Result<LabelSurfaces> label_surfaces(const Organ& organ, std::span<const int> labels,
                                                   const JobRange& job);

// The closed surface of a label, with unit normals; of kOutside: the organ's own surface, facing inward. Where the
// label touches itself at a vertex only, that vertex is there twice. Empty: the label has no voxel.
[[nodiscard]] mesh::TriangleMesh surface_of(const LabelSurfaces& surfaces, int label);

} // namespace ramus::organ
