// PackedTriangles: a bounding-volume hierarchy over the triangles of a mesh for distance and ray queries: a BoxTree
// (core/base/box_tree.h) whose leaves are eight triangles each, so that SIMD processes all of them at once. Triangles
// are sorted along a Hilbert curve and packed in that order, so building takes about the time of the sort.
//
// Guarantees: distances are to the triangles themselves, computed in double precision; the same bits for any number of
// threads, any order of points and any instruction set. Immutable. Leaves contain copies of the corners. For a large
// mesh these copies would be larger than the mesh, so the corners of a leaf are gathered from the mesh in each query:
// slower, with the same bits.
#pragma once

#include "core/base/box_tree.h"
#include "core/base/large_array.h"
#include "core/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace ramus::measure {

inline constexpr std::uint32_t kPack = EightBoxes::kCount;

// Unused entries repeat another triangle.
struct PackedLeaf {
    float corner[3][3][kPack]; // corner, axis, triangle
};

// The data for queries, as plain arrays.
struct PackedView {
    const PackedLeaf* leaves = nullptr; // null: queries call fill_leaf()
    const EightBoxes* levels[12] = {};  // of the BoxTree; the children of nodes of level 0 are leaves
    std::uint32_t level_count = 0;
    const glm::vec3* positions = nullptr; // of the mesh
    const glm::uvec3* triangles = nullptr;
    const std::uint32_t* order = nullptr; // by place in the leaves: the triangle of the mesh
    std::size_t count = 0;                // number of triangles
};

inline void fill_leaf(const PackedView& view, std::size_t number, PackedLeaf& leaf) {
    for (std::uint32_t n = 0; n < kPack; ++n) {
        const std::size_t at = number * kPack + n;
        const glm::uvec3& t = view.triangles[view.order[at < view.count ? at : view.count - 1]];
        for (int corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 3; ++axis) leaf.corner[corner][axis][n] = view.positions[t[corner]][axis];
    }
}

inline constexpr std::size_t kMostCopied = 16'000'000; // triangles, 36 bytes each

// A place where a line leaves or enters a surface.
struct Crossing {
    double at = 0.0;  // mm along the line
    bool out = false; // from inside to outside, by the orientation of the triangle
    std::uint32_t triangle = 0;
};

class PackedTriangles {
public:
    // The mesh must have at least one triangle, and must outlive the object. Corners are not copied if there are more
    // than `most_copied` triangles. `memory`: the allocator of the arrays.
    explicit PackedTriangles(const mesh::TriangleMesh& mesh, std::size_t most_copied = kMostCopied,
                             const LargeAllocator<std::byte>& memory = {});
    explicit PackedTriangles(mesh::TriangleMesh&& mesh, std::size_t most_copied = kMostCopied) = delete;
    PackedTriangles(const PackedTriangles&) = delete; // view_ points into it
    PackedTriangles& operator=(const PackedTriangles&) = delete;

    // The distance (mm) from each point to the nearest triangle. Uses the TBB threads of the caller's arena. Fast if
    // the points are near the surface.
    [[nodiscard]] LargeArray<double> distances(std::span<const glm::vec3> points) const;

    // All crossings within `length` mm along a unit direction, the nearest first. A line through the edge of two
    // triangles crosses once.
    void crossings(const glm::dvec3& from, const glm::dvec3& direction, double length,
                   std::vector<Crossing>& found) const;
    // The first place more than `after` mm along a unit direction where the line leaves the surface; at infinity if
    // there is none.
    [[nodiscard]] Crossing first_exit(const glm::dvec3& from, const glm::dvec3& direction, double after) const;

private:
    LargeArray<PackedLeaf> leaves_;   // empty if corners are not copied
    std::optional<BoxTree> tree_;     // of leaves
    LargeArray<std::uint32_t> order_; // PackedView::order
    PackedView view_;
};

} // namespace ramus::measure
