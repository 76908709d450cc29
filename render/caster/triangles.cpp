#include "render/caster/triangles.h"

#include "render/scene/scene.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <tbb/parallel_for.h>

namespace ramus::render::caster {

namespace {

// Clips a triangle at this depth in front of the eye, where projection is defined.
std::size_t cut_off(const std::array<Corner, 3>& corners, float nearest, std::array<Corner, 4>& polygon) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Corner &from = corners[i], &to = corners[(i + 1) % 3];
        const bool inside = from.at.z >= nearest;
        if (inside) polygon[count++] = from;
        if (inside == (to.at.z >= nearest)) continue;
        const float t = (nearest - from.at.z) / (to.at.z - from.at.z);
        polygon[count++] = {from.at + t * (to.at - from.at), from.normal + t * (to.normal - from.normal)};
    }
    return count;
}

// Projects a triangle that is completely in front of the eye.
void project_whole(std::array<Corner, 3> corners, const TriangleKind& kind, std::uint32_t id, const View& view,
                   std::vector<Triangle>& to) {
    std::array<glm::vec2, 3> at;
    const auto project = [&] {
        for (std::size_t i = 0; i < 3; ++i)
            at[i] = glm::vec2(view.centre_x, view.centre_y) +
                    glm::vec2(corners[i].at) / (view.mm_a_pixel * (view.flat ? 1.0F : corners[i].at.z));
    };
    project();
    const auto twice_area = [&] {
        const glm::vec2 u = at[1] - at[0], v = at[2] - at[0];
        return u.x * v.y - u.y * v.x;
    };
    float area = twice_area();
    if (area < 0.0F && !kind.closed) { // seen from behind
        std::swap(corners[1], corners[2]);
        for (Corner& corner : corners) corner.normal = -corner.normal;
        project();
        area = twice_area();
    }
    if (!(area > 1e-12F)) return;
    Triangle t{};
    for (int k = 0; k < 2; ++k) {
        t.low[k] = std::min({at[0][k], at[1][k], at[2][k]});
        t.high[k] = std::max({at[0][k], at[1][k], at[2][k]});
    }
    if (t.high[0] < 0.0F || t.high[1] < 0.0F || t.low[0] > float(view.width) || t.low[1] > float(view.height)) return;
    const float share = 1.0F / area;
    float widest = 0.0F;
    for (std::size_t i = 0; i < 3; ++i) {
        // The edge opposite to corner i. Two triangles that share it compute the same numbers with opposite signs, so a
        // point on it belongs to exactly one of them.
        const glm::vec2 from = at[(i + 1) % 3], to_corner = at[(i + 2) % 3], direction = to_corner - from;
        const bool first = from.x < to_corner.x || (from.x == to_corner.x && from.y < to_corner.y);
        const glm::vec2 base = first ? from : to_corner;
        const bool owned = direction.y > 0.0F || (direction.y == 0.0F && direction.x > 0.0F);
        t.edge[i] = {base.x, base.y, direction.x, direction.y, owned};
        const float linear = view.flat ? 1.0F : 1.0F / corners[i].at.z;
        t.depth[i] = share * (view.flat ? corners[i].at.z : linear);
        for (int k = 0; k < 3; ++k) t.normal[i][k] = linear * corners[i].normal[k];
        t.slope[i] = share * glm::length(direction);
        widest = std::max(widest, t.slope[i]);
    }
    t.share = share;
    t.id = id;
    t.half_width = kind.half_width;
    // Lines become fainter where triangles are hardly wider than lines.
    t.crowded = std::clamp(1.0F / (8.0F * std::max(kind.half_width, 1e-6F) * widest), 0.22F, 1.0F);
    to.push_back(t);
}

} // namespace

void project_triangle(const std::array<Corner, 3>& corners, const TriangleKind& kind, std::uint32_t id,
                      const View& view, std::vector<Triangle>& triangles) {
    const float nearest = 1e-4F * view.block.depth_range.y;
    if (view.flat || std::ranges::all_of(corners, [&](const Corner& corner) { return corner.at.z >= nearest; }))
        return project_whole(corners, kind, id, view, triangles);
    std::array<Corner, 4> polygon;
    const std::size_t count = cut_off(corners, nearest, polygon);
    for (std::size_t k = 2; k < count; ++k)
        project_whole({polygon[0], polygon[k - 1], polygon[k]}, kind, id, view, triangles);
}

void project_triangles(const Body& body, const View& view, const glm::dmat4& to_eye, std::vector<Triangle>& triangles) {
    const ShapeTriangles& shape = *body.shape;
    if (shape.triangles.empty()) return;
    glm::dmat4 about = glm::translate(to_eye, shape.bounds.centre());
    const double nearer = body.half_width > 0.0F ? kContextLinesNearer * double(view.mm_a_pixel) : 0.0;
    about = (view.flat ? glm::translate(glm::dmat4(1.0), {0.0, 0.0, -nearer})
                       : glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 - nearer))) *
            about;
    const glm::mat4 to(about);
    const glm::mat3 turn(to_eye);
    std::vector<Corner> corners(shape.vertices.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, corners.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const ShapeTriangles::Vertex& vertex = shape.vertices[i];
            const glm::vec3 normal = turn * vertex.normal;
            corners[i] = {glm::vec3(to * glm::vec4(vertex.position, 1.0F)), {normal.x, normal.y, -normal.z}};
        }
    });
    constexpr std::size_t kChunk = 4096;
    const std::size_t chunks = (shape.triangles.size() + kChunk - 1) / kChunk;
    const TriangleKind kind{shape.closed, body.half_width};
    std::vector<std::vector<Triangle>> parts(chunks);
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
        for (std::size_t i = chunk * kChunk; i < std::min((chunk + 1) * kChunk, shape.triangles.size()); ++i) {
            const glm::uvec3& t = shape.triangles[i];
            project_triangle({corners[t.x], corners[t.y], corners[t.z]}, kind, body.id, view, parts[chunk]);
        }
    });
    for (const std::vector<Triangle>& part : parts) triangles.insert(triangles.end(), part.begin(), part.end());
}

} // namespace ramus::render::caster
