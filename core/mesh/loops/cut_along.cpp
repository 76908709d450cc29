#include "core/mesh/loops/cut_along.h"

#include "core/field/brick_field.h"
#include "core/field/separation.h"
#include "core/mesh/loops/spanning_triangles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <unordered_map>
#include <utility>

namespace ramus::mesh {

namespace {

constexpr std::size_t kSides = 2;   // left, right
constexpr float kMostOfWay = 0.25F; // to its neighbours, that a vertex of the line moves

// A vertex of the line, on one of the two sides.
struct Rim {
    std::vector<std::pair<std::uint32_t, int>> corners; // triangle and corner
    glm::vec3 neighbours{0.0F};                         // the mean of the neighbours on this side
};

int corner_of(const glm::uvec3& triangle, std::uint32_t vertex) {
    return triangle[0] == vertex ? 0 : triangle[1] == vertex ? 1 : 2;
}

class Cut {
public:
    Cut(TriangleMesh& mesh, const ClosedLine& line) : mesh_(mesh), line_(line.vertices) {
        for (const std::uint32_t v : line_) around_[v];
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            for (int corner = 0; corner < 3; ++corner)
                if (const auto at = around_.find(mesh.triangles[t][corner]); at != around_.end())
                    at->second.push_back(static_cast<std::uint32_t>(t));
    }

    [[nodiscard]] bool make() {
        for (std::size_t n = 0; n < line_.size(); ++n)
            for (std::size_t side = 0; side < kSides; ++side) {
                std::optional<Rim> its = rim(n, side);
                if (!its) return false;
                rims_[side].push_back(std::move(*its));
            }
        const std::size_t first = mesh_.positions.size(), count = line_.size();
        const std::vector<glm::uvec3> cap = cap_triangles();
        const bool has_middle = cap.front().z == count;
        mesh_.resize_vertices(first + count + (has_middle ? kSides : 0)); // the line's on the right, the middles
        std::array<std::vector<std::uint32_t>, kSides> vertices;
        for (std::size_t n = 0; n < count; ++n) {
            const auto right = static_cast<std::uint32_t>(first + n);
            mesh_.for_each_array([&](auto& array) { array[right] = array[line_[n]]; });
            for (const auto& [triangle, corner] : rims_[1][n].corners) mesh_.triangles[triangle][corner] = right;
            vertices[0].push_back(line_[n]), vertices[1].push_back(right);
        }
        for (std::size_t side = 0; side < kSides; ++side) {
            for (std::size_t n = 0; n < count; ++n) move_off(vertices[side][n], rims_[side][n]);
            if (has_middle) add_middle(static_cast<std::uint32_t>(first + count + side), vertices[side], side);
        }
        for (const glm::uvec3& triangle : cap) {
            const auto [a, b, c] = std::array{triangle.x, triangle.y, triangle.z};
            mesh_.triangles.emplace_back(vertices[0][a], vertices[0][c], vertices[0][b]);
            mesh_.triangles.emplace_back(vertices[1][a], vertices[1][b], vertices[1][c]);
        }
        return true;
    }

private:
    // The triangles at the n-th vertex on one side: on the left from the next edge of the line counter-clockwise to the
    // previous one, on the right the others. None if they do not connect the two edges.
    [[nodiscard]] std::optional<Rim> rim(std::size_t n, std::size_t side) const {
        const std::uint32_t here = line_[n];
        const std::uint32_t next = line_[(n + 1) % line_.size()], last = line_[(n + line_.size() - 1) % line_.size()];
        const std::uint32_t end = side == 0 ? last : next;
        const std::vector<std::uint32_t>& triangles = around_.at(here);
        std::uint32_t from = side == 0 ? next : last;
        Rim rim;
        float count = 0.0F;
        while (from != end) {
            const auto it = std::ranges::find_if(triangles, [&](std::uint32_t t) {
                return mesh_.triangles[t][(corner_of(mesh_.triangles[t], here) + 1) % 3] == from;
            });
            if (it == triangles.end() || rim.corners.size() == triangles.size()) return std::nullopt;
            const int corner = corner_of(mesh_.triangles[*it], here);
            rim.corners.emplace_back(*it, corner);
            from = mesh_.triangles[*it][(corner + 2) % 3];
            if (from == end && count > 0.0F) break;
            rim.neighbours += mesh_.positions[from], count += 1.0F;
        }
        rim.neighbours /= std::max(count, 1.0F);
        return rim;
    }

    // The triangles of a cap, by places in the line. If the triangles of least area have an edge that the surface
    // already has, which would then have four triangles, a fan around a middle vertex, whose place is one past the
    // last.
    [[nodiscard]] std::vector<glm::uvec3> cap_triangles() const {
        std::vector<glm::dvec3> line;
        for (const std::uint32_t v : line_) line.emplace_back(mesh_.positions[v]);
        std::vector<glm::uvec3> cap = spanning_triangles(line);
        const auto is_taken = [&](std::uint32_t a, std::uint32_t b) { // a < b
            if (b - a == 1 || b - a == line_.size() - 1) return false;
            return std::ranges::any_of(around_.at(line_[a]), [&](std::uint32_t t) {
                const glm::uvec3& corners = mesh_.triangles[t];
                return corners.x == line_[b] || corners.y == line_[b] || corners.z == line_[b];
            });
        };
        if (std::ranges::any_of(cap, [&](const glm::uvec3& t) {
                return is_taken(t.x, t.y) || is_taken(t.y, t.z) || is_taken(t.x, t.z);
            })) {
            cap.clear();
            const auto count = static_cast<std::uint32_t>(line_.size());
            for (std::uint32_t n = 0; n < count; ++n) cap.emplace_back(n, (n + 1) % count, count);
        }
        return cap;
    }

    // Adds the middle vertex of a cap, after the vertices of its line.
    void add_middle(std::uint32_t middle, std::vector<std::uint32_t>& vertices, std::size_t side) {
        mesh_.for_each_array([&](auto& array) { array[middle] = array[vertices.front()]; });
        glm::vec3 sum(0.0F), across(0.0F);
        for (const std::uint32_t v : vertices) sum += mesh_.positions[v];
        const glm::vec3 at = sum / static_cast<float>(vertices.size());
        for (std::size_t n = 0; n < vertices.size(); ++n)
            across += glm::cross(mesh_.positions[vertices[n]] - at,
                                 mesh_.positions[vertices[(n + 1) % vertices.size()]] - at);
        mesh_.positions[middle] = at;
        if (const float length = glm::length(across); length > 0.0F && !mesh_.normals.empty())
            mesh_.normals[middle] = (side == 0 ? -1.0F : 1.0F) / length * across;
        vertices.push_back(middle);
    }

    void move_off(std::uint32_t vertex, const Rim& rim) {
        const glm::vec3 way = rim.neighbours - mesh_.positions[vertex];
        const float length = glm::length(way);
        const float wall = 0.5F * static_cast<float>(field::kWallRadii) * mesh_.radii[vertex];
        if (length > 0.0F) mesh_.positions[vertex] += std::min(wall / length, kMostOfWay) * way;
    }

    TriangleMesh& mesh_;
    std::span<const std::uint32_t> line_;
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> around_; // triangles at each vertex of the line
    std::array<std::vector<Rim>, kSides> rims_;
};

} // namespace

bool cut_along(TriangleMesh& mesh, const ClosedLine& line) { return Cut(mesh, line).make(); }

} // namespace ramus::mesh
