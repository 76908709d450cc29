#include "core/mesh/loops/loop_patch.h"

#include "core/base/sort_unique.h"
#include "core/mesh/loops/triangle_holes.h"

#include <algorithm>
#include <map>

namespace ramus::mesh {

namespace {

constexpr float kFar = 1e15F; // mm: beyond the longest line, and its square does not overflow

} // namespace

LoopPatch::LoopPatch(const TriangleMesh& mesh, const SurfacePart& part)
    : triangles_(part.triangles.begin(), part.triangles.end()) {
    for (const std::uint32_t n : triangles_)
        for (int corner = 0; corner < 3; ++corner) vertices_.push_back(mesh.triangles[n][corner]);
    sort_unique(vertices_);
    const auto here = [&](std::uint32_t vertex) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(vertices_, vertex) - vertices_.begin());
    };
    closed_.resize_vertices(vertices_.size());
    const auto copy = [&](auto& to, const auto& from) {
        if (from.empty()) return to.clear();
        for (std::size_t v = 0; v < vertices_.size(); ++v) to[v] = from[vertices_[v]];
    };
    copy(closed_.positions, mesh.positions), copy(closed_.normals, mesh.normals), copy(closed_.radii, mesh.radii);
    copy(closed_.branches, mesh.branches), copy(closed_.dominance, mesh.dominance);
    for (const std::uint32_t n : triangles_) {
        const glm::uvec3& t = mesh.triangles[n];
        closed_.triangles.emplace_back(here(t.x), here(t.y), here(t.z));
    }
    barred_.assign(vertices_.size(), 0);
    std::map<std::uint32_t, std::vector<const PartBorder*>> connected;
    for (const PartBorder& border : part.borders) connected[border.connected].push_back(&border);
    for (const auto& [number, borders] : connected) {
        glm::uvec3 last(0); // a hole in the closing triangles of the previous border
        for (std::size_t n = 0; n < borders.size(); ++n) {
            std::vector<std::uint32_t> line;
            for (const std::uint32_t v : borders[n]->vertices) line.push_back(here(v));
            const std::size_t first = closed_.triangles.size();
            close(line);
            if (n > 0) {
                const glm::uvec3 hole = open(first);
                connect_holes(closed_, last, {hole.x, hole.z, hole.y}); // the other way round
            }
            if (n + 1 < borders.size()) last = open(first + 1);
        }
    }
    all_triangles_ = closed_.triangles.size();
}

// Closes a border with triangles to one far point.
void LoopPatch::close(std::span<const std::uint32_t> border) {
    const std::uint32_t point = add_far(border.front());
    for (std::size_t n = 0; n < border.size(); ++n) {
        const std::uint32_t from = border[n], to = border[(n + 1) % border.size()];
        barred_[from] = 1;
        closed_.triangles.emplace_back(point, to, from);
    }
}

std::uint32_t LoopPatch::add_far(std::uint32_t like) {
    const auto vertex = static_cast<std::uint32_t>(closed_.positions.size());
    closed_.for_each_array([&](auto& array) {
        if (array.empty()) return;
        const auto same = array[like]; // by value: the array grows
        array.push_back(same);
    });
    closed_.positions[vertex] = glm::vec3(kFar, 0.0F, 0.0F);
    barred_.push_back(1);
    return vertex;
}

// Opens a hole in a closing triangle. Returns the corners of the hole, in the order of the triangle's.
glm::uvec3 LoopPatch::open(std::size_t triangle) {
    glm::uvec3 hole;
    for (int n = 0; n < 3; ++n) hole[n] = add_far(closed_.triangles[triangle].x);
    open_hole(closed_, triangle, hole);
    return hole;
}

void LoopPatch::put_back(TriangleMesh& mesh) const {
    const std::size_t first = mesh.positions.size(), own = vertices_.size();
    const std::size_t more = closed_.positions.size() - barred_.size();
    const auto put = [&](auto& to, const auto& from) {
        if (from.empty()) return;
        to.resize(first + more);
        for (std::size_t v = 0; v < own; ++v) to[vertices_[v]] = from[v];
        for (std::size_t v = 0; v < more; ++v) to[first + v] = from[barred_.size() + v];
    };
    put(mesh.positions, closed_.positions), put(mesh.normals, closed_.normals), put(mesh.radii, closed_.radii);
    put(mesh.branches, closed_.branches), put(mesh.dominance, closed_.dominance);
    const auto there = [&](std::uint32_t v) {
        return v < own ? vertices_[v] : static_cast<std::uint32_t>(first + v - barred_.size());
    };
    const auto renamed = [&](const glm::uvec3& t) { return glm::uvec3(there(t.x), there(t.y), there(t.z)); };
    for (std::size_t n = 0; n < triangles_.size(); ++n) mesh.triangles[triangles_[n]] = renamed(closed_.triangles[n]);
    for (std::size_t n = all_triangles_; n < closed_.triangles.size(); ++n)
        mesh.triangles.push_back(renamed(closed_.triangles[n]));
}

} // namespace ramus::mesh
