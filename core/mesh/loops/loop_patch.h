// LoopPatch: a copy of a part of a closed surface as a small closed surface. Loops of the whole surface that pass
// through the part can be found and cut in the patch.
//
// The borders of the part are closed by triangles to far points: one point for each border, or, for borders that are
// connected beyond the part, one sphere with a hole for each. So a closed line within the part divides the patch
// exactly if it divides the whole surface, and a line through the closing triangles is far longer than any other. Loops
// that do not pass through the part are not in the patch.
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

    // The patch. It may be cut along lines through vertices that are not barred.
    [[nodiscard]] TriangleMesh& closed() { return closed_; }
    // By vertex; not 0: the vertex belongs to a border or to the closing triangles. Vertices added by cuts are not
    // barred.
    [[nodiscard]] std::span<const std::uint8_t> barred() const { return barred_; }
    // Writes the cut patch back into its surface, and appends new vertices and triangles.
    void put_back(TriangleMesh& mesh) const;

private:
    void close(std::span<const std::uint32_t> border);
    [[nodiscard]] std::uint32_t add_far(std::uint32_t like);
    [[nodiscard]] glm::uvec3 open(std::size_t triangle);

    TriangleMesh closed_;
    std::vector<std::uint8_t> barred_;
    std::vector<std::uint32_t> vertices_;  // by vertex of the patch: the vertex of the surface
    std::vector<std::uint32_t> triangles_; // by triangle of the patch: the triangle of the surface
    std::size_t all_triangles_ = 0;        // number of triangles, the closing ones included, before cuts
};

} // namespace ramus::mesh
