#include "core/mesh/loops/open_lost_loops.h"

#include "core/base/across.h"
#include "core/base/bounds.h"
#include "core/base/infinity.h"
#include "core/base/lines.h"
#include "core/measure/deviation/packed_triangles.h"
#include "core/mesh/loops/spanning_triangles.h"
#include "core/mesh/loops/tree_cycles.h"
#include "core/mesh/loops/triangle_holes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <set>
#include <span>

namespace ramus::mesh {

namespace {

constexpr double kPackedBytes = 60.0;     // for each packed triangle
constexpr std::size_t kCycleCorners = 48; // largest number of corners: spanning triangles take cubic time
constexpr int kSpanSteps = 8;             // places along an edge of a spanning triangle
constexpr double kWidest = 0.5;           // radius of a tunnel over its distance from centerlines and triangle edges

// A place on the triangles that span a cycle.
struct Middle {
    glm::dvec3 at{0.0}, across{0.0};
    double clearance = 0.0; // mm to the cycle's centerline
};

// At most kCycleCorners corners along a cycle, evenly spaced if it has more points.
std::vector<tree::Point> corners_of(const std::vector<tree::Point>& cycle) {
    if (cycle.size() <= kCycleCorners) return cycle;
    std::vector<double> at{0.0}; // mm along the cycle, and once around
    for (std::size_t i = 0; i < cycle.size(); ++i)
        at.push_back(at.back() + glm::distance(cycle[i].position, cycle[(i + 1) % cycle.size()].position));
    std::vector<tree::Point> corners;
    std::size_t i = 0;
    for (std::size_t n = 0; n < kCycleCorners; ++n) {
        const double mm = at.back() * static_cast<double>(n) / kCycleCorners;
        while (i + 1 < cycle.size() && at[i + 1] <= mm) ++i;
        const tree::Point &a = cycle[i], &b = cycle[(i + 1) % cycle.size()];
        const double share = at[i + 1] > at[i] ? (mm - at[i]) / (at[i + 1] - at[i]) : 0.0;
        corners.push_back({glm::mix(a.position, b.position, share), glm::mix(a.radius, b.radius, share)});
    }
    return corners;
}

double distance_to(const std::vector<tree::Point>& cycle, const glm::dvec3& place) {
    double least = kInfinity;
    for (std::size_t i = 0; i < cycle.size(); ++i)
        least = std::min(least, distance_to_line(place, cycle[i].position, cycle[(i + 1) % cycle.size()].position));
    return least;
}

// Places all over the triangles that span a cycle, the farthest from its centerline first.
std::vector<Middle> middles_of(const std::vector<tree::Point>& cycle) {
    const std::vector<tree::Point> corners = corners_of(cycle);
    std::vector<glm::dvec3> line;
    for (const tree::Point& corner : corners) line.push_back(corner.position);
    std::vector<Middle> middles;
    if (line.size() < 3) return middles;
    for (const glm::uvec3& t : spanning_triangles(line)) {
        const glm::dvec3 a = line[t.x], b = line[t.y], c = line[t.z], across = glm::cross(b - a, c - a);
        if (!(glm::length(across) > 0.0)) continue;
        for (int i = 0; i < kSpanSteps; ++i)
            for (int j = 0; i + j < kSpanSteps; ++j) {
                const double of_b = (i + 1.0 / 3.0) / kSpanSteps, of_c = (j + 1.0 / 3.0) / kSpanSteps;
                const glm::dvec3 at = a + of_b * (b - a) + of_c * (c - a);
                middles.push_back({at, glm::normalize(across), distance_to(cycle, at)});
            }
    }
    std::ranges::stable_sort(middles, std::greater<>(), &Middle::clearance);
    return middles;
}

// One end of a tunnel: a triangle, and the corners of a smaller triangle inside it, with the same orientation.
struct Mouth {
    std::uint32_t triangle = 0;
    std::array<glm::dvec3, 3> at{};
};
struct Tunnel {
    std::array<Mouth, 2> mouths;
    std::uint32_t turn = 0; // the corner of the second mouth that is opposite to the first corner of the first mouth
    double radius = 0.0;    // mm
};

constexpr double kThird = 2.0943951023931953; // of a turn
constexpr double kSees = 1.4;                 // a corner sees a side of the mouth if its normal is within this angle

// The angle in [-pi, pi].
double turned(double angle) { return std::remainder(angle, 3.0 * kThird); }

class TunnelFinder {
public:
    TunnelFinder(const TriangleMesh& mesh, const LargeAllocator<std::byte>& memory)
        : mesh_(mesh), surface_(mesh, measure::kMostCopied, memory) {
        size_ = static_cast<double>(glm::length(box_of_points(mesh.positions).size()));
    }

