// Finds lost pieces: connected components of the visible tree that have no vertex on the surface. Such a piece is far
// shorter than it is thick, so that its field never reaches the isovalue, or it is thinner than the cells.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh {

// The set of branches that have vertices. Filled while a surface is written.
class SeenBranches {
public:
    explicit SeenBranches(std::size_t branches) : seen_(branches, 0) {}
    void add(std::span<const std::int32_t> vertex_branches);
    [[nodiscard]] bool has(std::size_t branch) const { return seen_[branch] != 0; }

private:
    std::vector<std::uint8_t> seen_;
};

// The branches of each lost piece, ascending; pieces in the order of their lowest branch. `hidden`: by branch, not 0 if
// hidden; may be empty.
[[nodiscard]] std::vector<std::vector<int>> lost_pieces(const tree::VesselTree& tree,
                                                        std::span<const std::uint8_t> hidden, const SeenBranches& seen);

} // namespace ramus::mesh
