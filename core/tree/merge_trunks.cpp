#include "core/tree/merge_trunks.h"

#include "core/base/bounds.h"
#include "core/base/grouped.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

namespace ramus::tree {

namespace {

// Ends of chains nearer than this coincide: a millionth of the longest side of the bounding box, which is the
// resolution of single precision. At most a hundredth of the usual length of an edge, so that a stray point does not
// matter.
double same_place(const Graph& graph) {
    Bounds<glm::dvec3> box;
    for (const Point& point : graph.points) box.hold(point.position);
    std::vector<double> lengths;
    for (const auto& [a, b] : graph.edges)
        lengths.push_back(glm::distance(graph.points[a].position, graph.points[b].position));
    if (lengths.empty()) return 0.0;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::ranges::nth_element(lengths, middle);
    const glm::dvec3 side = box.size();
    const double near = std::min(1e-6 * std::max({side.x, side.y, side.z}), 0.01 * *middle);
    // A tolerance finer than the resolution of the coordinates has no effect.
    const glm::dvec3 far = glm::max(glm::abs(box.least), glm::abs(box.most));
    return std::isfinite(near) && near > 1e-14 * std::max({far.x, far.y, far.z}) ? near : 0.0;
}

// Finds for each position the first representative within a distance, in constant time: representatives are farther
// from each other than that distance, so that a cell of the grid contains few.
class PlaceGrid {
public:
    PlaceGrid(const std::vector<Point>& points, double near) : points_(points), near_(near), cell_(4.0 * near) {}

