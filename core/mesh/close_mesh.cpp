#include "core/mesh/close_mesh.h"

#include "core/mesh/vertex_normals.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

namespace ramus::mesh {

namespace {

// Welds vertices at one position.
void weld(TriangleMesh& mesh) {
    std::vector<std::uint32_t> order(mesh.positions.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        const glm::vec3 &p = mesh.positions[a], &q = mesh.positions[b];
        if (p.x != q.x) return p.x < q.x;
        if (p.y != q.y) return p.y < q.y;
        return p.z < q.z;
    };
    std::ranges::sort(order, before);
    std::vector<std::uint32_t> now(order.size());
    LargeArray<glm::vec3> distinct;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || before(order[i - 1], order[i])) distinct.push_back(mesh.positions[order[i]]);
        now[order[i]] = static_cast<std::uint32_t>(distinct.size() - 1);
    }
    LargeArray<glm::uvec3> triangles;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::uvec3 u(now[t.x], now[t.y], now[t.z]);
        if (u.x != u.y && u.y != u.z && u.z != u.x) triangles.push_back(u);
    }
    mesh.positions = std::move(distinct);
    mesh.triangles = std::move(triangles);
}

struct HalfEdge {
    std::uint32_t low, high, triangle;
    bool rising; // the triangle runs from low to high
    bool operator<(const HalfEdge& o) const {
        if (low != o.low) return low < o.low;
        return high != o.high ? high < o.high : triangle < o.triangle;
    }
    [[nodiscard]] bool same_edge(const HalfEdge& o) const { return low == o.low && high == o.high; }
};

LargeArray<HalfEdge> half_edges(const TriangleMesh& mesh) {
    LargeArray<HalfEdge> all(mesh.memory());
    all.reserve(3 * mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.triangles[i][k], b = mesh.triangles[i][(k + 1) % 3];
            all.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(i), a < b});
        }
    std::sort(all.begin(), all.end());
    return all;
}

Result<void> expect_two_each(const TriangleMesh& mesh, const LargeArray<HalfEdge>& edges, const std::string& where) {
    std::size_t open = 0, crowded = 0;
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i + 1;
        while (end < edges.size() && edges[end].same_edge(edges[i])) ++end;
        if (end - i != 2) {
            if (open + crowded == 0) first = edges[i].low;
            ++(end - i == 1 ? open : crowded);
        }
        i = end;
    }
    if (open + crowded == 0) return {};
    const glm::vec3& p = mesh.positions[first];
    char position[96];
    std::snprintf(position, sizeof position, "(%g, %g, %g)", double(p.x), double(p.y), double(p.z));
    const auto edges_text = [](std::size_t n) { return std::to_string(n) + (n == 1 ? " edge has " : " edges have "); };
    return fail(
        "the surface is not closed: " +
            (open > 0 ? edges_text(open) + "one triangle only" : edges_text(crowded) + "more than two triangles") +
            ", the first at " + position,
        where, "close its holes in the program that made it");
}

double signed_volume(const TriangleMesh& mesh, const glm::uvec3& t) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    return glm::dot(a, glm::cross(b, c)) / 6.0;
}

