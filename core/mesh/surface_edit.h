// SurfaceEdit: which parts of a mesh were rewritten, so that a copy of it (on the graphics card, say) can follow.
#pragma once

#include <cstdint>
#include <vector>

namespace ramus::mesh {

struct SlotRange {
    std::uint64_t first = 0, count = 0;
};

struct SurfaceEdit {
    bool whole = false; // everything; the ranges do not matter
    std::vector<SlotRange> vertices, triangles;
};

} // namespace ramus::mesh
