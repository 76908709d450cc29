// Biconnected components of a graph: two edges are in one component if a cycle contains both.
#pragma once

#include "core/base/large_array.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace ramus::mesh {

using GraphEdge = std::array<std::uint32_t, 2>; // two different nodes
constexpr std::uint32_t kOnNoCycle = std::numeric_limits<std::uint32_t>::max();

// By edge of an undirected graph, in which two nodes may have several edges: the number of its component, or
// kOnNoCycle. What is no cycle and hangs on none is removed first, so most memory is for the rest: 200 bytes for each
// of its edges.
[[nodiscard]] LargeArray<std::uint32_t> biconnected_components(std::span<const GraphEdge> edges, std::size_t nodes,
                                                               const LargeAllocator<std::byte>& memory = {});

} // namespace ramus::mesh
