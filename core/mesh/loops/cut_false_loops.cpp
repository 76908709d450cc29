#include "core/mesh/loops/cut_false_loops.h"

#include "core/mesh/connectivity.h"
#include "core/mesh/loops/axes.h"
#include "core/mesh/loops/cut_loop.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <unordered_set>
#include <utility>
#include <vector>

namespace ramus::mesh {

namespace {

constexpr double kLongest = 16.0;           // radii of the vessel there, that a line is
constexpr std::size_t kMostCorners = 512;   // of a line: caps take time as the cube of them
constexpr double kBytesPerTriangle = 140.0; // that looking for loops takes (measured: 127), however many there are
// The surface is looked at as a whole for each loop that is cut: the triangles of all these looks. They take 1.2 us
// each; where they are more, cells are larger than the gaps between vessels.
constexpr double kMostInAll = 200e6;
// Vertices that searches come to, in all, which take 0.2 us each; and as how many choices of a cap's triangle one
// counts.
constexpr std::size_t kMostSteps = 200'000'000, kCapSteps = 300;

// Pieces less loops: half of the Euler characteristic.
std::int64_t half_characteristic(const TriangleMesh& mesh) {
    std::vector<std::uint8_t> used(mesh.positions.size(), 0);
    const auto mark = [&](const tbb::blocked_range<std::size_t>& range, std::int64_t triangles) {
        for (std::size_t n = range.begin(); n < range.end(); ++n) {
            const glm::uvec3& triangle = mesh.triangles[n];
            if (triangle.x == triangle.y) continue;
            for (int corner = 0; corner < 3; ++corner)
                std::atomic_ref(used[triangle[corner]]).store(1, std::memory_order_relaxed); // threads share vertices
            ++triangles;
        }
        return triangles;
    };
    const auto triangles = tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, mesh.triangles.size()),
                                                std::int64_t{0}, mark, std::plus<>());
    return (static_cast<std::int64_t>(std::ranges::count(used, 1)) - triangles / 2) / 2;
}

// The same where all vertices have triangles, and all triangles three vertices.
std::int64_t half_characteristic_by_numbers(const TriangleMesh& mesh) {
    const auto vertices = static_cast<std::int64_t>(mesh.positions.size());
    return (vertices - static_cast<std::int64_t>(mesh.triangles.size() / 2)) / 2;
}

bool differs(std::int64_t half_characteristic, const Connectivity& asked) {
    return half_characteristic != asked.pieces - asked.loops;
}

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

// The lines to cut along, the best one each time. Whether an axis goes through a line's cap is asked once, as long as
// the surface is the same there.
class FalseLoops {
public:
    FalseLoops(const TriangleMesh& mesh, const tree::VesselTree& tree, bool fill_holes)
        : mesh_(mesh), axes_(tree), fill_holes_(fill_holes) {}

    // Without vertices if there is none, it takes too long to find, or the job is cancelled.
    [[nodiscard]] SurfaceLoop best(Job& job) {
        best_ = {}, cost_ = std::numeric_limits<double>::max();
        const SurfaceGraph graph(mesh_);
        if (!graph.is_closed()) return {};
        const SurfaceLoops loops(graph, job);
        const auto edges = loops.edges();
        for (std::size_t n = 0; n < edges.size(); ++n) {
            for (const std::uint32_t vertex : graph.edges()[edges[n]].ends) {
                if (job.cancelled() || steps_ > kMostSteps) return {};
                look(graph, loops, vertex);
            }
            job.report(static_cast<float>(n + 1) / static_cast<float>(edges.size()));
        }
        for (double before = 2.0 * cost_; cost_ < before;) {
            before = cost_;
            for (const std::uint32_t vertex : std::vector(best_.vertices)) {
                if (job.cancelled() || steps_ > kMostSteps) return {};
                look(graph, loops, vertex);
            }
        }
        return best_;
    }
    // Along which it was cut: its vertices have moved.
    void forget(const SurfaceLoop& loop) {
        const std::unordered_set<std::uint32_t> moved(loop.vertices.begin(), loop.vertices.end());
        std::erase_if(around_vessel_, [&](const auto& known) {
            return std::ranges::any_of(known.first, [&](std::uint32_t v) { return moved.contains(v); });
        });
    }

private:
    // A connection is cut rather than the hole beside it filled, unless that is far smaller.
    void look(const SurfaceGraph& graph, const SurfaceLoops& loops, std::uint32_t vertex) {
        constexpr double kFilled = 2.0;
        const double longest = std::min(cost_, kLongest * double{mesh_.radii[vertex]});
        for (SurfaceLoop& loop : loops.shortest(vertex, longest, steps_)) {
            const bool connects = goes_around_inside(mesh_, loop);
            const double cost = connects ? loop.length : kFilled * loop.length;
            if (loop.vertices.size() > kMostCorners || (!connects && !fill_holes_)) continue;
            if (!(cost < cost_) || !has_free_cap(graph, loop) || goes_around_vessel(loop)) continue;
            cost_ = cost;
            best_ = std::move(loop);
        }
    }
    [[nodiscard]] bool goes_around_vessel(const SurfaceLoop& loop) {
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

    const TriangleMesh& mesh_;
    Axes axes_;
    bool fill_holes_;
    SurfaceLoop best_;
    double cost_ = std::numeric_limits<double>::max();
    std::map<std::vector<std::uint32_t>, bool> around_vessel_; // by a line's vertices
    std::size_t steps_ = 0;                                    // of all searches
};

} // namespace

bool has_other_loops(const TriangleMesh& mesh, const tree::VesselTree& tree) {
    return differs(half_characteristic(mesh), connectivity_of(tree));
}

std::size_t cut_false_loops(TriangleMesh& mesh, const tree::VesselTree& tree, double memory_bytes, Job& job) {
    const Connectivity asked = connectivity_of(tree);
    if (!differs(half_characteristic_by_numbers(mesh), asked)) return 0;
    const auto triangles = static_cast<double>(mesh.triangles.size());
    const std::int64_t others = connectivity_of(mesh).loops - asked.loops;
    if (kBytesPerTriangle * triangles > memory_bytes || static_cast<double>(others) * triangles > kMostInAll) return 0;
    FalseLoops loops(mesh, tree, asked.loops == 0);
    std::size_t cut = 0;
    for (std::int64_t more = others; more > 0; --more, ++cut) {
        const auto share = [&](std::size_t n) { return static_cast<float>(n) / static_cast<float>(others); };
        Job step(job, share(cut), share(cut + 1));
        const SurfaceLoop loop = loops.best(step);
        if (loop.vertices.empty() || !cut_along(mesh, loop)) break;
        loops.forget(loop);
    }
    return cut;
}

} // namespace ramus::mesh