// Requires that every edge has two triangles.
Result<void> turn_alike(TriangleMesh& mesh, const LargeArray<HalfEdge>& edges, const std::string& where) {
    struct Neighbour {
        std::uint32_t triangle = 0;
        bool alike = true; // both run through the edge in opposite ways
    };
    std::vector<std::array<Neighbour, 3>> around(mesh.triangles.size());
    std::vector<std::uint8_t> known(mesh.triangles.size(), 0);
    for (std::size_t i = 0; i < edges.size(); i += 2) {
        const HalfEdge &a = edges[i], &b = edges[i + 1];
        const bool alike = a.rising != b.rising;
        around[a.triangle][known[a.triangle]++] = {b.triangle, alike};
        around[b.triangle][known[b.triangle]++] = {a.triangle, alike};
    }
    enum : std::uint8_t { kOpen, kKept, kTurned };
    std::vector<std::uint8_t> turn(mesh.triangles.size(), kOpen);
    double whole = 0.0;
    std::vector<std::uint32_t> part;
    for (std::uint32_t seed = 0; seed < turn.size(); ++seed) {
        if (turn[seed] != kOpen) continue;
        part.assign(1, seed);
        turn[seed] = kKept;
        bool repaired = false;
        for (std::size_t i = 0; i < part.size(); ++i)
            for (const Neighbour& next : around[part[i]]) {
                const std::uint8_t required = next.alike == (turn[part[i]] == kKept) ? kKept : kTurned;
                std::uint8_t& now = turn[next.triangle];
                if (now == kOpen) {
                    now = required;
                    repaired = repaired || required == kTurned;
                    part.push_back(next.triangle);
                } else if (now != required) {
                    return fail("the surface has one side only and no inside", where, "give a closed surface");
                }
            }
        double volume = 0.0;
        for (const std::uint32_t t : part) {
            if (turn[t] == kTurned) std::swap(mesh.triangles[t].y, mesh.triangles[t].z);
            volume += signed_volume(mesh, mesh.triangles[t]);
        }
        if (repaired && volume < 0.0) {
            for (const std::uint32_t t : part) std::swap(mesh.triangles[t].y, mesh.triangles[t].z);
            volume = -volume;
        }
        whole += volume;
    }
    if (whole < 0.0)
        for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    return {};
}

} // namespace

Result<TriangleMesh> closed_mesh(TriangleMesh loose, const std::string& where) {
    weld(loose);
    if (loose.triangles.empty()) return fail("there is no surface in it", where, "give a closed triangle mesh");
    const LargeArray<HalfEdge> edges = half_edges(loose);
    if (auto closed = expect_two_each(loose, edges, where); !closed) return tl::unexpected(closed.error());
    if (auto turned = turn_alike(loose, edges, where); !turned) return tl::unexpected(turned.error());
    add_normals(loose);
    return loose;
}

Result<TriangleMesh> tidy_mesh(TriangleMesh loose, const std::string& where) {
    weld(loose);
    if (loose.triangles.empty()) return fail("there is no surface in it", where, "give a triangle mesh");
    const LargeArray<HalfEdge> edges = half_edges(loose);
    if (expect_two_each(loose, edges, where)) {
        TriangleMesh turned = loose;
        if (turn_alike(turned, edges, where)) loose = std::move(turned);
    }
    add_normals(loose);
    return loose;
}

Result<void> check_closed(const TriangleMesh& mesh, const std::string& where) {
    return expect_two_each(mesh, half_edges(mesh), where);
}

std::vector<glm::uvec3> cut_polygon(std::span<const glm::dvec3> corners) {
    constexpr std::size_t kMostCorners = 1000;
    std::vector<glm::uvec3> triangles;
    if (corners.size() > kMostCorners) {
        for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) triangles.emplace_back(0, i, i + 1);
        return triangles;
    }
    std::vector<std::uint32_t> left(corners.size());
    std::iota(left.begin(), left.end(), 0U);
    glm::dvec3 normal(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    const auto turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return glm::dot(glm::cross(corners[b] - corners[a], corners[c] - corners[a]), normal);
    };
    // An ear: a convex corner whose triangle contains no other corner.
    const auto is_ear = [&](std::size_t i) {
        const std::size_t n = left.size();
        const std::uint32_t a = left[(i + n - 1) % n], b = left[i], c = left[(i + 1) % n];
        if (turn(a, b, c) <= 0.0) return false;
        for (const std::uint32_t p : left)
            if (p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0)
                return false;
        return true;
    };
    while (left.size() >= 3) {
        const std::size_t n = left.size();
        std::size_t ear = 1; // a fan, where there is no better
        if (n > 3)
            for (std::size_t i = 0; i < n; ++i)
                if (is_ear((i + 1) % n)) {
                    ear = (i + 1) % n;
                    break;
                }
        triangles.emplace_back(left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]);
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    return triangles;
}

} // namespace ramus::mesh
