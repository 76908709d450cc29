#include "core/io/meshes/obj.h"

namespace ramus::io {

namespace {

void write_vectors(std::string_view name, std::span<const glm::vec3> vectors, BufferedFile& file) {
    for (const glm::vec3& vector : vectors) {
        file.write(name);
        for (int axis = 0; axis < 3; ++axis) {
            file.write(" ");
            file.write_number(vector[axis]);
        }
        file.write("\n");
    }
}

} // namespace

std::string obj_header(const MeshCounts& /*counts*/) { return "# ramus " RAMUS_VERSION ", mm, RAS\n"; }

void write_obj_positions(const mesh::VertexSpan& vertices, BufferedFile& file) {
    write_vectors("v", vertices.positions, file);
}

void write_obj_normals(const mesh::VertexSpan& vertices, BufferedFile& file) {
    write_vectors("vn", vertices.normals, file);
}

void write_obj_faces(std::span<const glm::uvec3> triangles, const mesh::VertexSpan& vertices, BufferedFile& file) {
    for (const glm::uvec3& triangle : triangles) {
        file.write("f");
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint64_t index = std::uint64_t{triangle[corner]} + 1;
            file.write(" ");
            file.write_number(index);
            if (vertices.normals.empty()) continue;
            file.write("//");
            file.write_number(index);
        }
        file.write("\n");
    }
}

} // namespace ramus::io
