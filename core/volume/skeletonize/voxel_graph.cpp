#include "core/volume/skeletonize/voxel_graph.h"

#include "core/base/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::volume {

namespace {

using Address = VoxelSet::Address;

// The cells of a closed cube (itself, 6 faces, 12 edges, 8 corners), indexed as bits of a neighbourhood. For each cell:
// the neighbours before the cube whose cubes share the cell, and the sign of its dimension in the Euler number.
constexpr auto kFirstOf = [] {
    std::array<Neighbourhood, 27> before{};
    for (int cell = 0; cell < 27; ++cell)
        for (int other = 0; other < kCentreBit; ++other) {
            bool holds = true;
            for (const int power : {1, 3, 9}) {
                const int at = other / power % 3;
                holds &= at == 1 || at == cell / power % 3;
            }
            if (holds) before[static_cast<std::size_t>(cell)] |= Neighbourhood{1} << other;
        }
    return before;
}();
constexpr auto kSigns = [] {
    std::array<int, 27> signs{};
    for (int cell = 0; cell < 27; ++cell) {
        const int dimension = (cell % 3 == 1 ? 1 : 0) + (cell / 3 % 3 == 1 ? 1 : 0) + (cell / 9 == 1 ? 1 : 0);
        signs[static_cast<std::size_t>(cell)] = dimension % 2 == 0 ? 1 : -1;
    }
    return signs;
}();

enum class Kind : std::uint8_t { kEnd, kLine, kKnot };

class GraphBuilder {
public:
    GraphBuilder(const SparseMask& skeleton, const VoxelSet& set, const LargeArray<float>& distances)
        : voxels_(skeleton, set.spacing()), knots_(voxels_.bits()) {
        addresses_.reserve(voxels_.count());
        voxels_.for_each([&](Address at) { addresses_.push_back(at); });
        kinds_.reserve(addresses_.size());
        middles_.reserve(addresses_.size());
        for (const Address at : addresses_) {
            kinds_.push_back(kind_of(at));
            if (kinds_.back() != Kind::kKnot) knots_.clear_bit(at);
            const glm::ivec3 inner = voxels_.voxel(at); // in the box of `set`
            const std::uint32_t number = set.number(set.address(inner));
            middles_.push_back(
                {set.spacing() * glm::dvec3(inner + set.origin()), static_cast<double>(distances[number]), number});
        }
        joined_.add(addresses_.size());
        node_of_.assign(addresses_.size(), kNone);
        walked_.assign(addresses_.size(), false);
    }

    VoxelGraph build() && {
        make_knots();
        for_ends([&](std::uint32_t v) { node_of_[v] = add_node(middles_[v]); });
        connect_ends();
        for (std::uint32_t v = 0; v < kinds_.size(); ++v)
            if (kinds_[v] == Kind::kKnot)
                for_neighbours(v, [&](std::uint32_t next) {
                    if (kinds_[next] == Kind::kLine && !walked_[next]) walk(v, next);
                });
        for (std::uint32_t v = 0; v < kinds_.size(); ++v) // rings
            if (kinds_[v] == Kind::kLine && !walked_[v]) walk_ring(v);
        return std::move(graph_);
    }

private:
    static constexpr int kNone = -1;

    [[nodiscard]] Neighbourhood around(Address at) const { return neighbourhood(voxels_.bits(), at) & kNeighbours; }

    [[nodiscard]] static bool touch(int a, int b) { // of two bits of a neighbourhood
        return std::abs(a % 3 - b % 3) <= 1 && std::abs(a / 3 % 3 - b / 3 % 3) <= 1 && std::abs(a / 9 - b / 9) <= 1;
    }
    [[nodiscard]] Kind kind_of(Address at) const {
        const Neighbourhood near = around(at);
        const int count = std::popcount(near);
        if (count > 2) return Kind::kKnot;
        if (count < 2) return Kind::kEnd;
        return touch(std::countr_zero(near), 31 - std::countl_zero(near)) ? Kind::kEnd : Kind::kLine;
    }
    template <class Call> void for_neighbours(std::uint32_t v, const Call& call) const {
        for (Neighbourhood left = around(addresses_[v]); left != 0; left &= left - 1)
            call(voxels_.number(
                static_cast<Address>(static_cast<std::int64_t>(addresses_[v]) + voxels_.step(std::countr_zero(left)))));
    }
    template <class Call> void for_ends(const Call& call) const {
        for (std::uint32_t v = 0; v < kinds_.size(); ++v)
            if (kinds_[v] == Kind::kEnd) call(v);
    }
    int add_node(const MidPoint& at) {
        graph_.nodes.push_back(at);
        return static_cast<int>(graph_.nodes.size()) - 1;
    }

