#include "core/mesh/value_bands.h"

#include "core/base/infinity.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::mesh {

namespace {

struct Corner {
    glm::vec3 position{0.0F}, normal{0.0F};
    float value = 0.0F;
};
using Polygon = std::vector<Corner>;

// The part of a convex polygon where sign * value <= sign * limit.
Polygon clipped_by(const Polygon& polygon, float limit, float sign) {
    Polygon part;
    for (std::size_t n = 0; n < polygon.size(); ++n) {
        const Corner &a = polygon[n], &b = polygon[(n + 1) % polygon.size()];
        const bool a_in = sign * a.value <= sign * limit, b_in = sign * b.value <= sign * limit;
        if (a_in) part.push_back(a);
        if (a_in == b_in) continue;
        const float t = (limit - a.value) / (b.value - a.value);
        part.push_back({glm::mix(a.position, b.position, t), glm::normalize(glm::mix(a.normal, b.normal, t)), limit});
    }
    return part;
}

void add_polygon(TriangleMesh& mesh, const Polygon& polygon) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Corner& corner : polygon) {
        mesh.positions.push_back(corner.position);
        mesh.normals.push_back(corner.normal);
    }
    for (std::uint32_t n = 2; n < polygon.size(); ++n) mesh.triangles.push_back({first, first + n - 1, first + n});
}

} // namespace

std::vector<TriangleMesh> value_bands(const TriangleMesh& mesh, std::span<const float> values,
                                      std::span<const double> limits) {
    std::vector<TriangleMesh> bands(limits.size() + 1);
    for (const glm::uvec3& t : mesh.triangles) {
        Polygon triangle;
        for (int n = 0; n < 3; ++n) triangle.push_back({mesh.positions[t[n]], mesh.normals[t[n]], values[t[n]]});
        const auto [least, most] = std::minmax({values[t.x], values[t.y], values[t.z]});
        for (std::size_t band = 0; band < bands.size(); ++band) {
            const auto from = static_cast<float>(band == 0 ? -kInfinity : limits[band - 1]);
            const auto to = static_cast<float>(band == limits.size() ? kInfinity : limits[band]);
            if (most <= from || least > to) continue;
            Polygon part = triangle;
            if (least < from) part = clipped_by(part, from, -1.0F);
            if (most > to) part = clipped_by(part, to, 1.0F);
            if (part.size() > 2) add_polygon(bands[band], part);
        }
    }
    return bands;
}

} // namespace ramus::mesh
