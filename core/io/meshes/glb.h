// GLB: glTF 2.0 in one binary file, for browsers and for Blender. Positions stay in mm and RAS (or LPS), to the bit;
// the node above all others has the rotation and the scale that make metres of them, with +Y up and the patient's front
// toward +Z, as glTF wants. Below it is one node for each system, for each branch (below its system, where there are
// any), or for the whole; each with its name, a mesh of its own vertices, and the material of its colour. Vertices
// where two parts meet are in both, so that what is shown together shows no seam.
#pragma once

#include "core/base/error.h"
#include "core/io/buffered_file.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/meshes/mesh_names.h"
#include "core/mesh/triangle_mesh.h"

#include <string>

namespace ramus::io {

[[nodiscard]] bool is_glb(std::string_view head);

// The triangles of the scene, where its nodes place them, from metres with +Y up back to mm, RAS. Only what ramus wrote
// states its axes: glTF has no word for the sides of a patient. Fails on what is damaged, and on triangles that are
// compressed or in another file.
[[nodiscard]] Result<PolygonSoup> parse_glb(std::string_view text, const std::string& name);

// POSITION, and where the mesh has them NORMAL and _RADIUS (mm); indices of 32 bits. Fails, before anything is written,
// on more than the 4 GiB that such a file can have; `where` is what the error names. Little-endian.
[[nodiscard]] Result<void> write_glb(const mesh::TriangleMesh& mesh, const MeshNames& names, const std::string& where,
                                     BufferedFile& file);

} // namespace ramus::io
