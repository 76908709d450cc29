#include "core/base/infinity.h"
#include "core/validate/questions.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <queue>
#include <unordered_map>
#include <utility>

namespace ramus::validate {

namespace {

constexpr std::uint32_t kNowhere = 0xFFFFFFFFU;

std::vector<std::uint8_t> far_from_vessels(const Reference& reference, const mesh::TriangleMesh& surface) {
    std::vector<std::uint8_t> far(surface.positions.size(), 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, far.size(), 1024), [&](const auto& range) {
        for (std::size_t v = range.begin(); v < range.end(); ++v) {
            const tree::Point place{glm::dvec3(surface.positions[v]), 0.0};
            far[v] = reference.vessels().nearest(place, kOwn, {}, kOwn).branch == tree::kNoBranch ? 1 : 0;
        }
    });
    return far;
}

// The graph of the vertices that are far from all vessels, and of their edges. A part is a connected component.
class FarGraph {
public:
    FarGraph(const mesh::TriangleMesh& surface, const std::vector<std::uint8_t>& far) : surface_(surface) {
        std::vector<std::uint32_t> number(far.size(), kNowhere);
        for (std::uint32_t v = 0; v < far.size(); ++v)
            if (far[v] != 0) number[v] = static_cast<std::uint32_t>(vertices_.size()), vertices_.push_back(v);
        next_.resize(vertices_.size());
        rim_.resize(vertices_.size(), 0);
        for (const glm::uvec3& t : surface.triangles)
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t a = number[t[k]], b = number[t[(k + 1) % 3]];
                if (a != kNowhere && b != kNowhere) next_[a].push_back(b), next_[b].push_back(a);
                if (a != kNowhere && b == kNowhere) rim_[a] = 1;
                if (b != kNowhere && a == kNowhere) rim_[b] = 1;
            }
    }
    [[nodiscard]] std::size_t size() const { return vertices_.size(); }
    [[nodiscard]] glm::dvec3 place(std::uint32_t n) const { return glm::dvec3(surface_.positions[vertices_[n]]); }
    [[nodiscard]] bool on_rim(std::uint32_t n) const { return rim_[n] != 0; }
    [[nodiscard]] const std::vector<std::uint32_t>& next(std::uint32_t n) const { return next_[n]; }

    // Dijkstra's algorithm: distances (mm) along edges from the nearest of `sources`; `from`: the previous vertex.
    void spread(const std::vector<std::uint32_t>& sources, std::vector<double>& distance,
                std::vector<std::uint32_t>& from) const {
        using Item = std::pair<double, std::uint32_t>;
        std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
        for (const std::uint32_t n : sources) distance[n] = 0.0, from[n] = kNowhere, open.emplace(0.0, n);
        while (!open.empty()) {
            const auto [at, n] = open.top();
            open.pop();
            if (at > distance[n]) continue;
            for (const std::uint32_t other : next_[n]) {
                const double there = at + glm::distance(place(n), place(other));
                if (there < distance[other]) distance[other] = there, from[other] = n, open.emplace(there, other);
            }
        }
    }

private:
    const mesh::TriangleMesh& surface_;
    std::vector<std::uint32_t> vertices_;
    std::vector<std::vector<std::uint32_t>> next_;
    std::vector<std::uint8_t> rim_; // whether a neighbour on the surface is near a vessel
};

// The connected vertices with about the same distance from the part's beginning as `n`, as a circle.
struct Ring {
    glm::dvec3 middle{0.0};
    double radius = 0.0;
};

Ring ring_of(const FarGraph& graph, std::uint32_t n, const std::vector<double>& distance, double width) {
    std::unordered_map<std::uint32_t, bool> seen{{n, true}};
    std::vector<std::uint32_t> ring{n};
    glm::dvec3 least = graph.place(n), most = least;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        least = glm::min(least, graph.place(ring[i]));
        most = glm::max(most, graph.place(ring[i]));
        for (const std::uint32_t other : graph.next(ring[i]))
            if (std::abs(distance[other] - distance[n]) <= width && seen.emplace(other, true).second)
                ring.push_back(other);
    }
    Ring found{0.5 * (least + most), 0.0};
    for (const std::uint32_t other : ring)
        found.radius += glm::distance(graph.place(other), found.middle) / static_cast<double>(ring.size());
    return found;
}

