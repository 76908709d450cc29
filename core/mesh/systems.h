// Vessel systems as surfaces: each system has a surface of its own, made as if the others were not there, so that
// vessels of two systems that touch or cross are never blended into one. Where they overlap, the surfaces intersect.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh {

// By branch id, not 0: hidden already, or of another system than this one.
[[nodiscard]] std::vector<std::uint8_t> hidden_beside(const tree::VesselTree& tree, int system,
                                                      std::span<const std::uint8_t> hidden);

// The same for one system after the other, those without a visible branch left out; `hidden` alone where no more than
// one system is visible.
[[nodiscard]] std::vector<std::vector<std::uint8_t>> hidden_by_system(const tree::VesselTree& tree,
                                                                      std::span<const std::uint8_t> hidden);

// Puts `more`, which has the same arrays, behind `mesh`.
void append(TriangleMesh& mesh, TriangleMesh more);

} // namespace ramus::mesh
