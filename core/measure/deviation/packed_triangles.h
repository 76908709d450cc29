// PackedTriangles: the triangles of a mesh in a tree of boxes, eight to a leaf and eight boxes to a node, so that
// vectors look at all of them at once. Triangles are put along a Hilbert curve and packed in that order: the tree is
// made in the time that sorting takes. Distances are those to the triangles themselves, in double precision from the
// mesh's single ones; the same bits for any number of threads, any order of points and any instruction set. Immutable.
// Corners are copied for the vectors where the mesh is small; of a large one, the copy would be larger than the mesh
// itself, and those of a leaf are gathered from the mesh whenever it is looked at: slower, with the same bits.
#pragma once

#include "core/base/large_array.h"
#include "core/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::measure {

inline constexpr std::uint32_t kPack = 8;

// Triangles that are not there repeat another one.
struct PackedLeaf {
    float corner[3][3][kPack]; // corner, axis, triangle
};
// Boxes of what is below; those that are not there are empty (least above most).
struct PackedNode {
    float least[3][kPack], most[3][kPack]; // axis, child
};

// What queries need, as plain arrays. Level 0 has the nodes whose children are leaves, the last level the root alone;
// the children of node n of a level are 8 n and on, one level below.
struct PackedView {
    const PackedLeaf* leaves = nullptr; // null: fill_leaf() makes them
    const PackedNode* nodes = nullptr;  // level by level
    std::uint32_t first[12] = {};       // node of each level
    std::uint32_t levels = 0;
    const glm::vec3* positions = nullptr; // of the mesh
    const glm::uvec3* triangles = nullptr;
    const std::uint32_t* order = nullptr; // of the triangles in the leaves
    std::size_t count = 0;                // of triangles
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

// Where a line leaves a surface, or enters one.
struct Crossing {
    double at = 0.0;  // mm along the line
    bool out = false; // from inside to outside, as the triangle is turned
    std::uint32_t triangle = 0;
};

class PackedTriangles {
public:
    // The mesh has a triangle at least, and outlives this. Of more than `most_copied` triangles corners are not copied.
    // Arrays are where `memory` is.
    explicit PackedTriangles(const mesh::TriangleMesh& mesh, std::size_t most_copied = kMostCopied,
                             const LargeAllocator<std::byte>& memory = {});
    explicit PackedTriangles(mesh::TriangleMesh&& mesh, std::size_t most_copied = kMostCopied) = delete;
    PackedTriangles(const PackedTriangles&) = delete; // view_ points into it
    PackedTriangles& operator=(const PackedTriangles&) = delete;

    // mm from each point to the nearest triangle. All of TBB's threads of the caller's arena; quick where points that
    // are near each other are near the surface.
    [[nodiscard]] LargeArray<double> distances(std::span<const glm::vec3> points) const;

    // All crossings within `length` mm along a unit direction, nearest first; not those behind. Where a line goes
    // through the edge of two triangles it crosses once.
    void crossings(const glm::dvec3& from, const glm::dvec3& direction, double length,
                   std::vector<Crossing>& found) const;
    // The first place more than `after` mm along a unit direction where the line leaves the surface; at infinity where
    // there is none.
    [[nodiscard]] Crossing first_exit(const glm::dvec3& from, const glm::dvec3& direction, double after) const;

private:
    void make_nodes(std::size_t leaves); // of so many

    LargeArray<PackedLeaf> leaves_; // none where corners are not copied
    LargeArray<PackedNode> nodes_;
    LargeArray<std::uint32_t> order_; // of the mesh's triangles in the leaves
    PackedView view_;
};

// The places in the order in which a Hilbert curve through their box meets them.
[[nodiscard]] LargeArray<std::uint32_t> along_hilbert_curve(std::span<const glm::vec3> places);

} // namespace ramus::measure
