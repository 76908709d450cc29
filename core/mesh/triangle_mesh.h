// TriangleMesh: an indexed triangle surface in mm (RAS) whose vertices know where they came from. Arrays are either
// empty or as long as `positions`. A plain value; large ones are shared as shared_ptr<const TriangleMesh>.
#pragma once

#include "core/base/large_array.h"

#include <cstdint>
#include <glm/vec3.hpp>

namespace ramus::mesh {

struct TriangleMesh {
    LargeArray<glm::vec3> positions;   // mm
    LargeArray<glm::vec3> normals;     // unit length, outward
    LargeArray<float> radii;           // local vessel radius in mm
    LargeArray<std::int32_t> branches; // id of the dominating branch
    LargeArray<glm::uvec3> triangles;  // counter-clockwise seen from outside
    bool operator==(const TriangleMesh&) const = default;
};

} // namespace ramus::mesh
