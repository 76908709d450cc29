#include "core/validate/shape.h"

#include "core/mesh/systems.h"

namespace ramus::validate {

mesh::Connectivity expected_shape(const tree::VesselTree& tree, std::span<const std::uint8_t> hidden) {
    mesh::Connectivity all;
    for (const auto& but_one_system : mesh::hidden_by_system(tree, hidden)) {
        const mesh::Connectivity one = mesh::connectivity_of(tree, but_one_system);
        all.pieces += one.pieces, all.loops += one.loops;
    }
    return all;
}

Shape shape_of(const tree::VesselTree& tree, const mesh::TriangleMesh& closed) {
    return {mesh::connectivity_of(closed), expected_shape(tree)};
}

} // namespace ramus::validate