    std::uint32_t first_at(std::uint32_t p) {
        const glm::dvec3& at = points_[p].position;
        const glm::dvec3 low = glm::floor((at - near_) / cell_), high = glm::floor((at + near_) / cell_);
        for (double x = low.x; x <= high.x; ++x)
            for (double y = low.y; y <= high.y; ++y)
                for (double z = low.z; z <= high.z; ++z)
                    if (const auto cell = cells_.find({x, y, z}); cell != cells_.end())
                        for (const std::uint32_t q : cell->second)
                            if (glm::distance(points_[q].position, at) <= near_) return q;
        const glm::dvec3 own = glm::floor(at / cell_);
        cells_[{own.x, own.y, own.z}].push_back(p);
        return p;
    }

private:
    const std::vector<Point>& points_;
    double near_, cell_;
    std::map<std::array<double, 3>, std::vector<std::uint32_t>> cells_;
};

int system_of(const Graph& graph, std::uint32_t p) {
    return p < graph.point_systems.size() ? graph.point_systems[p] : 0;
}

using Groups = std::vector<std::vector<std::uint32_t>>; // of points, each in ascending order

// Groups points of one system with identical coordinates, in the order of the file. Skips points beyond any plausible
// coordinate, so that indices of grid cells do not overflow.
Groups exact_groups(const Graph& graph) {
    const std::vector<Point>& points = graph.points;
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    std::erase_if(order, [&](std::uint32_t p) {
        const glm::dvec3& at = points[p].position;
        return !std::isfinite(at.x + at.y + at.z) || std::abs(at.x) + std::abs(at.y) + std::abs(at.z) > 1e15;
    });
    const auto key = [&](std::uint32_t p) {
        const glm::dvec3& at = points[p].position;
        return std::tuple(at.x, at.y, at.z, system_of(graph, p), p);
    };
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    Groups groups;
    const auto together = [&](std::uint32_t a, std::uint32_t b) {
        return points[a].position == points[b].position && system_of(graph, a) == system_of(graph, b);
    };
    for (const std::uint32_t p : order) {
        if (groups.empty() || !together(groups.back().front(), p)) groups.emplace_back();
        groups.back().push_back(p);
    }
    std::ranges::sort(groups);
    return groups;
}

// Merges groups that contain an end of a chain and coincide within the resolution of single precision. Does not merge
// groups that an edge connects, since a short segment is intended. `neighbour`: for a point that is an end, the other
// point of its edge; otherwise the point itself.
void join_near_ends(const Graph& graph, const std::vector<std::uint32_t>& neighbour, Groups& groups) {
    const double near = same_place(graph);
    if (!(near > 0.0)) return;
    PlaceGrid grid(graph.points, near);
    std::vector<std::size_t> group_of(graph.points.size(), groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g)
        for (const std::uint32_t p : groups[g]) group_of[p] = g;
    const auto is_end = [&](std::uint32_t p) { return neighbour[p] != p; };
    const auto touch = [&](std::size_t a, std::size_t b) {
        return std::ranges::any_of(groups[a],
                                   [&](std::uint32_t p) { return is_end(p) && group_of[neighbour[p]] == b; });
    };
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (std::ranges::none_of(groups[g], is_end)) continue;
        const std::uint32_t place = grid.first_at(groups[g].front());
        const std::size_t first = group_of[place];
        if (first == g || touch(g, first) || touch(first, g)) continue;
        if (system_of(graph, place) != system_of(graph, groups[g].front())) continue;
        for (const std::uint32_t p : groups[g]) group_of[p] = first;
        groups[first].insert(groups[first].end(), groups[g].begin(), groups[g].end());
        groups[g].clear();
    }
    for (auto& group : groups) std::ranges::sort(group);
}

// The new index of every point. The points of a group share the index of the first one.
std::vector<std::uint32_t> representatives(const Graph& graph, bool ends_only) {
    std::vector<std::uint32_t> degree(graph.points.size(), 0), stands(graph.points.size());
    for (const auto& [a, b] : graph.edges) ++degree[a], ++degree[b];
    std::iota(stands.begin(), stands.end(), 0U);
    std::vector<std::uint32_t> neighbour = stands;
    for (const auto& [a, b] : graph.edges) {
        if (degree[a] == 1) neighbour[a] = b;
        if (degree[b] == 1) neighbour[b] = a;
    }
    Groups groups = exact_groups(graph);
    join_near_ends(graph, neighbour, groups);
    const auto is_end = [&](std::uint32_t p) { return degree[p] < 2; };
    for (const std::vector<std::uint32_t>& group : groups) {
        if (group.size() < 2 || (ends_only && std::ranges::none_of(group, is_end))) continue;
        // If several chains run through the place, ends join the first one.
        const auto inner = std::ranges::find_if_not(group, is_end);
        const std::uint32_t first = ends_only && inner != group.end() ? *inner : group.front();
        for (const std::uint32_t p : group)
            if (!ends_only || is_end(p)) stands[p] = first;
    }
    return stands;
}

// Keeps the first of several equal pairs of points.
std::vector<Edge> drop_repeated(Graph& graph) {
    std::vector<Edge>& edges = graph.edges;
    std::vector<std::uint32_t> order(edges.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t e) {
        return std::tuple(std::min(edges[e].first, edges[e].second), std::max(edges[e].first, edges[e].second));
    };
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    std::vector<bool> goes(edges.size(), false);
    for (std::size_t n = 1; n < order.size(); ++n) goes[order[n]] = key(order[n]) == key(order[n - 1]);
    std::vector<Edge> kept, gone;
    std::vector<std::size_t> stays;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        (goes[e] ? gone : kept).push_back(edges[e]);
        if (!goes[e]) stays.push_back(e);
    }
    edges = std::move(kept);
    graph.edge_data = picked(graph.edge_data, stays);
    return gone;
}

// A position on the vessels kept so far: on the way from `at` to one of the points that follow it.
struct Foot {
    std::uint32_t at = 0, next = 0; // equal at an end
    double distance = 0.0, radius = 0.0;
};

class TrunkMerger {
public:
    explicit TrunkMerger(Graph& graph) : graph_(graph), follows_(graph.points.size()), stands_(graph.points.size()) {
        std::iota(stands_.begin(), stands_.end(), 0U);
    }

    std::vector<RepeatedTrunk> merge() {
        std::vector<std::vector<std::uint32_t>> chains = chains_of();
        if (chains.size() > kMostChains) return {};
        std::vector<Edge> kept;
        std::map<Edge, std::uint32_t> index_of; // for data only
        for (std::uint32_t e = 0; !graph_.edge_data.empty() && e < graph_.edges.size(); ++e)
            index_of.emplace(graph_.edges[e], e);
        std::vector<std::uint32_t> from;
        for (std::vector<std::uint32_t>& chain : chains) {
            const std::vector<std::uint32_t> traced = index_of.empty() ? std::vector<std::uint32_t>() : chain;
            if (std::ranges::find(starts_, chain.front()) == starts_.end() && !arrived_at(chain.front()))
                adopt_start(chain.front());
            for (std::uint32_t& p : chain) p = stands_[p];
            const std::size_t shared = shared_points(chain);
            for (std::size_t i = shared; i + 1 < chain.size(); ++i) {
                kept.emplace_back(chain[i], chain[i + 1]);
                if (!index_of.empty()) from.push_back(index_of.at({traced[i], traced[i + 1]}));
                follows_[chain[i]].push_back(chain[i + 1]);
            }
        }
        graph_.edges = std::move(kept);
        graph_.edge_data = picked(graph_.edge_data, from);
        for (std::uint32_t& root : graph_.roots) root = stands_[root];
        return std::move(repeated_);
    }

private:
    // A limit on the work, since each chain is compared with all chains with the same beginning. No real set of
    // centerlines has more.
    static constexpr std::size_t kMostChains = 20'000;