    void make_knots() {
        for (std::uint32_t v = 0; v < kinds_.size(); ++v)
            if (kinds_[v] == Kind::kKnot)
                for_neighbours(v, [&](std::uint32_t other) {
                    if (kinds_[other] == Kind::kKnot) joined_.join(v, other);
                });
        std::vector<std::vector<std::uint32_t>> knots;
        std::vector<int> knot_of(kinds_.size(), kNone);
        for (std::uint32_t v = 0; v < kinds_.size(); ++v) {
            if (kinds_[v] != Kind::kKnot) continue;
            int& knot = knot_of[joined_.find(v)];
            if (knot == kNone) knot = static_cast<int>(knots.size()), knots.emplace_back();
            knots[static_cast<std::size_t>(knot)].push_back(v);
        }
        for (const std::vector<std::uint32_t>& knot : knots) {
            if (const int rings = rings_in(knot); rings > 0)
                add_knot_with_rings(knot, rings);
            else
                add_knot(knot);
        }
    }

    void add_knot(const std::vector<std::uint32_t>& knot) {
        MidPoint middle;
        middle.voxel = middles_[knot[0]].voxel;
        for (const std::uint32_t v : knot) {
            middle.position += middles_[v].position / static_cast<double>(knot.size());
            middle.distance = std::max(middle.distance, middles_[v].distance);
        }
        const int node = add_node(middle);
        for (const std::uint32_t v : knot) node_of_[v] = node;
    }

    // The number of loops in a knot: 1 - Euler number (vertices - edges + faces - cubes) of the union of its closed
    // cubes. Knots do not touch each other.
    [[nodiscard]] int rings_in(const std::vector<std::uint32_t>& knot) const {
        if (knot.size() < 4) return 0;
        int number = 0;
        for (const std::uint32_t v : knot) { // counts each cell at the first of its voxels
            const Neighbourhood mates = neighbourhood(knots_, addresses_[v]);
            for (int cell = 0; cell < 27; ++cell)
                if ((mates & kFirstOf[static_cast<std::size_t>(cell)]) == 0)
                    number += kSigns[static_cast<std::size_t>(cell)];
        }
        return 1 - number;
    }

    // Makes each voxel a node. Adds a spanning tree and one more connection for each loop. Connections that are no side
    // of a triangle come first, because triangles are filled.
    void add_knot_with_rings(const std::vector<std::uint32_t>& knot, int rings) {
        for (const std::uint32_t v : knot) node_of_[v] = add_node(middles_[v]);
        struct Link {
            bool in_triangle;
            double length;
            std::uint32_t a, b;
        };
        std::vector<Link> links;
        for (const std::uint32_t v : knot)
            for_neighbours(v, [&](std::uint32_t other) {
                if (other <= v || kinds_[other] != Kind::kKnot) return;
                bool in_triangle = false;
                for_neighbours(v, [&](std::uint32_t third) {
                    if (third != other) for_neighbours(third, [&](std::uint32_t u) { in_triangle |= u == other; });
                });
                links.push_back({in_triangle, glm::distance(middles_[v].position, middles_[other].position), v, other});
            });
        std::ranges::stable_sort(links, {}, [](const Link& link) { return std::pair(link.in_triangle, link.length); });
        // Indexed by position in the knot, whose voxels ascend: an array of all voxels for each knot would take
        // quadratic time.
        DisjointSets joined(knot.size());
        const auto place = [&](std::uint32_t v) {
            return static_cast<std::uint32_t>(std::ranges::lower_bound(knot, v) - knot.begin());
        };
        std::vector<Link> further;
        for (const Link& link : links) {
            if (joined.join(place(link.a), place(link.b)))
                graph_.lines.push_back({node_of_[link.a], node_of_[link.b], {}});
            else
                further.push_back(link);
        }
        for (std::size_t n = 0; n < further.size() && n < static_cast<std::size_t>(rings); ++n)
            graph_.lines.push_back({node_of_[further[n].a], node_of_[further[n].b], {}});
    }

