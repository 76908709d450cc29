// Biconnected components, against all cycles of small graphs.
#include "core/base/disjoint_sets.h"
#include "core/mesh/loops/biconnected.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <random>
#include <vector>

using namespace ramus;
using namespace ramus::mesh;

namespace {

// Calls call(cycle) for every cycle of a graph, as its edges, each several times.
class Cycles {
public:
    Cycles(std::span<const GraphEdge> edges, std::uint32_t nodes) : edges_(edges), passed_(nodes, false) {}

    template <class Call> void for_each(const Call& call) {
        for (start_ = 0; start_ < passed_.size(); ++start_) go_on(start_, call);
    }

private:
    template <class Call> void go_on(std::uint32_t at, const Call& call) {
        passed_[at] = true;
        for (std::uint32_t n = 0; n < edges_.size(); ++n) {
            if (std::ranges::find(edges_[n], at) == edges_[n].end() || std::ranges::find(way_, n) != way_.end())
                continue;
            const std::uint32_t next = edges_[n][0] == at ? edges_[n][1] : edges_[n][0];
            way_.push_back(n);
            if (next == start_)
                call(way_);
            else if (!passed_[next])
                go_on(next, call);
            way_.pop_back();
        }
        passed_[at] = false;
    }

    std::span<const GraphEdge> edges_;
    std::vector<bool> passed_; // by node
    std::vector<std::uint32_t> way_;
    std::uint32_t start_ = 0;
};

} // namespace

TEST_CASE("two edges are in one biconnected component if a cycle contains both, also where nodes have several edges") {
    std::mt19937 random(20051025);
    std::size_t on_cycles = 0, on_none = 0;
    for (int graph = 0; graph < 400; ++graph) {
        const std::uint32_t nodes = 2 + random() % 6;
        std::vector<GraphEdge> edges;
        for (std::size_t n = random() % 10; n > 0; --n) {
            const auto from = static_cast<std::uint32_t>(random() % nodes);
            const auto to = static_cast<std::uint32_t>((from + 1 + random() % (nodes - 1)) % nodes);
            edges.push_back({from, to});
        }
        DisjointSets together(edges.size());
        std::vector<bool> on_cycle(edges.size(), false);
        Cycles(edges, nodes).for_each([&](const std::vector<std::uint32_t>& cycle) {
            for (const std::uint32_t edge : cycle) together.join(cycle.front(), edge), on_cycle[edge] = true;
        });
        const LargeArray<std::uint32_t> found = biconnected_components(edges, nodes);
        REQUIRE(found.size() == edges.size());
        for (std::uint32_t a = 0; a < edges.size(); ++a) {
            CHECK((found[a] != kOnNoCycle) == on_cycle[a]);
            ++(on_cycle[a] ? on_cycles : on_none);
            for (std::uint32_t b = 0; b < a; ++b)
                if (on_cycle[a] && on_cycle[b]) CHECK((found[a] == found[b]) == (together.find(a) == together.find(b)));
        }
    }
    CHECK(on_cycles > 500);
    CHECK(on_none > 200);
}
