// Which triangles of a set meet.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::mesh {

struct TrianglePair {
    std::uint32_t first = 0, second = 0; // triangles, by their places in the set; the lower first
    bool operator==(const TrianglePair&) const = default;
    [[nodiscard]] bool operator<(const TrianglePair& other) const {
        return first != other.first ? first < other.first : second < other.second;
    }
};

// The pairs that meet beyond the corners that they share (exact_triangles.h), ascending, of which at least one is asked
// for (`asked`, by triangle). Takes time as the number of triangles and of those that lie beside each other along the
// axis in which the set is longest: for sets of some ten thousand.
[[nodiscard]] std::vector<TrianglePair> meeting_triangles(std::span<const glm::vec3> positions,
                                                          std::span<const glm::uvec3> triangles,
                                                          std::span<const std::uint8_t> asked);

} // namespace ramus::mesh
