// The surface of a tree divided along the borders between branches, so that each triangle belongs to one branch, and
// the triangles of a branch with all its dependents are one range.
//
// Guaranteed: a closed surface stays closed, since branches share the vertices on their borders; a border lies where
// pictures draw it (shaders/border.geom), except that it
// goes through a corner that is within a fifth of an edge.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/tree/dependency.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::app {

struct BranchSurface {
    std::vector<glm::vec3> positions;   // mm, RAS
    std::vector<std::uint32_t> indices; // three for each triangle, counter-clockwise seen from outside
    std::vector<std::uint32_t> first;   // by rank: index of the branch's first triangle; one more entry at the end
    std::vector<float> radius_mm;       // by rank: of the vessel at the thinnest vertex; 0: no triangle
    [[nodiscard]] std::size_t triangles() const { return indices.size() / 3; }
};

// The rank of a branch is its place in dependency.order(). Triangles without area are left out. `mesh`: vertices have
// branches of that tree.
[[nodiscard]] BranchSurface divided_by_branch(const mesh::TriangleMesh& mesh, const tree::Dependency& dependency);
// The same for a surface without branches: all triangles are one range.
[[nodiscard]] BranchSurface undivided(const mesh::TriangleMesh& mesh);

} // namespace ramus::app
