// The surface of a mask without the steps of its voxels, for the eye: relaxed within its voxels (S. F. F. Gibson,
// Constrained Elastic Surface Nets, 1998) in a way that keeps thin parts as thick as they are (J. Vollmer et al.,
// Improved Laplacian Smoothing of Noisy Surface Meshes, 1999). Measures are of the surface as it was.
#pragma once

#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"

#include <glm/mat4x4.hpp>

namespace ramus::volume {

// Draws every vertex towards the middle of its neighbours, over and over, and takes back by how much all around were
// drawn: steps go, thickness stays. Never farther than half a voxel along
// each axis of the volume from where it was: so every voxel stays on its side of the surface, or on it. Gives normals
// anew. `to_patient`: from voxels to mm. Stops early when `job` is cancelled.
void relax_surface(mesh::TriangleMesh& surface, const glm::dmat4& to_patient, int passes, const Job& job);

} // namespace ramus::volume
