// What is around each brick of a part of the octree.
#pragma once

#include "core/base/chunked_array.h"
#include "core/mesh/polygonize/octree/entries_around.h"
#include "core/mesh/polygonize/octree/neighbours.h"

namespace ramus::mesh::bricks {

// Describes the bricks at and below the entry in the middle of `around`. There is memory for them in `found`.
void describe_bricks(const Octree& octree, const EntriesAround& around, ChunkedArray<Neighbourhood>& found);

} // namespace ramus::mesh::bricks