    [[nodiscard]] bool inside(const glm::dvec3& place) {
        int turns = 0;
        surface_.crossings(place, glm::normalize(glm::dvec3(0.8506508, 0.4472136, 0.2763932)), size_, found_);
        for (const measure::Crossing& crossing : found_) turns += crossing.out ? 1 : -1;
        return turns > 0;
    }
    // The straight tunnel through the place, across the spanning triangles; none if a third triangle is in the way.
    [[nodiscard]] std::optional<Tunnel> through(const Middle& middle) const {
        const glm::dvec3 d = middle.across;
        const auto [u, v] = axes_across(d);
        Tunnel tunnel;
        tunnel.radius = kWidest * middle.clearance;
        std::array<std::array<double, 3>, 2> angle{}; // of the triangles' corners around the tunnel
        for (std::size_t side = 0; side < 2; ++side) {
            const measure::Crossing exit = surface_.first_exit(middle.at, side == 0 ? d : -d, 0.0);
            if (!(exit.at < kInfinity) || taken_.contains(exit.triangle)) return std::nullopt;
            tunnel.mouths[side].triangle = exit.triangle;
            std::array<glm::dvec2, 3> flat;
            for (std::size_t n = 0; n < 3; ++n) {
                const glm::dvec3 off = corner_at(exit.triangle, n) - middle.at;
                flat[n] = {glm::dot(off, u), glm::dot(off, v)};
                angle[side][n] = std::atan2(flat[n].y, flat[n].x);
            }
            for (std::size_t n = 0; n < 3; ++n) {
                const glm::dvec2 edge = flat[(n + 1) % 3] - flat[n];
                const double away = std::abs(flat[n].x * edge.y - flat[n].y * edge.x) / glm::length(edge);
                tunnel.radius = std::min(tunnel.radius, kWidest * away);
            }
        }
        if (tunnel.mouths[0].triangle == tunnel.mouths[1].triangle) return std::nullopt;
        const double first = angle[0][0] - 0.5 * kThird; // each side of the mouth before a corner of the triangle
        if (!find_turn(angle, first, tunnel)) return std::nullopt;
        for (std::uint32_t n = 0; n < 3; ++n) {
            const double at = first + n * kThird;
            const glm::dvec3 line = middle.at + tunnel.radius * (std::cos(at) * u + std::sin(at) * v);
            const measure::Crossing up = surface_.first_exit(line, d, 0.0), down = surface_.first_exit(line, -d, 0.0);
            if (up.triangle != tunnel.mouths[0].triangle || down.triangle != tunnel.mouths[1].triangle)
                return std::nullopt;
            tunnel.mouths[0].at[n] = line + up.at * d;
            tunnel.mouths[1].at[(tunnel.turn + 3 - n) % 3] = line - down.at * d;
        }
        return tunnel;
    }
    void take(const Tunnel& tunnel) {
        for (const Mouth& mouth : tunnel.mouths) taken_.insert(mouth.triangle);
    }

private:
    [[nodiscard]] glm::dvec3 corner_at(std::uint32_t triangle, std::size_t n) const {
        return glm::dvec3(mesh_.positions[mesh_.triangles[triangle][static_cast<glm::length_t>(n)]]);
    }
    // Pairs the corners of both triangles with the corners of the mouths, so that each corner sees the side of the
    // mouth that begins there. Seen through the tunnel, the second triangle has the opposite orientation. Returns
    // whether that is possible.
    static bool find_turn(const std::array<std::array<double, 3>, 2>& angle, double first, Tunnel& tunnel) {
        double most = 0.0, best = kSees;
        for (std::uint32_t n = 0; n < 3; ++n)
            most = std::max(most, std::abs(turned(angle[0][n] - first - (n + 0.5) * kThird)));
        for (std::uint32_t turn = 0; turn < 3; ++turn) {
            double aside = 0.0;
            for (std::uint32_t n = 0; n < 3; ++n) {
                const double corner = first + ((turn + 3 - n) % 3) * kThird;
                aside = std::max(aside, std::abs(turned(angle[1][n] - corner + 0.5 * kThird)));
            }
            if (aside < best) best = aside, tunnel.turn = turn;
        }
        return most < kSees && best < kSees;
    }

