// VTP: the surface as VTK's PolyData, for ParaView, 3D Slicer and VMTK. Numbers are appended raw, as they lie in
// memory.
#pragma once

#include "core/io/buffered_file.h"
#include "core/io/meshes/mesh_names.h"
#include "core/mesh/triangle_mesh.h"

namespace ramus::io {

// Triangles; of points Normals, Radius (mm) and GroupIds (the branch, as VMTK names it), where the mesh has them; of
// cells GroupIds and, of trees with systems, SystemId. Field data say the unit and the axes, and what the systems are
// called, as in files of trees (core/io/vtk/vtk_dataset.h).
void write_vtp_surface(const mesh::TriangleMesh& mesh, const MeshNames& names, BufferedFile& file);

} // namespace ramus::io
