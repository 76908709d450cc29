#include "core/io/meshes/ply.h"

#include <bit>

namespace ramus::io {

static_assert(std::endian::native == std::endian::little, "PLY and STL are written as they lie in memory");

std::string ply_header(const MeshCounts& counts) {
    std::string header = "ply\nformat binary_little_endian 1.0\ncomment ramus " RAMUS_VERSION ", " +
                         counts.claims_text() + "\nelement vertex " + std::to_string(counts.vertices) +
                         "\nproperty float x\nproperty float y\nproperty float z\n";
    if (counts.normals) header += "property float nx\nproperty float ny\nproperty float nz\n";
    if (counts.radii) header += "property float radius\n";
    if (counts.branches) header += "property int branch\n";
    return header + "element face " + std::to_string(counts.triangles) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
}

void write_ply_vertices(const mesh::VertexSpan& vertices, BufferedFile& file) {
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        file.write_value(vertices.positions[v]);
        if (!vertices.normals.empty()) file.write_value(vertices.normals[v]);
        if (!vertices.radii.empty()) file.write_value(vertices.radii[v]);
        if (!vertices.branches.empty()) file.write_value(vertices.branches[v]);
    }
}

void write_ply_faces(std::span<const glm::uvec3> triangles, const mesh::VertexSpan& /*vertices*/, BufferedFile& file) {
    for (const glm::uvec3& triangle : triangles) {
        file.write_value(std::uint8_t{3});
        file.write_value(triangle);
    }
}

} // namespace ramus::io
