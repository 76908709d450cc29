// LoopPatch: a part of a closed surface as a small closed surface of its own, in which loops of the whole that lead
// through the part can be looked for and cut.
//
// Its borders are closed far away: by a point each, or, where some are connected beyond the part, by one sphere with as
// many holes. So a closed line within the part parts the patch where it parts the whole, and a line through what closes
// it is far longer than any other. Loops of the whole that do not lead through the part are not in the patch.
#pragma once

#include "core/mesh/loops/surface_parts.h"
#include "core/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh {

class LoopPatch {
public:
    LoopPatch(const TriangleMesh& mesh, const SurfacePart& part);

    // To be cut along lines through vertices that are not barred.
    [[nodiscard]] TriangleMesh& closed() { return closed_; }
    // By vertex, not 0: it is of a border, or of what closes it. Vertices that come later are not barred.
    [[nodiscard]] std::span<const std::uint8_t> barred() const { return barred_; }
    // Into the surface that it was made of, once it was cut; vertices and triangles that are new come last.
    void put_back(TriangleMesh& mesh) const;

private:
    void close(std::span<const std::uint32_t> border);
    [[nodiscard]] std::uint32_t add_far(std::uint32_t like);
    [[nodiscard]] glm::uvec3 open(std::size_t triangle);

    TriangleMesh closed_;
    std::vector<std::uint8_t> barred_;
    std::vector<std::uint32_t> vertices_;  // of the surface, by number here
    std::vector<std::uint32_t> triangles_; // of the surface, by number here
    std::size_t all_triangles_ = 0;        // with those that close it
};

} // namespace ramus::mesh
