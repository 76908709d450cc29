#include "core/mesh/loops/cut_false_loops.h"

#include "core/mesh/connectivity.h"
#include "core/mesh/line_triangle.h"
#include "core/mesh/loops/cut_loop.h"
#include "core/mesh/loops/spanning_triangles.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::mesh {

namespace {

constexpr double kLongest = 16.0;           // radii of the vessel there, that a line is
constexpr std::size_t kMostCorners = 512;   // of a line: caps take time as the cube of them
constexpr double kBytesPerTriangle = 120.0; // that looking for loops takes

// Pieces less loops: half of the Euler characteristic.
std::int64_t half_characteristic(const TriangleMesh& mesh) {
    std::vector<std::uint8_t> used(mesh.positions.size(), 0);
    std::int64_t triangles = 0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        if (triangle.x == triangle.y) continue;
        for (int corner = 0; corner < 3; ++corner) used[triangle[corner]] = 1;
        ++triangles;
    }
    return (static_cast<std::int64_t>(std::ranges::count(used, 1)) - triangles / 2) / 2;
}

bool differs(const TriangleMesh& mesh, const Connectivity& asked) {
    return half_characteristic(mesh) != asked.pieces - asked.loops;
}

// Whether an axis goes through a cap on a line.
bool goes_around_vessel(std::span<const glm::dvec3> line, const tree::VesselTree& tree) {
    const std::vector<glm::uvec3> cap = spanning_triangles(line);
    glm::dvec3 lower(std::numeric_limits<double>::max()), upper(std::numeric_limits<double>::lowest());
    for (const glm::dvec3& p : line) lower = glm::min(lower, p), upper = glm::max(upper, p);
    for (const tree::Branch& branch : tree.branches)
        for (std::size_t i = 1; i < branch.points.size(); ++i) {
            const glm::dvec3 p = tree.points[branch.points[i - 1]].position, q = tree.points[branch.points[i]].position;
            if (glm::any(glm::lessThan(glm::max(p, q), lower)) || glm::any(glm::greaterThan(glm::min(p, q), upper)))
                continue;
            for (const glm::uvec3& t : cap)
                if (line_meets(p, q, {line[t.x], line[t.y], line[t.z]})) return true;
        }
    return false;
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

// The best line to cut along; without vertices if there is none.
class FalseLoop {
public:
    FalseLoop(const TriangleMesh& mesh, const tree::VesselTree& tree, bool fill_holes)
        : mesh_(mesh), tree_(tree), fill_holes_(fill_holes) {}

    [[nodiscard]] SurfaceLoop find(Job& job) {
        const SurfaceGraph graph(mesh_);
        if (!graph.is_closed()) return {};
        const SurfaceLoops loops(graph);
        for (const std::uint32_t edge : loops.edges())
            for (const std::uint32_t vertex : graph.edges()[edge].ends) {
                if (job.cancelled()) return {};
                look(loops, vertex);
            }
        for (double before = 2.0 * cost_; cost_ < before && !job.cancelled();) {
            before = cost_;
            for (const std::uint32_t vertex : std::vector(best_.vertices)) look(loops, vertex);
        }
        return best_;
    }

private:
    // A connection is cut rather than the hole beside it filled, unless that is far smaller.
    void look(const SurfaceLoops& loops, std::uint32_t vertex) {
        constexpr double kFilled = 2.0;
        for (SurfaceLoop& loop : loops.shortest(vertex, std::min(cost_, kLongest * double{mesh_.radii[vertex]}))) {
            const bool connects = goes_around_inside(mesh_, loop);
            const double cost = connects ? loop.length : kFilled * loop.length;
            if (loop.vertices.size() > kMostCorners || (!connects && !fill_holes_)) continue;
            if (!(cost < cost_) || goes_around_vessel(positions_of(mesh_, loop), tree_)) continue;
            cost_ = cost;
            best_ = std::move(loop);
        }
    }

    const TriangleMesh& mesh_;
    const tree::VesselTree& tree_;
    bool fill_holes_;
    SurfaceLoop best_;
    double cost_ = std::numeric_limits<double>::max();
};

} // namespace

bool has_other_loops(const TriangleMesh& mesh, const tree::VesselTree& tree) {
    return differs(mesh, connectivity_of(tree));
}

std::size_t cut_false_loops(TriangleMesh& mesh, const tree::VesselTree& tree, double memory_bytes, Job& job) {
    const Connectivity asked = connectivity_of(tree);
    if (!differs(mesh, asked)) return 0;
    if (kBytesPerTriangle * static_cast<double>(mesh.triangles.size()) > memory_bytes) return 0;
    std::size_t cut = 0;
    for (std::int64_t more = connectivity_of(mesh).loops - asked.loops; more > 0; --more, ++cut) {
        const SurfaceLoop loop = FalseLoop(mesh, tree, asked.loops == 0).find(job);
        if (loop.vertices.empty()) break;
        cut_along(mesh, loop);
    }
    return cut;
}

} // namespace ramus::mesh
