// Writes a surface as VTP (VTK's PolyData), for ParaView, 3D Slicer and VMTK, with raw appended binary data.
#pragma once

#include "core/io/buffered_file.h"
#include "core/io/meshes/mesh_names.h"
#include "core/mesh/triangle_mesh.h"

namespace ramus::io {

// Writes triangles; point arrays Normals, Radius (mm) and GroupIds (branch id, VMTK's name) if the mesh has them; cell
// arrays GroupIds and, for trees with systems, SystemId. Field data state the unit, the axes and the names of systems,
// as in files of trees (core/io/vtk/vtk_dataset.h).
void write_vtp_surface(const mesh::TriangleMesh& mesh, const MeshNames& names, BufferedFile& file);

} // namespace ramus::io
