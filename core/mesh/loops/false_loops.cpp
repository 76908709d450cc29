#include "core/mesh/loops/false_loops.h"

#include "core/mesh/loops/cut_loop.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <unordered_set>
#include <utility>

namespace ramus::mesh {

namespace {

constexpr double kLongest = 16.0;         // radii of the vessel there, that a line is
constexpr std::size_t kMostCorners = 512; // of a line: caps take time as the cube of them
// The surface is looked at as a whole for each loop that is cut, or for several that lie apart: the triangles of all
// these looks, at most. They take 1.2 us each; where they are more, cells are larger than the gaps between vessels.
constexpr double kMostInAll = 20e6;
// Vertices that searches come to, in all, which take 0.2 us each; and as how many choices of a cap's triangle one
// counts.
constexpr std::size_t kMostSteps = 20'000'000, kCapSteps = 300;

// Whether what a line goes around is inside, and no hole: the surface faces away from its middle.
bool goes_around_inside(const TriangleMesh& mesh, const SurfaceLoop& loop) {
    const std::vector<glm::dvec3> line = positions_of(mesh, loop);
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& p : line) middle += p / static_cast<double>(line.size());
    double facing = 0.0;
    for (std::size_t n = 0; n < line.size(); ++n)
        facing += glm::dot(glm::dvec3(mesh.normals[loop.vertices[n]]), line[n] - middle);
    return facing > 0.0;
}

} // namespace

std::size_t FalseLoops::cut(std::size_t most, Job& job) {
    if (static_cast<double>(most) * static_cast<double>(mesh_.triangles.size()) > kMostInAll) return 0;
    std::size_t cut = 0;
    for (std::size_t before = most; cut < most && cut != before;) {
        before = cut;
        const auto share = [&](std::size_t n) { return static_cast<float>(n) / static_cast<float>(most); };
        Job step(job, share(cut), share(cut + 1));
        for (const SurfaceLoop& loop : best_apart(most - cut, step)) {
            if (!cut_along(mesh_, loop)) return cut;
            forget(loop);
            ++cut;
        }
    }
    return cut;
}

// The best line, and those of the next best ones that have no triangle in common with it or each other. They do not
// part the surface together.
std::vector<SurfaceLoop> FalseLoops::best_apart(std::size_t most, Job& job) {
    const SurfaceGraph graph(mesh_);
    if (!graph.is_closed()) return {};
    const SurfaceLoops loops(graph, barred_, job);
    found_ = {};
    std::vector<SurfaceLoop> lines;
    std::vector<std::uint8_t> taken(mesh_.positions.size(), 0); // by vertex: it is of a line, or next to one
    for (std::size_t n = 0; n < most; ++n) {
        SurfaceLoop line = best(graph, loops, job);
        if (line.vertices.empty()) break;
        found_.add(line.kind);
        if (std::ranges::any_of(line.vertices, [&](std::uint32_t v) { return taken[v] != 0; })) continue;
        for (const std::uint32_t v : line.vertices)
            for (const std::uint32_t edge : graph.edges_at(v)) taken[graph.other_end(edge, v)] = 1;
        lines.push_back(std::move(line));
    }
    return lines;
}

// Of the kinds that are no sums of those found. Without vertices if there is none, it takes too long to find, or the
// job is cancelled.
SurfaceLoop FalseLoops::best(const SurfaceGraph& graph, const SurfaceLoops& loops, Job& job) {
    best_ = {}, cost_ = std::numeric_limits<double>::max();
    const auto edges = loops.edges();
    for (std::size_t n = 0; n < edges.size(); ++n) {
        for (const std::uint32_t vertex : graph.edges()[edges[n]].ends) {
            if (job.cancelled() || steps_ > kMostSteps) return {};
            look(loops, vertex);
        }
        job.report(static_cast<float>(n + 1) / static_cast<float>(edges.size()));
    }
    for (double before = 2.0 * cost_; cost_ < before;) {
        before = cost_;
        for (const std::uint32_t vertex : std::vector(best_.vertices)) {
            if (job.cancelled() || steps_ > kMostSteps) return {};
            look(loops, vertex);
        }
    }
    return best_;
}

// A connection is cut rather than the hole beside it filled, unless that is far smaller.
void FalseLoops::look(const SurfaceLoops& loops, std::uint32_t vertex) {
    constexpr double kFilled = 2.0;
    const double longest = std::min(cost_, kLongest * double{mesh_.radii[vertex]});
    for (SurfaceLoop& loop : loops.shortest(vertex, longest, steps_)) {
        const bool connects = goes_around_inside(mesh_, loop);
        const double cost = connects ? loop.length : kFilled * loop.length;
        if (loop.vertices.size() > kMostCorners || (!connects && !fill_holes_) || !found_.allow(loop.kind)) continue;
        if (!(cost < cost_) || goes_around_vessel(loop)) continue;
        cost_ = cost;
        best_ = std::move(loop);
    }
}

// Asked once for each line, as long as the surface is the same there.
bool FalseLoops::goes_around_vessel(const SurfaceLoop& loop) {
    // Each line from its lowest vertex, to the lower one of those beside that.
    std::vector<std::uint32_t> vertices = loop.vertices;
    std::rotate(vertices.begin(), std::ranges::min_element(vertices), vertices.end());
    if (vertices.back() < vertices[1]) std::reverse(vertices.begin() + 1, vertices.end());
    const auto [known, fresh] = around_vessel_.try_emplace(std::move(vertices), false);
    if (fresh) {
        known->second = axes_.go_through(positions_of(mesh_, loop));
        steps_ += loop.vertices.size() * loop.vertices.size() * loop.vertices.size() / kCapSteps;
    }
    return known->second;
}

// Along which it was cut: its vertices have moved.
void FalseLoops::forget(const SurfaceLoop& loop) {
    const std::unordered_set<std::uint32_t> moved(loop.vertices.begin(), loop.vertices.end());
    std::erase_if(around_vessel_, [&](const auto& known) {
        return std::ranges::any_of(known.first, [&](std::uint32_t v) { return moved.contains(v); });
    });
}

} // namespace ramus::mesh