    [[nodiscard]] const Point& point(std::uint32_t p) const { return graph_.points[p]; }

    [[nodiscard]] std::vector<std::vector<std::uint32_t>> chains_of() const {
        const std::size_t count = graph_.points.size();
        std::vector<std::uint32_t> in(count, 0), out(count, 0);
        for (const auto& [a, b] : graph_.edges) ++out[a], ++in[b];
        const Grouped<std::uint32_t> next(count, [&](const auto& put) {
            for (const auto& [a, b] : graph_.edges) put(a, b);
        });
        std::vector<std::vector<std::uint32_t>> chains;
        const auto passes = [&](std::uint32_t p) { return in[p] == 1 && out[p] == 1; };
        std::vector<bool> walked(count, false);
        const auto walk = [&](std::uint32_t from, std::uint32_t to) {
            std::vector<std::uint32_t> chain{from, to};
            while (passes(chain.back()) && !walked[chain.back()]) {
                walked[chain.back()] = true;
                chain.push_back(next.of(chain.back()).front());
            }
            chains.push_back(std::move(chain));
        };
        for (std::uint32_t p = 0; p < count; ++p)
            if (!passes(p))
                for (const std::uint32_t to : next.of(p)) walk(p, to);
        for (std::uint32_t p = 0; p < count; ++p) // rings
            if (passes(p) && !walked[p]) walked[p] = true, walk(p, next.of(p).front());
        order_from_roots(chains, in);
        return chains;
    }

    // Chains that begin at a root come first, the longest before the others; then chains that begin where these end,
    // and so on.
    void order_from_roots(std::vector<std::vector<std::uint32_t>>& chains, const std::vector<std::uint32_t>& in) const {
        std::ranges::stable_sort(chains, std::ranges::greater{}, [](const auto& chain) { return chain.size(); });
        const Grouped<std::uint32_t> from(graph_.points.size(), [&](const auto& put) {
            for (std::uint32_t c = 0; c < chains.size(); ++c) put(chains[c].front(), c);
        });
        std::vector<bool> taken(chains.size(), false);
        std::vector<std::vector<std::uint32_t>> ordered;
        const auto take = [&](std::uint32_t c) {
            if (taken[c]) return;
            taken[c] = true;
            ordered.push_back(std::move(chains[c]));
        };
        for (std::uint32_t c = 0; c < chains.size(); ++c)
            if (in[chains[c].front()] == 0) take(c);
        for (std::size_t n = 0; n < ordered.size(); ++n)
            for (const std::uint32_t c : from.of(ordered[n].back())) take(c);
        for (std::uint32_t c = 0; c < chains.size(); ++c)
            if (!taken[c]) take(c);
        chains = std::move(ordered);
    }

    [[nodiscard]] bool arrived_at(std::uint32_t p) const { return stands_[p] != p || !follows_[p].empty(); }

    // A free beginning near the beginning of another chain counts as the same place.
    void adopt_start(std::uint32_t start) {
        for (const std::uint32_t other : starts_) {
            if (glm::distance(point(start).position, point(other).position) > kSameTrunk * point(other).radius)
                continue;
            stands_[start] = other;
            return;
        }
        starts_.push_back(start);
    }

    [[nodiscard]] Foot foot_on(std::uint32_t from, std::uint32_t to, const glm::dvec3& at, double& fraction) const {
        const Point &a = point(from), &b = point(to);
        const glm::dvec3 along = b.position - a.position;
        const double squared = glm::dot(along, along);
        fraction = squared > 0.0 ? glm::dot(at - a.position, along) / squared : 1.0;
        const double t = glm::clamp(fraction, 0.0, 1.0);
        return {from, to, glm::distance(at, a.position + t * along), a.radius + t * (b.radius - a.radius)};
    }

