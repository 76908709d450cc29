#include "core/mesh/loops/false_loops.h"

#include "core/mesh/loops/cut_along.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <unordered_set>
#include <utility>

namespace ramus::mesh {

namespace {

constexpr double kLongest = 16.0;         // the longest line, in local radii
constexpr std::size_t kMostCorners = 512; // of a line: caps take time proportional to the cube
// A limit on loops times triangles: each cut, or group of separate cuts, searches the whole surface, at 1.2 us for each
// triangle. The limit is exceeded if the cells are larger than the gaps between vessels.
constexpr double kMostInAll = 20e6;
// kMostSteps: a limit on the vertices visited by all searches, 0.2 us each. kCapSteps: so many choices of a triangle of
// a cap take as long as one vertex.
constexpr std::size_t kMostSteps = 20'000'000, kCapSteps = 300;

// Whether a line goes around inside, not around a hole: the surface faces away from the line's middle.
bool goes_around_inside(const TriangleMesh& mesh, const ClosedLine& line) {
    const std::vector<glm::dvec3> positions = positions_of(mesh, line);
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& p : positions) middle += p / static_cast<double>(positions.size());
    double facing = 0.0;
    for (std::size_t n = 0; n < positions.size(); ++n)
        facing += glm::dot(glm::dvec3(mesh.normals[line.vertices[n]]), positions[n] - middle);
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
        for (const ClosedLine& line : best_apart(most - cut, step)) {
            if (!cut_along(mesh_, line)) return cut;
            forget(line);
            ++cut;
        }
    }
    return cut;
}

// The best line, and the next best lines that share no triangle with it or each other. Cutting along all of them does
// not divide the surface.
std::vector<ClosedLine> FalseLoops::best_apart(std::size_t most, Job& job) {
    const SurfaceGraph graph(mesh_);
    if (!graph.is_closed()) return {};
    const ClosedLines closed_lines(graph, barred_, job);
    found_ = {};
    std::vector<ClosedLine> lines;
    std::vector<std::uint8_t> taken(mesh_.positions.size(), 0); // by vertex: it is of a line, or next to one
    for (std::size_t n = 0; n < most; ++n) {
        ClosedLine line = best(graph, closed_lines, job);
        if (line.vertices.empty()) break;
        found_.add(line.homology);
        if (std::ranges::any_of(line.vertices, [&](std::uint32_t v) { return taken[v] != 0; })) continue;
        for (const std::uint32_t v : line.vertices)
            for (const std::uint32_t edge : graph.edges_at(v)) taken[graph.other_end(edge, v)] = 1;
        lines.push_back(std::move(line));
    }
    return lines;
}

// The best line whose class is independent of the classes found before. Without vertices if there is none, if the
// search exceeds kMostSteps, or if the job is cancelled.
ClosedLine FalseLoops::best(const SurfaceGraph& graph, const ClosedLines& closed_lines, Job& job) {
    best_ = {}, cost_ = std::numeric_limits<double>::max();
    const auto edges = closed_lines.edges();
    for (std::size_t n = 0; n < edges.size(); ++n) {
        for (const std::uint32_t vertex : graph.edges()[edges[n]].ends) {
            if (job.cancelled() || steps_ > kMostSteps) return {};
            look(closed_lines, vertex);
        }
        job.report(static_cast<float>(n + 1) / static_cast<float>(edges.size()));
    }
    for (double before = 2.0 * cost_; cost_ < before;) {
        before = cost_;
        for (const std::uint32_t vertex : std::vector(best_.vertices)) {
            if (job.cancelled() || steps_ > kMostSteps) return {};
            look(closed_lines, vertex);
        }
    }
    return best_;
}

// Prefers cutting a connection to filling the hole next to it, unless the hole is less than half as long around.
void FalseLoops::look(const ClosedLines& closed_lines, std::uint32_t vertex) {
    constexpr double kFilled = 2.0;
    const double longest = std::min(cost_, kLongest * double{mesh_.radii[vertex]});
    for (ClosedLine& line : closed_lines.shortest(vertex, longest, steps_)) {
        const bool connects = goes_around_inside(mesh_, line);
        const double cost = connects ? line.length : kFilled * line.length;
        if (line.vertices.size() > kMostCorners || (!connects && !fill_holes_) || !found_.allow(line.homology))
            continue;
        if (!(cost < cost_) || goes_around_vessel(line)) continue;
        cost_ = cost;
        best_ = std::move(line);
    }
}

// Cached, since the same line is found from several vertices.
bool FalseLoops::goes_around_vessel(const ClosedLine& line) {
    // The key of a line begins at its lowest vertex, and continues with the lower one of its neighbours.
    std::vector<std::uint32_t> vertices = line.vertices;
    std::rotate(vertices.begin(), std::ranges::min_element(vertices), vertices.end());
    if (vertices.back() < vertices[1]) std::reverse(vertices.begin() + 1, vertices.end());
    const auto [known, fresh] = around_vessel_.try_emplace(std::move(vertices), false);
    if (fresh) {
        known->second = axes_.go_through(positions_of(mesh_, line));
        steps_ += line.vertices.size() * line.vertices.size() * line.vertices.size() / kCapSteps;
    }
    return known->second;
}

// Removes lines that share a vertex with a cut, whose vertices have moved, from the cache.
void FalseLoops::forget(const ClosedLine& line) {
    const std::unordered_set<std::uint32_t> moved(line.vertices.begin(), line.vertices.end());
    std::erase_if(around_vessel_, [&](const auto& known) {
        return std::ranges::any_of(known.first, [&](std::uint32_t v) { return moved.contains(v); });
    });
}

} // namespace ramus::mesh
