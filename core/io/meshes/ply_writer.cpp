#include "core/io/meshes/ply_writer.h"

#include "core/io/meshes/mesh_record.h"

namespace ramus::io {

namespace {

// Which of the arrays a mesh has.
struct VertexArrays {
    bool normals = true, radii = true, branches = true;
};

std::string header_of(VertexArrays arrays, std::uint64_t vertices, std::uint64_t triangles) {
    std::string header = "ply\nformat binary_little_endian 1.0\ncomment ramus " RAMUS_VERSION ", mm, RAS\n"
                         "element vertex " +
                         std::to_string(vertices) + "\nproperty float x\nproperty float y\nproperty float z\n";
    if (arrays.normals) header += "property float nx\nproperty float ny\nproperty float nz\n";
    if (arrays.radii) header += "property float radius\n";
    if (arrays.branches) header += "property int branch\n";
    header += "element face " + std::to_string(triangles) + "\nproperty list uchar int vertex_indices\nend_header\n";
    return header;
}

template <class File> void write_vertices(const mesh::VertexSpan& vertices, File& file) {
    Record<kPlyVertex> vertex;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        vertex.put(vertices.positions[v]);
        if (!vertices.normals.empty()) vertex.put(vertices.normals[v]);
        if (!vertices.radii.empty()) vertex.put(vertices.radii[v]);
        if (!vertices.branches.empty()) vertex.put(vertices.branches[v]);
        vertex.write(file);
    }
}

template <class File> void write_faces(std::span<const glm::uvec3> triangles, File& file) {
    Record<13> face;
    for (const glm::uvec3& triangle : triangles) {
        face.put(std::uint8_t{3});
        face.put(triangle);
        face.write(file);
    }
}

} // namespace

void write_ply(const mesh::TriangleMesh& mesh, OutputFile& file) {
    const VertexArrays arrays{!mesh.normals.empty(), !mesh.radii.empty(), !mesh.branches.empty()};
    file.write(header_of(arrays, mesh.positions.size(), mesh.triangles.size()));
    write_vertices(vertices_of(mesh), file);
    write_faces(mesh.triangles, file);
}

void keep_ply_vertices(const mesh::VertexSpan& more, MeshParts& parts) { write_vertices(more, parts.vertices); }

void keep_ply_triangles(std::span<const glm::uvec3> more, const mesh::VertexSpan& /*vertices*/, MeshParts& parts) {
    write_faces(more, parts.triangles);
}

void write_ply_parts(MeshParts& parts, OutputFile& file) {
    file.write(header_of({}, parts.vertex_count, parts.triangle_count));
    parts.vertices.copy_to(file);
    parts.triangles.copy_to(file);
}

} // namespace ramus::io