// The shortest paths along the surface in all parts, computed part by part.
struct Ways {
    std::vector<double> distance;
    std::vector<std::uint32_t> from;
    explicit Ways(std::size_t size) : distance(size, kInfinity), from(size, kNowhere) {}
    [[nodiscard]] std::uint32_t farthest(const std::vector<std::uint32_t>& part) const {
        return *std::ranges::max_element(part, {}, [&](std::uint32_t n) { return distance[n]; });
    }
};

// The largest connected group of the part's vertices on its rim, where the part leaves a vessel. A part that connects
// two vessels has two such groups.
std::vector<std::uint32_t> widest_rim(const FarGraph& graph, const std::vector<std::uint32_t>& part) {
    std::unordered_map<std::uint32_t, bool> taken;
    std::vector<std::uint32_t> widest;
    for (const std::uint32_t seed : part) {
        if (!graph.on_rim(seed) || !taken.emplace(seed, true).second) continue;
        std::vector<std::uint32_t> group{seed};
        const auto take = [&](std::uint32_t n) {
            if (graph.on_rim(n) && taken.emplace(n, true).second) group.push_back(n);
        };
        for (std::size_t i = 0; i < group.size(); ++i)
            for (const std::uint32_t other : graph.next(group[i])) {
                take(other);
                for (const std::uint32_t third : graph.next(other)) take(third); // a rim is no perfect ring of edges
            }
        if (group.size() > widest.size()) widest = std::move(group);
    }
    return widest;
}

// The distance from the axis of the adjacent vessel to vertex `n` on the rim of a part, mm.
double from_axis(const Reference& reference, const FarGraph& graph, std::uint32_t n) {
    double edge = 0.0;
    for (const std::uint32_t other : graph.next(n))
        edge = std::max(edge, glm::distance(graph.place(n), graph.place(other)));
    return kOwn * reference.vessels().nearest({graph.place(n), 2.0 * edge}, kOwn, {}, 0.0).radius;
}

struct Described {
    FalsePart part;
    double outside_mm = 0.0; // the part of its length that is far from all vessels
    double radius = 0.0;     // at its middle
};

// Describes one part as a branch: its length from the axis of the vessel from which it leaves, and its middle.
Described describe(const Reference& reference, const FarGraph& graph, const std::vector<std::uint32_t>& part,
                   Ways& ways) {
    std::vector<std::uint32_t> sources = widest_rim(graph, part);
    const bool stands_on = !sources.empty();
    if (!stands_on) { // a separate piece: begins at the vertex farthest from an arbitrary vertex
        graph.spread({part.front()}, ways.distance, ways.from);
        sources = {ways.farthest(part)};
        for (const std::uint32_t n : part) ways.distance[n] = kInfinity;
    }
    graph.spread(sources, ways.distance, ways.from);
    const std::uint32_t tip = ways.farthest(part);
    const double outside = ways.distance[tip];
    const double before = stands_on ? from_axis(reference, graph, sources.front()) : 0.0;
    const double after = graph.on_rim(tip) ? from_axis(reference, graph, tip) : 0.0;
    const auto middle = [&](double length) {
        std::uint32_t half = tip;
        double edge = 0.0;
        while (ways.from[half] != kNowhere && ways.distance[half] > 0.5 * length - before) {
            edge = std::max(edge, ways.distance[half] - ways.distance[ways.from[half]]);
            half = ways.from[half];
        }
        return ring_of(graph, half, ways.distance, 2.0 * edge);
    };
    const double whole = before + outside + after;
    const double radius = middle(whole).radius;
    // Free ends are round, so the centerline ends about a radius before the surface.
    const int free_ends = (stands_on ? 0 : 1) + (graph.on_rim(tip) ? 0 : 1);
    const double length = std::max(whole - free_ends * radius, 0.5 * whole);
    glm::dvec3 at = middle(length).middle;
    if (before > 0.5 * length) { // the middle is inside the vessel from which the part leaves
        const glm::dvec3 outward = middle(whole + outside).middle - at;
        if (glm::length(outward) > 0.0) at -= (before - 0.5 * length) * glm::normalize(outward);
    }
    return {{at, length}, outside, radius};
}

