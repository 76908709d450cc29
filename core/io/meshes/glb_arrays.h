// The arrays of a GLB file: attributes of vertices, and corners of triangles; plain, or compressed as
// EXT_meshopt_compression wants it (https://github.com/KhronosGroup/glTF, extensions).
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace ramus::io {

struct GlbArray {
    std::size_t count = 0, stride = 0; // elements; bytes of each once it is unpacked
    const char* filter = nullptr;      // of the extension; null: none
    std::string bytes;                 // packed
};

// Positions with a step of 2^-21 of their largest coordinate, so 0.0003 mm at 512 mm. `unpacked`: gets what readers
// will see.
[[nodiscard]] GlbArray packed_positions(const std::vector<glm::vec3>& positions, std::vector<glm::vec3>& unpacked);
// Unit vectors as bytes (KHR_mesh_quantization), within half a degree.
[[nodiscard]] GlbArray packed_normals(const std::vector<glm::vec3>& normals);
// Numbers with a precision of 1 in 30,000, or exactly.
[[nodiscard]] GlbArray packed_numbers(const std::vector<float>& numbers);
[[nodiscard]] GlbArray packed_whole_numbers(const std::vector<float>& numbers);
// Corners of triangles, three after the other, of at most `vertices` vertices. Triangles stay in order, but the corner
// that comes first may change.
[[nodiscard]] GlbArray packed_triangles(std::span<const glm::uvec3> triangles, std::size_t vertices);

} // namespace ramus::io
