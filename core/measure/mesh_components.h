// How many connected pieces a mesh has: triangles that share a vertex belong together.
#pragma once

#include "core/base/paged_array.h"
#include "core/mesh/triangle_mesh.h"

#include <cstdint>

namespace ramus::measure {

// Counts while a mesh comes in parts. Vertices that no triangle uses count as pieces of their own.
class ComponentCounter {
public:
    void add_vertices(std::size_t count);
    void join(std::uint32_t a, std::uint32_t b); // two corners of a triangle
    [[nodiscard]] int count() const { return static_cast<int>(stands_.size() - joined_); }

private:
    std::uint32_t find(std::uint32_t vertex);
    PagedArray<std::uint32_t> stands_; // by vertex: another of its piece, lower unless it is the lowest itself
    std::size_t joined_ = 0;
};

// Vertices that no triangle uses do not count.
[[nodiscard]] int component_count(const mesh::TriangleMesh& mesh);

} // namespace ramus::measure
