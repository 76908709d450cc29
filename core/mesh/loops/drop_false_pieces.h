// False pieces: pieces of a closed surface that are no vessel of its tree. Where vessels run close together around a
// joint, they may enclose a cavity, or a spot where the field just reaches the isovalue.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"

#include <cstddef>

namespace ramus::mesh {

// Removes every piece that faces inward (a cavity), and every piece without an axis of the tree in its bounding box.
// What is left stays in its order. `tree`: what the surface was made of. Returns how many pieces are removed. Takes 25
// ns for each triangle of a surface that has one piece.
std::size_t drop_false_pieces(TriangleMesh& mesh, const tree::VesselTree& tree);

} // namespace ramus::mesh
