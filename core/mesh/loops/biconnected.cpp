#include "core/mesh/loops/biconnected.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/biconnected_components.hpp>
#include <vector>

namespace ramus::mesh {

namespace {

// Removes nodes with one edge until none is left. Returns the other edges, ascending.
LargeArray<std::uint32_t> without_ends(std::span<const GraphEdge> edges, std::size_t nodes,
                                       const LargeAllocator<std::byte>& memory) {
    struct Node {
        std::uint32_t count = 0, edges = 0; // of its edges, and their numbers combined by XOR: the last one remains
    };
    LargeArray<Node> left(nodes, Node{}, memory);
    const auto change = [&](std::uint32_t node, std::uint32_t edge, std::uint32_t by) {
        left[node].count += by, left[node].edges ^= edge;
    };
    for (std::uint32_t n = 0; n < edges.size(); ++n)
        for (const std::uint32_t node : edges[n]) change(node, n, 1U);
    LargeArray<std::uint8_t> removed(edges.size(), 0, memory);
    for (std::uint32_t n = 0; n < nodes; ++n)
        for (std::uint32_t node = n; left[node].count == 1;) {
            const std::uint32_t edge = left[node].edges;
            removed[edge] = 1;
            for (const std::uint32_t end : edges[edge]) change(end, edge, 0U - 1U);
            node = edges[edge][0] == node ? edges[edge][1] : edges[edge][0];
        }
    LargeArray<std::uint32_t> others(memory);
    for (std::uint32_t n = 0; n < edges.size(); ++n)
        if (removed[n] == 0) others.push_back(n);
    return others;
}

} // namespace

LargeArray<std::uint32_t> biconnected_components(std::span<const GraphEdge> edges, std::size_t nodes,
                                                 const LargeAllocator<std::byte>& memory) {
    LargeArray<std::uint32_t> component(edges.size(), kOnNoCycle, memory);
    const LargeArray<std::uint32_t> others = without_ends(edges, nodes, memory);
    // Boost expects one edge for two nodes, so each edge is a node, too.
    using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property,
                                        boost::property<boost::edge_index_t, std::size_t>>;
    LargeArray<std::uint32_t> number(nodes, kOnNoCycle, memory);
    std::size_t numbered = others.size();
    for (const std::uint32_t edge : others)
        for (const std::uint32_t node : edges[edge])
            if (number[node] == kOnNoCycle) number[node] = static_cast<std::uint32_t>(numbered++);
    Graph graph(numbered);
    for (std::size_t n = 0; n < others.size(); ++n)
        for (std::size_t end = 0; end < 2; ++end) boost::add_edge(n, number[edges[others[n]][end]], 2 * n + end, graph);
    std::vector<std::size_t> half(2 * others.size(), 0); // by half of an edge: its component
    boost::biconnected_components(
        graph, boost::make_iterator_property_map(half.begin(), boost::get(boost::edge_index, graph)));
    for (std::size_t n = 0; n < others.size(); ++n)
        if (half[2 * n] == half[2 * n + 1]) component[others[n]] = static_cast<std::uint32_t>(half[2 * n]);
    return component;
}

} // namespace ramus::mesh
