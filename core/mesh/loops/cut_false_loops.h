// False loops: those of a surface that its tree has no cycle for. Where vessels part or pass each other within a cell
// or two, the last of them are left by field and cells; here the surface is cut there.
#pragma once

#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"

namespace ramus::mesh {

// Whether a surface of which each edge has two triangles has other pieces and loops, in sum, than its tree. Triangles
// without area that have one vertex twice do not count, nor do vertices that none has. Quick.
[[nodiscard]] bool has_other_loops(const TriangleMesh& mesh, const tree::VesselTree& tree);

// Cuts a closed surface until it has no more loops than its tree, along the shortest line each time that goes around no
// vessel: around a connection that the tree has not, or around the hole beside it. Holes are filled only where the tree
// has no cycle at all, or one of its own might be. Where no such line is short, a loop stays. `mesh`: each vertex has
// triangles, each triangle three vertices. `tree`: what the surface was made of. Returns how many loops are cut; fewer
// if cancelled, none where it would take more than `memory_bytes`.
std::size_t cut_false_loops(TriangleMesh& mesh, const tree::VesselTree& tree, double memory_bytes, Job& job);

} // namespace ramus::mesh
