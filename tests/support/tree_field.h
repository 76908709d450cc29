// The field of a tree without its hidden branches.
#pragma once

#include "core/mesh/tree_field.h"

#include <cstdint>
#include <span>

namespace ramus::test {

inline field::Field make_field(const tree::VesselTree& tree, const mesh::SurfaceOptions& options,
                               std::span<const std::uint8_t> hidden) {
    const field::Field field = mesh::make_tree_field(tree, options).value().field; // nothing is checked
    return hidden.empty() ? field : field.without(hidden);
}

} // namespace ramus::test
