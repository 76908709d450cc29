#include "core/validate/shape.h"

#include "core/mesh/systems.h"

namespace ramus::validate {

measure::Connectivity expected_shape(const tree::VesselTree& tree, std::span<const std::uint8_t> hidden) {
    measure::Connectivity all;
    for (const auto& but_one_system : mesh::hidden_by_system(tree, hidden)) {
        const measure::Connectivity one = measure::connectivity_of(tree, but_one_system);
        all.pieces += one.pieces, all.loops += one.loops;
    }
    return all;
}

Shape shape_of(const tree::VesselTree& tree, const mesh::TriangleMesh& closed) {
    return {measure::connectivity_of(closed), expected_shape(tree)};
}

} // namespace ramus::validate
