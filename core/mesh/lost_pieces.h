// What a surface has not: pieces of a tree, connected and hidden branches left out, of which not one vertex is on it.
// They are far shorter than they are thick, so that the field of their axes never reaches the isovalue, or thinner than
// the cells.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh {

// Notes which branches vertices belong to, as a surface comes.
class SeenBranches {
public:
    explicit SeenBranches(std::size_t branches) : seen_(branches, 0) {}
    void add(std::span<const std::int32_t> vertex_branches);
    [[nodiscard]] bool has(std::size_t branch) const { return seen_[branch] != 0; }

private:
    std::vector<std::uint8_t> seen_;
};

// Branches of each such piece, ascending; the piece of the lowest branch first. `hidden`: by branch, not 0; may be
// empty.
[[nodiscard]] std::vector<std::vector<int>> lost_pieces(const tree::VesselTree& tree,
                                                        std::span<const std::uint8_t> hidden, const SeenBranches& seen);

} // namespace ramus::mesh