// Whether a part is a branch. A part around a centerline is a vessel that is too wide; a part that sticks out of a
// vessel by less than the vessel's radius is a bulge of the wall.
bool is_a_branch(const Reference& reference, const Described& found) {
    const glm::dvec3& at = found.part.at;
    const NearbyVessels& vessels = reference.vessels();
    if (vessels.nearest({at, 0.0}, 1.0, {}, 1.0).branch != tree::kNoBranch) return false;
    const auto through = vessels.nearest({at, found.radius}, 1.0, {}, 0.0);
    if (through.branch != tree::kNoBranch && through.closeness * (found.radius + through.radius) < found.radius)
        return false;
    const auto beside = reference.vessels().nearest({at, found.outside_mm}, kOwn, {}, 0.0);
    return found.outside_mm > 0.0 && found.outside_mm >= beside.radius;
}

// Whether a part is the wall of a moved vessel: around the vessel itself, or a short part near its expected place, as
// at bends.
bool is_of_moved(const Reference& reference, std::span<const Section> sections, std::span<const MovedStretch> moved,
                 const FalsePart& part) {
    constexpr double kShort = 3.0; // radii
    for (const MovedStretch& stretch : moved) {
        const auto branch = static_cast<std::size_t>(stretch.offset.branch);
        const std::size_t first = reference.first_of(branch);
        for (std::size_t i = first; i < first + reference.places_of(branch).size(); ++i) {
            const Place& place = reference.places()[i];
            if (!is_moved(moved, place)) continue;
            const CrossSection& vessel = sections[i].vessel;
            if (sections[i].found && glm::distance(part.at, vessel.middle) < kOwn * vessel.radius) return true;
            if (part.length_mm < kShort * place.scale &&
                glm::distance(part.at, place.at) < kOwn * place.scale + stretch.offset.offset_mm)
                return true;
        }
    }
    return false;
}

} // namespace

std::vector<FalsePart> false_parts(const Reference& reference, const mesh::TriangleMesh& surface,
                                   std::span<const Section> sections, std::span<const MovedStretch> moved,
                                   std::span<const LostStretch> lost) {
    const std::vector<MovedJoint> joints = moved_joints(reference, lost);
    const FarGraph graph(surface, far_from_vessels(reference, surface));
    std::vector<std::uint8_t> taken(graph.size(), 0);
    std::vector<FalsePart> found;
    std::vector<std::uint32_t> part;
    Ways ways(graph.size());
    for (std::uint32_t seed = 0; seed < graph.size(); ++seed) {
        if (taken[seed] != 0) continue;
        part.assign(1, seed);
        taken[seed] = 1;
        for (std::size_t i = 0; i < part.size(); ++i)
            for (const std::uint32_t other : graph.next(part[i]))
                if (taken[other] == 0) taken[other] = 1, part.push_back(other);
        const Described whole = describe(reference, graph, part, ways);
        if (is_a_branch(reference, whole) && !is_of_moved(reference, sections, moved, whole.part) &&
            !is_moved(joints, whole.part.at, whole.outside_mm))
            found.push_back(whole.part);
    }
    std::ranges::stable_sort(found, std::greater<>(), &FalsePart::length_mm);
    return found;
}

} // namespace ramus::validate