    // The positions near `at` on the vessels that follow `foot`; several where these diverge.
    void advance(const Foot& foot, const glm::dvec3& at, std::vector<Foot>& found) const {
        double fraction = 0.0;
        std::vector<std::uint32_t> open{foot.at};
        const auto follow = [&](std::uint32_t from, std::uint32_t to) {
            const Foot next = foot_on(from, to, at, fraction);
            if (next.distance <= kSameTrunk * next.radius) found.push_back(next);
            if (fraction >= 1.0) open.push_back(to);
        };
        if (foot.next != foot.at) open.clear(), follow(foot.at, foot.next);
        for (std::size_t n = 0; n < open.size() && n < kMostAhead; ++n)
            for (const std::uint32_t to : follows_[open[n]]) follow(open[n], to);
    }
    static constexpr std::size_t kMostAhead = 64; // points of one chain between two of another

    // How many points at the beginning of `chain` repeat a kept chain. The last of them is where the chain leaves it.
    std::size_t shared_points(std::vector<std::uint32_t>& chain) {
        if (follows_[chain.front()].empty()) return 0;
        std::vector<Foot> feet{{chain.front(), chain.front(), 0.0, point(chain.front()).radius}}, ahead;
        std::optional<Foot> last;
        std::size_t shared = 0;
        double length = 0.0;
        for (std::size_t i = 1; i < chain.size() && !feet.empty(); ++i) {
            const glm::dvec3& at = point(chain[i]).position;
            ahead.clear();
            for (const Foot& foot : feet) advance(foot, at, ahead);
            std::ranges::sort(ahead, {}, &Foot::distance);
            if (ahead.size() > kMostAhead) ahead.resize(kMostAhead);
            feet = ahead;
            if (feet.empty()) break;
            last = feet.front(), shared = i;
            length += glm::distance(at, point(chain[i - 1]).position);
        }
        if (!last || length < 2.0 * last->radius) return 0;
        const glm::dvec3& left = point(chain[shared]).position;
        const bool to_next =
            glm::distance(left, point(last->next).position) < glm::distance(left, point(last->at).position);
        const std::uint32_t joint = to_next ? last->next : last->at;
        repeated_.push_back({point(chain.front()).position, left, shared});
        stands_[chain[shared]] = joint;
        chain[shared] = joint;
        return shared;
    }

    Graph& graph_;
    std::vector<std::vector<std::uint32_t>> follows_; // by point: where kept chains go on from it
    std::vector<std::uint32_t> stands_, starts_;
    std::vector<RepeatedTrunk> repeated_;
};

} // namespace

Joined join_coincident(Graph& graph, bool ends_only) {
    const std::vector<std::uint32_t> stands = representatives(graph, ends_only);
    Joined joined;
    std::vector<std::uint32_t> renumbered(stands.size(), 0);
    for (std::uint32_t p = 0; p < stands.size(); ++p)
        if (stands[p] == p) renumbered[p] = static_cast<std::uint32_t>(joined.first.size()), joined.first.push_back(p);
    joined.points = stands.size() - joined.first.size();
    if (joined.points == 0) return joined;
    for (std::uint32_t p = 0; p < stands.size(); ++p) {
        double& radius = graph.points[stands[p]].radius;
        radius = std::max(radius, graph.points[p].radius);
    }
    for (DataArray& array : graph.point_data)
        for (std::uint32_t p = 0; p < stands.size(); ++p)
            if (double& value = array.values[stands[p]]; !is_known(value)) value = array.values[p];
    graph.keep_points(joined.first);
    std::vector<Edge> edges;
    std::vector<std::size_t> left;
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
        const Edge edge(renumbered[stands[graph.edges[e].first]], renumbered[stands[graph.edges[e].second]]);
        if (edge.first != edge.second) edges.push_back(edge), left.push_back(e);
    }
    graph.edges = std::move(edges);
    graph.edge_data = picked(graph.edge_data, left);
    const std::vector<Edge> gone = drop_repeated(graph);
    joined.edges = gone.size();
    if (!gone.empty()) {
        const auto& [a, b] = gone[gone.size() / 2];
        joined.repeat = 0.5 * (graph.points[a].position + graph.points[b].position);
    }
    for (std::uint32_t& root : graph.roots) root = renumbered[stands[root]];
    return joined;
}

std::vector<RepeatedTrunk> merge_repeated_trunks(Graph& graph) { return TrunkMerger(graph).merge(); }

} // namespace ramus::tree
