// Reads and writes GLB: glTF 2.0 in one binary file, for browsers and Blender. Written positions stay in mm and RAS (or
// LPS), exactly; the top node has the rotation and scale to glTF's metres, with +Y up and the patient's front toward
// +Z. Below it is a node for the whole mesh, for each system, or for each branch (below its system, if there are
// systems). Each node has a name, a mesh with vertices of its own, and the material of its colour. Vertices between two
// parts are in both, with equal positions and normals, so no seam is visible.
#pragma once

#include "core/base/error.h"
#include "core/io/buffered_file.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/meshes/mesh_names.h"
#include "core/mesh/triangle_mesh.h"

#include <string>

namespace ramus::io {

[[nodiscard]] bool is_glb(std::string_view head);

// Reads the triangles of the scene with the transforms of its nodes, and converts metres with +Y up to mm, RAS. Only
// files written by ramus state the axes: glTF has no word for the sides of a patient. Fails on damaged files, and on
// triangles that are compressed or in another file.
[[nodiscard]] Result<PolygonSoup> parse_glb(std::string_view text, const std::string& name);

// Writes POSITION, and NORMAL and _RADIUS (mm) if the mesh has them; indices have 32 bits. Of vessels also the branch
// of each vertex, as _FEATURE_ID_0 (EXT_mesh_features), and `extras` at the nodes of branches: branch, parent,
// children, radius (mean), length, generation, strahler, system; lengths in the unit of the top node. Compressed
// files (MeshNames::compressed) have what glb_arrays.h says. Fails, before
// anything is written, if the file would exceed the 4 GiB of the format. `where`: the place in the error.
[[nodiscard]] Result<void> write_glb(const mesh::TriangleMesh& mesh, const MeshNames& names, const std::string& where,
                                     BufferedFile& file);

} // namespace ramus::io
