// TriangleMesh: an indexed triangle surface in mm (RAS) whose vertices know where they came from. Arrays are either
// empty or as long as `positions`. A plain value; large ones are shared as shared_ptr<const TriangleMesh>.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::mesh {

struct TriangleMesh {
    std::vector<glm::vec3> positions;   // mm
    std::vector<glm::vec3> normals;     // unit length, outward
    std::vector<float> radii;           // local vessel radius in mm
    std::vector<std::int32_t> branches; // id of the dominating branch
    std::vector<glm::uvec3> triangles;  // counter-clockwise seen from outside
    bool operator==(const TriangleMesh&) const = default;
};

} // namespace ramus::mesh