    // Connects each end with its neighbour. Where two ends and a knot, or three ends, are mutually adjacent, takes the
    // shortest connections that join all of them.
    void connect_ends() {
        struct Link {
            double length;
            std::uint32_t end, other; // of two ends, `end` is the later one
        };
        std::vector<Link> links;
        for_ends([&](std::uint32_t v) {
            for_neighbours(v, [&](std::uint32_t other) {
                if (kinds_[other] == Kind::kKnot || (kinds_[other] == Kind::kEnd && other < v))
                    links.push_back({glm::distance(middles_[v].position, middles_[other].position), v, other});
            });
        });
        std::ranges::stable_sort(links, {}, &Link::length);
        std::vector<Link> ways;
        for (const Link& link : links)
            if (joined_.join(link.end, link.other)) ways.push_back(link);
        std::ranges::stable_sort(ways, {}, &Link::end);
        auto way = ways.begin();
        for_ends([&](std::uint32_t v) {
            for_neighbours(v, [&](std::uint32_t next) {
                if (kinds_[next] == Kind::kLine && !walked_[next]) walk(v, next);
            });
            for (; way != ways.end() && way->end == v; ++way)
                graph_.lines.push_back({node_of_[v], node_of_[way->other], {}});
        });
    }

    void walk(std::uint32_t from, std::uint32_t first) {
        VoxelGraph::Line line{node_of_[from], kNone, {}};
        std::uint32_t before = from, at = first;
        while (kinds_[at] == Kind::kLine && !walked_[at]) {
            walked_[at] = true;
            line.points.push_back(middles_[at]);
            std::uint32_t next = at;
            for_neighbours(at, [&](std::uint32_t other) {
                if (other != before) next = other;
            });
            before = at, at = next;
        }
        line.to = node_of_[at];
        if (line.to == line.from) { // adds the voxels of the knot, so that the ring is not too short
            line.points.insert(line.points.begin(), middles_[from]);
            line.points.push_back(middles_[at]);
        }
        graph_.lines.push_back(std::move(line));
    }

    void walk_ring(std::uint32_t v) {
        node_of_[v] = add_node(middles_[v]);
        walked_[v] = true;
        VoxelGraph::Line line{node_of_[v], node_of_[v], {}};
        std::uint32_t before = v, at = v;
        while (true) {
            std::uint32_t next = v;
            for_neighbours(at, [&](std::uint32_t other) {
                if (other != before && !walked_[other]) next = other;
            });
            if (next == v) break;
            before = at, at = next;
            walked_[at] = true;
            line.points.push_back(middles_[at]);
        }
        graph_.lines.push_back(std::move(line));
    }

    VoxelSet voxels_;
    SparseMask knots_; // the voxels that belong to a knot
    std::vector<Address> addresses_;
    std::vector<Kind> kinds_;
    std::vector<MidPoint> middles_;
    DisjointSets joined_; // voxels of one knot, then also ends with their connections
    std::vector<int> node_of_;
    std::vector<bool> walked_;
    VoxelGraph graph_;
};

} // namespace

std::vector<int> VoxelGraph::degrees() const {
    std::vector<int> degrees(nodes.size(), 0);
    for (const Line& line : lines)
        ++degrees[static_cast<std::size_t>(line.from)], ++degrees[static_cast<std::size_t>(line.to)];
    return degrees;
}

VoxelGraph graph_of(const SparseMask& skeleton, const VoxelSet& set, const LargeArray<float>& distances) {
    return GraphBuilder(skeleton, set, distances).build();
}

double length_mm(const VoxelGraph& graph, const VoxelGraph::Line& line) {
    double sum = 0.0;
    glm::dvec3 last = graph.nodes[static_cast<std::size_t>(line.from)].position;
    for (const MidPoint& point : line.points) {
        sum += glm::distance(last, point.position);
        last = point.position;
    }
    return sum + glm::distance(last, graph.nodes[static_cast<std::size_t>(line.to)].position);
}

} // namespace ramus::volume