    const TriangleMesh& mesh_;
    measure::PackedTriangles surface_;
    double size_ = 0.0; // mm, of the whole
    std::vector<measure::Crossing> found_;
    std::set<std::uint32_t> taken_; // triangles of tunnels
};

// Adds a vertex on a triangle. Its radius, branch and dominance are those of the first corner.
std::uint32_t add_vertex(TriangleMesh& mesh, const glm::uvec3& triangle, const glm::dvec3& at) {
    const auto vertex = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.for_each_array([&](auto& array) {
        if (array.empty()) return;
        const auto like = array[triangle.x]; // by value: the array grows
        array.push_back(like);
    });
    mesh.positions[vertex] = glm::vec3(at);
    if (!mesh.normals.empty())
        mesh.normals[vertex] =
            glm::normalize(mesh.normals[triangle.x] + mesh.normals[triangle.y] + mesh.normals[triangle.z]);
    return vertex;
}

void dig(TriangleMesh& mesh, const Tunnel& tunnel) {
    std::array<glm::uvec3, 2> holes{};
    for (std::size_t side = 0; side < 2; ++side) {
        const Mouth& mouth = tunnel.mouths[side];
        const glm::uvec3 t = mesh.triangles[mouth.triangle];
        for (int n = 0; n < 3; ++n) holes[side][n] = add_vertex(mesh, t, mouth.at[static_cast<std::size_t>(n)]);
        open_hole(mesh, mouth.triangle, holes[side]);
    }
    glm::uvec3 across;
    for (int n = 0; n < 3; ++n) across[n] = holes[1][(static_cast<int>(tunnel.turn) + 3 - n) % 3];
    connect_holes(mesh, holes[0], across);
}

} // namespace

OpenedLoops open_lost_loops(TriangleMesh& mesh, const tree::VesselTree& tree, std::size_t lost_loops,
                            double memory_bytes, Job& job, const std::shared_ptr<ArrayMemory>& disk) {
    OpenedLoops found;
    const bool fits = kPackedBytes * static_cast<double>(mesh.triangles.size()) <= memory_bytes;
    if (mesh.triangles.empty() || (!fits && disk == nullptr)) return found;
    constexpr std::size_t kLookedAt = 64; // places of a cycle that are tried
    std::vector<Tunnel> tunnels;
    {
        TunnelFinder finder(mesh, LargeAllocator<std::byte>(fits ? nullptr : disk));
        for (const auto& cycle : short_cycles(tree)) {
            if (tunnels.size() == lost_loops || job.cancelled()) break;
            std::vector<Middle> middles = middles_of(cycle);
            if (middles.size() > kLookedAt) middles.resize(kLookedAt);
            const auto is_inside = [&](const Middle& middle) { return finder.inside(middle.at); };
            if (middles.empty() || !std::ranges::all_of(middles, is_inside)) continue; // a hole is left
            std::optional<Tunnel> tunnel;
            for (const Middle& middle : middles) // the widest
                if (const auto other = finder.through(middle); other && (!tunnel || other->radius > tunnel->radius))
                    tunnel = other;
            if (tunnel)
                tunnels.push_back(*tunnel), finder.take(*tunnel);
            else
                found.closed.push_back(glm::vec3(middles.front().at));
        }
    }
    for (const Tunnel& tunnel : tunnels) dig(mesh, tunnel);
    found.opened = tunnels.size();
    return found;
}

} // namespace ramus::mesh
