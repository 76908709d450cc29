#include "core/mesh/loops/cut_loop.h"

#include "core/field/brick_field.h"
#include "core/mesh/loops/spanning_triangles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>

namespace ramus::mesh {

namespace {

constexpr std::size_t kSides = 2;   // left, right
constexpr float kMostOfWay = 0.25F; // to its neighbours, that a vertex of the line moves

// A vertex of the line, as one side has it.
struct Rim {
    std::vector<std::pair<std::uint32_t, int>> corners; // triangle and corner
    glm::vec3 neighbours{0.0F};                         // the mean of those on this side
};

int corner_of(const glm::uvec3& triangle, std::uint32_t vertex) {
    return triangle[0] == vertex ? 0 : triangle[1] == vertex ? 1 : 2;
}

class Cut {
public:
    Cut(TriangleMesh& mesh, const SurfaceLoop& loop)
        : mesh_(mesh), line_(loop.vertices), cap_(spanning_triangles(positions_of(mesh, loop))) {
        for (const std::uint32_t v : line_) around_[v];
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            for (int corner = 0; corner < 3; ++corner)
                if (const auto at = around_.find(mesh.triangles[t][corner]); at != around_.end())
                    at->second.push_back(static_cast<std::uint32_t>(t));
        for (std::size_t n = 0; n < line_.size(); ++n)
            for (std::size_t side = 0; side < kSides; ++side) rims_[side].push_back(rim(n, side));
    }

    void make() {
        const std::size_t first = mesh_.positions.size(), count = line_.size();
        mesh_.resize_vertices(first + count); // the line's on the right
        std::array<std::vector<std::uint32_t>, kSides> vertices;
        for (std::size_t n = 0; n < count; ++n) {
            const auto right = static_cast<std::uint32_t>(first + n);
            mesh_.for_each_array([&](auto& array) { array[right] = array[line_[n]]; });
            for (const auto& [triangle, corner] : rims_[1][n].corners) mesh_.triangles[triangle][corner] = right;
            vertices[0].push_back(line_[n]), vertices[1].push_back(right);
        }
        for (std::size_t side = 0; side < kSides; ++side)
            for (std::size_t n = 0; n < count; ++n) move_off(vertices[side][n], rims_[side][n]);
        for (const glm::uvec3& triangle : cap_) {
            const auto [a, b, c] = std::array{triangle.x, triangle.y, triangle.z};
            mesh_.triangles.emplace_back(vertices[0][a], vertices[0][c], vertices[0][b]);
            mesh_.triangles.emplace_back(vertices[1][a], vertices[1][b], vertices[1][c]);
        }
    }

private:
    // The triangles at the n-th vertex on one side: on the left those from the line's next edge counter-clockwise to
    // its last one, on the right the others.
    [[nodiscard]] Rim rim(std::size_t n, std::size_t side) const {
        const std::uint32_t here = line_[n];
        const std::uint32_t next = line_[(n + 1) % line_.size()], last = line_[(n + line_.size() - 1) % line_.size()];
        const std::uint32_t end = side == 0 ? last : next;
        std::uint32_t from = side == 0 ? next : last;
        Rim rim;
        float count = 0.0F;
        while (from != end && rim.corners.size() <= around_.at(here).size()) {
            for (const std::uint32_t t : around_.at(here)) {
                const glm::uvec3& triangle = mesh_.triangles[t];
                const int corner = corner_of(triangle, here);
                if (triangle[(corner + 1) % 3] != from) continue;
                rim.corners.emplace_back(t, corner);
                from = triangle[(corner + 2) % 3];
                break;
            }
            if (from == end && count > 0.0F) break;
            rim.neighbours += mesh_.positions[from], count += 1.0F;
        }
        rim.neighbours /= std::max(count, 1.0F);
        return rim;
    }

    void move_off(std::uint32_t vertex, const Rim& rim) {
        const glm::vec3 way = rim.neighbours - mesh_.positions[vertex];
        const float length = glm::length(way);
        const float wall = 0.5F * static_cast<float>(field::kWallRadii) * mesh_.radii[vertex];
        if (length > 0.0F) mesh_.positions[vertex] += std::min(wall / length, kMostOfWay) * way;
    }

    TriangleMesh& mesh_;
    std::span<const std::uint32_t> line_;
    std::vector<glm::uvec3> cap_;                                          // by places in the line
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> around_; // triangles at each vertex of the line
    std::array<std::vector<Rim>, kSides> rims_;
};

} // namespace

void cut_along(TriangleMesh& mesh, const SurfaceLoop& loop) { Cut(mesh, loop).make(); }

} // namespace ramus::mesh
