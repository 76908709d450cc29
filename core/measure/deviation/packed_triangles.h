// PackedTriangles: the triangles of a mesh in a tree of boxes, eight to a leaf and eight boxes to a node, so that
// vectors look at all of them at once. Triangles are put along a Hilbert curve and packed in that order: the tree is
// made in the time that sorting takes. Distances are those to the triangles themselves, in double precision from the
// mesh's single ones; the same bits for any number of threads, any order of points and any instruction set. Immutable.
#pragma once

#include "core/base/large_array.h"
#include "core/mesh/triangle_mesh.h"

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
    const PackedLeaf* leaves = nullptr;
    const PackedNode* nodes = nullptr; // level by level
    std::uint32_t first[12] = {};      // node of each level
    std::uint32_t levels = 0;
};

// Where a line leaves a surface, or enters one.
struct Crossing {
    double at = 0.0;  // mm along the line
    bool out = false; // from inside to outside, as the triangle is turned
    std::uint32_t triangle = 0;
};

class PackedTriangles {
public:
    // The mesh has a triangle at least, and need not outlive this.
    explicit PackedTriangles(const mesh::TriangleMesh& mesh);

    // mm from each point to the nearest triangle. All of TBB's threads of the caller's arena; quick where points that
    // are near each other are near the surface.
    [[nodiscard]] LargeArray<double> distances(std::span<const glm::vec3> points) const;

    // All crossings within `length` mm along a unit direction, nearest first; not those behind. Where a line goes
    // through the edge of two triangles it crosses once.
    void crossings(const glm::dvec3& from, const glm::dvec3& direction, double length,
                   std::vector<Crossing>& found) const;

private:
    LargeArray<PackedLeaf> leaves_;
    LargeArray<PackedNode> nodes_;
    std::vector<std::uint32_t> order_; // of the mesh's triangles in the leaves
    PackedView view_;
};

// The places in the order in which a Hilbert curve through their box meets them.
[[nodiscard]] std::vector<std::uint32_t> along_hilbert_curve(std::span<const glm::vec3> places);

} // namespace ramus::measure
